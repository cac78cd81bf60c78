// A fit and its goal: they go together, in the page and in what the browser stores.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { atRest, newPage, open, PATIENCE } from "./browser.mjs";
import { drop, endless, fitRoom, ink, inkIs, shortFit, start, tell } from "./fit-room.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

const fit = (hash) => fitRoom(studio, hash);

test("a result goes with its goal, in the page and in what is stored", async () => {
  const { page, problems, context } = await fit();
  await shortFit(page);
  const facts = (name) => page.locator(".facts", { hasText: name }).waitFor();
  const results = () => page.locator('[data-testid="score"], [data-testid="overlay"]').count();
  await page.getByLabel("Goals of the page").selectOption("acer.png");
  await facts("acer");
  assert.equal(await results(), 0);
  await atRest(page);
  await page.reload();
  await facts("acer");
  assert.equal(await results(), 0);
  assert.equal(await page.getByTestId("start").textContent(), "Fit");
  // Another goal ends a search.
  await start(page, endless("acer"));
  await page.getByTestId("overlay").waitFor();
  await drop(page, "drawn.png", readFileSync(new URL("../public/targets/bamboo.png", import.meta.url)));
  await facts("drawn");
  await page.getByText("The search for acer has ended: drawn is the goal now.").waitFor();
  await page.getByTestId("start").waitFor();
  assert.equal(await results(), 0);
  // The height of a goal that is known is not that of the next.
  assert.equal(await page.getByLabel("Height, m").inputValue(), "10");
  assert.deepEqual(problems, []);
  await context.close();
});

test("the last choice is the goal, however long each of them takes", async () => {
  const { page, problems, context } = await fit();
  let arrive;
  await page.route("**/targets/acer.png", async (route) => {
    await new Promise((wait) => {
      arrive = wait;
    });
    await route.continue();
  });
  await page.getByLabel("Goals of the page").selectOption("acer.png");
  await page.locator(".reading", { hasText: "acer.png" }).waitFor();
  assert.ok(await page.getByTestId("start").isDisabled());
  await drop(page, "drawn.png", readFileSync(new URL("../public/targets/bamboo.png", import.meta.url)));
  await page.locator(".facts", { hasText: "drawn" }).waitFor();
  const came = page.waitForResponse("**/targets/acer.png");
  arrive();
  await (await came).finished();
  await atRest(page);
  assert.match(await page.locator(".facts").textContent(), /^drawn/);
  assert.equal(await page.getByLabel("Height, m").inputValue(), "10");
  assert.deepEqual(problems, []);
  await context.close();
});

test("a store that is damaged or full is told of, and does no more harm", async () => {
  const { page, problems, context } = await fit();
  const key = "pleach-studio.fit";
  const stored = () => page.evaluate((key) => JSON.parse(localStorage.getItem(key))?.goal.name ?? null, key);
  const become = async (name) => {
    for (let patience = 50; patience > 0 && (await stored()) !== name; patience--) {
      await page.waitForTimeout(100);
    }
    assert.equal(await stored(), name);
  };
  await become("palm");
  await page.evaluate((key) => {
    const saved = JSON.parse(localStorage.getItem(key));
    localStorage.setItem(key, JSON.stringify({ ...saved, goal: { ...saved.goal, ink: "AAAA" } }));
  }, key);
  await page.reload();
  await page.getByText("is damaged, and was cleared").waitFor();
  await become("palm");
  await page.evaluate((full) => {
    const set = Storage.prototype.setItem;
    Storage.prototype.setItem = function (key, value) {
      if (key === full) throw new DOMException("full", "QuotaExceededError");
      set.call(this, key, value);
    };
  }, key);
  await page.getByLabel("Goals of the page").selectOption("acer.png");
  await page.getByText("The browser has no room left").waitFor();
  await become(null);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a search that is given up before it begins writes to no goal", async () => {
  const { page, problems, context } = await fit();
  let arrive;
  const asked = new Promise((resolve) =>
    page.route("**/known.bin", async (route) => {
      resolve();
      await new Promise((wait) => {
        arrive = wait;
      });
      await route.continue();
    }),
  );
  await start(page);
  await asked;
  await page.getByTestId("stop").click();
  await page.getByTestId("start").waitFor();
  // Another goal ends it as well.
  await start(page);
  await page.getByTestId("stop").waitFor();
  await drop(page, "drawn.png", readFileSync(new URL("../public/targets/bamboo.png", import.meta.url)));
  await page.getByText("The search for palm has ended: drawn is the goal now.").waitFor();
  await page.getByTestId("start").waitFor();
  const came = page.waitForResponse("**/known.bin");
  arrive();
  await (await came).finished();
  await atRest(page);
  assert.equal(await page.locator('[data-testid="score"], [data-testid="overlay"]').count(), 0);
  assert.equal(await page.getByTestId("start").textContent(), "Fit");
  // A pause is left only to end.
  await start(page, endless("bamboo"));
  await page.getByTestId("overlay").waitFor();
  await page.getByTestId("pause").click();
  await page.getByText("Paused").waitFor();
  await drop(page, "other.png", readFileSync(new URL("../public/targets/acer.png", import.meta.url)));
  await page.getByText("The search for drawn has ended: other is the goal now.").waitFor();
  await atRest(page);
  assert.equal(await page.locator('.panelfoot .alert, [data-testid="overlay"]').count(), 0);
  assert.equal(await page.getByTestId("start").textContent(), "Fit");
  assert.deepEqual(problems, []);
  await context.close();
});

test("a picture that was dropped by mistake does not cost the fit before it", async () => {
  const { page, problems, context } = await fit();
  await shortFit(page);
  const likeness = await page.locator(".score .big").textContent();
  // Nor does a second fit that is cancelled.
  await start(page);
  await page.getByRole("button", { name: "Cancel" }).click();
  await page.getByTestId("start").waitFor();
  assert.equal(await page.locator(".score .big").textContent(), likeness);
  // Nor one that the picture comes into.
  await start(page, endless("palm"));
  await page.getByTestId("score").waitFor({ state: "detached" });
  await drop(page, "drawn.png", readFileSync(new URL("../public/targets/bamboo.png", import.meta.url)));
  await page.getByRole("button", { name: "Back to palm and its tree" }).click();
  await page.locator(".facts", { hasText: "palm" }).waitFor();
  assert.equal(await page.locator(".score .big").textContent(), likeness);
  await page.getByLabel("Goals of the page").selectOption("acer.png");
  await page.getByRole("button", { name: "Back to palm and its tree" }).click();
  await page.locator(".facts", { hasText: "palm" }).waitFor();
  assert.equal(await page.locator(".score .big").textContent(), likeness);
  // A score is one number on one line, however narrow its card is.
  for (const width of [1400, 390]) {
    await page.setViewportSize({ width, height: 844 });
    const lines = await page.locator(".score .big").evaluate((big) => {
      const range = document.createRange();
      range.selectNodeContents(big);
      return range.getClientRects().length;
    });
    assert.equal(lines, 1, `${width} pixels`);
  }
  assert.deepEqual(problems, []);
  await context.close();
});

test("what the library says to do next are buttons that do it", async () => {
  const { page, problems, context } = await fit();
  await shortFit(page);
  assert.notEqual(await page.getByTestId("next").getByRole("button").count(), 0);
  await atRest(page);
  // All words that there are, and one that this page does not know.
  const words = [
    ...["grow-more", "every-seed", "correct-mask", "leafy", "bare", "correct-reading", "any-family"],
    ...["search-longer", "tell-height", "of-a-later-version"],
  ];
  await page.evaluate((next) => {
    const saved = JSON.parse(localStorage.getItem("pleach-studio.fit"));
    saved.fit.result.report.next = next;
    localStorage.setItem("pleach-studio.fit", JSON.stringify(saved));
  }, words);
  // No fit gets beyond its beginning.
  await page.route("**/known.bin", () => {});
  await page.reload();
  const step = (name) => page.getByTestId("next").getByRole("button", { name, exact: true });
  await step("Paint away what is too much").click();
  assert.ok(await page.getByRole("radio", { name: "Take away" }).isChecked());
  await page.getByLabel("Show it over the goal").uncheck();
  await step("Correct what was read").click();
  assert.ok(await page.getByLabel("Show it over the goal").isChecked());
  await step("Say how tall it is").click();
  assert.equal(await page.evaluate(() => document.activeElement.labels[0].textContent), "Height, m");
  // A fit that is begun so is the panel's: it is seen what was chosen.
  const begins = async (name) => {
    await step(name).click();
    await page.getByRole("button", { name: "Cancel" }).click();
    await page.getByTestId("start").waitFor();
  };
  await begins("Search for 60 s");
  assert.ok(await page.getByRole("radio", { name: "60 s" }).isChecked());
  await begins("Fit it without leaves");
  assert.equal(await page.getByLabel("Leaves", { exact: true }).inputValue(), "off");
  await begins("Try all families");
  assert.equal(await page.getByLabel("Family").inputValue(), "auto");
  await step("Grow more of its kind").click();
  await page.locator('[data-testid="counts"] dd').first().waitFor();
  assert.deepEqual(problems, []);
  await context.close();
});

test("keys undo the brush, and the focus stays with what is to be done next", async () => {
  const { page, context } = await newPage(studio, {}, "#fit");
  await page.getByRole("button", { name: "palm", exact: true }).focus();
  await page.keyboard.press("Enter");
  await page.getByTestId("goal").waitFor();
  await page.waitForFunction(() => document.activeElement?.textContent === "Fit");
  const before = await ink(page);
  const box = await page.getByTestId("goal").boundingBox();
  await page.mouse.move(box.x + 30, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 90, box.y + 60, { steps: 3 });
  await page.mouse.up();
  await inkIs(page, (now) => now > before + 50);
  const painted = await ink(page);
  assert.match(await page.locator(".facts").textContent(), /a silhouette, painted over$/);
  await page.keyboard.press("Control+z");
  await inkIs(page, (now) => now === before);
  assert.match(await page.locator(".facts").textContent(), /a silhouette$/);
  await page.keyboard.press("Control+Shift+z");
  await inkIs(page, (now) => now === painted);
  // Who has left the buttons is not called back to them.
  await page.getByTestId("start").focus();
  await page.evaluate(() => document.activeElement.blur());
  await drop(page, "drawn.png", readFileSync(new URL("../public/targets/bamboo.png", import.meta.url)));
  await page.locator(".facts", { hasText: "drawn" }).waitFor();
  await atRest(page);
  assert.equal(await page.evaluate(() => document.activeElement.tagName), "BODY");
  await tell(page, endless("bamboo"));
  await page.getByTestId("start").focus();
  await page.keyboard.press("Enter");
  await page.getByTestId("pause").waitFor({ timeout: PATIENCE });
  assert.equal(await page.evaluate(() => document.activeElement.tagName), "BUTTON");
  await context.close();
});
