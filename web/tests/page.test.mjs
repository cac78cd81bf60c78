// The page as a whole: it loads alone, every room is drawn, readable for all, on a telephone too.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, describe, test } from "node:test";
import { atRest, colors, newPage, open } from "./browser.mjs";
import { endless, shortFit, start } from "./fit-room.mjs";

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"];

const SPECIES_STEPS = [
  async (page) => {
    await page.getByRole("searchbox").fill("a");
    await page.locator(".doc summary").first().click();
  },
  (page) => tab("Seeds")(page),
  (page) => tab("Download")(page),
];

/** The text of a grammar, then with a mistake. */
const GRAMMAR_STEPS = [
  (page) => tab("Grammar")(page),
  async (page) => {
    await page.locator(".codefield textarea").fill("steps: 3\naxiom: F[\n");
    await page.locator(".codeline.wrong .remark").waitFor();
    await page.locator(".notation summary").click();
  },
];

/** A short fit, for its outcome. */
const FIT_STEPS = [
  (page) => shortFit(page),
  // Two kept fits, compared.
  async (page) => {
    await page.getByTestId("keep-fit").click();
    await page.getByRole("button", { name: "Duplicate palm", exact: true }).click();
    for (const at of [0, 1]) await page.getByLabel("Compare").nth(at).check();
    await page.getByTestId("comparison").locator("table").waitFor();
    await page.getByRole("button", { name: "Delete palm, copy", exact: true }).waitFor();
  },
];

/** Each room, what is drawn in it, and when it is. */
const ROOMS = {
  fit: { hash: "#fit?goal=palm", canvas: '[data-testid="goal"]', steps: FIT_STEPS },
  map: { hash: "#map?at=0,0.5", canvas: '[data-testid="plane"]', ready: '[data-testid="under"]' },
  species: {
    hash: "#species?s=acer",
    canvas: '[data-testid="tree"]',
    ready: '[data-testid="counts"] dd',
    steps: SPECIES_STEPS,
  },
  grammar: {
    hash: "#species?s=abop_plant_f",
    canvas: '[data-testid="tree"]',
    ready: '[data-testid="counts"] dd',
    steps: GRAMMAR_STEPS,
  },
  welcome: { hash: "#fit", canvas: ".targets" },
  // Its pictures come one after the other, for a while.
  gallery: { hash: "#gallery", canvas: ".thumb.drawn >> nth=0", workers: false },
};

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

async function room({ hash, canvas, ready, workers }, options = {}) {
  const opened = await newPage(studio, options, hash);
  await opened.page.locator(canvas).waitFor();
  if (ready) await opened.page.locator(ready).first().waitFor({ state: "attached" });
  // The last thumbnails and shadows.
  await atRest(opened.page, { workers });
  return opened;
}

async function violations(page) {
  await page.evaluate(axe);
  const { found, passed } = await page.evaluate(async (tags) => {
    const { violations, passes } = await window.axe.run(document, { runOnly: tags });
    const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).slice(0, 3)}`);
    return { found, passed: passes.length };
  }, TAGS);
  assert.ok(passed > 10, "axe has looked at nothing");
  return found;
}

/** Opens a tab of the species room. */
const tab = (name) => async (page) => {
  await page.getByRole("radio", { name, exact: true }).check();
  await atRest(page);
};

describe("every room", () => {
  for (const [name, how] of Object.entries(ROOMS)) {
    test(`${name}, dark and light: drawn, readable, silent`, async () => {
      const { page, problems, context } = await room(how, { colorScheme: "dark" });
      const found = [];
      for (const step of [async () => {}, ...(how.steps ?? [])]) {
        await step(page);
        for (const colorScheme of ["dark", "light"]) {
          await page.emulateMedia({ colorScheme });
          await atRest(page, { workers: how.workers });
          assert.ok((await colors(page, how.canvas)) > 3, `${colorScheme}: the canvas is uniform`);
          found.push(...(await violations(page)).map((each) => `${colorScheme}: ${each}`));
        }
      }
      assert.deepEqual(found, []);
      assert.deepEqual(problems, []);
      await context.close();
    });
    test(`${name} does not scroll sideways at 360 pixels`, async () => {
      const { page, context } = await room(how, { viewport: { width: 360, height: 740 } });
      const wide = await page.evaluate(() =>
        [document.documentElement, document.querySelector("main")].map((each) => each.scrollWidth),
      );
      assert.deepEqual(
        wide.map((width) => width <= 360),
        [true, true],
        `${wide}`,
      );
      await context.close();
    });
  }
});

test("the first page asks for nothing but its own files, and a worker for nothing at all", async () => {
  const { page, problems, context } = await newPage(studio, {}, "");
  await page.locator(".targets img").first().waitFor();
  assert.deepEqual(problems, []);
  await context.close();
});

test("the theme can be chosen and stays", async () => {
  const { page, context } = await newPage(studio, { colorScheme: "light" }, "#fit");
  await page.getByRole("button", { name: "Dark page" }).click();
  await page.reload();
  assert.equal(await page.locator("html").getAttribute("data-theme"), "dark");
  await context.close();
});

/** What a person would press there, by its label; empty where something else lies over it. */
const reached = (page, testid) =>
  page.getByTestId(testid).evaluate((button) => {
    const { left, top, width, height } = button.getBoundingClientRect();
    const there = document.elementFromPoint(left + width / 2, top + height / 2);
    return button.contains(there) ? button.textContent : "";
  });

for (const [what, options] of Object.entries({
  "on a telephone": { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true },
  "at 200 % zoom": { viewport: { width: 700, height: 450 }, deviceScaleFactor: 2 },
})) {
  test(`the buttons of a fit are in reach ${what}`, async () => {
    const { page, problems, context } = await newPage(studio, options, "#fit?goal=palm");
    await page.getByTestId("goal").waitFor();
    assert.equal(await reached(page, "start"), "Fit");
    await start(page, endless("palm"));
    await page.getByTestId("overlay").waitFor();
    assert.equal(await reached(page, "pause"), "Pause");
    assert.equal(await reached(page, "stop"), "Stop");
    await page.evaluate(() => document.querySelector("main").scrollTo(0, 10_000));
    assert.equal(await reached(page, "stop"), "Stop");
    await page.getByTestId("stop").click();
    await page.getByTestId("score").waitFor({ timeout: 120_000 });
    assert.equal(await reached(page, "start"), "Fit again");
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test("two tabs keep their species in one list", async () => {
  const { page, context, problems } = await newPage(studio, {}, "#gallery");
  const other = await context.newPage();
  await other.goto(`${studio.address}#gallery`);
  const keep = async (tab, name) => {
    await tab.goto(`${studio.address}#species?s=${name}`);
    await tab.locator(".panelhead h2", { hasText: name }).waitFor();
    await tab.getByRole("radio", { name: "Download", exact: true }).check();
    await tab.getByRole("button", { name: "Keep in my species" }).click();
    await tab.getByText(`${name} is kept in my species`).waitFor();
  };
  await keep(page, "palm");
  await keep(other, "bamboo");
  for (const tab of [page, other]) {
    await tab.getByRole("link", { name: "Gallery" }).click();
    const mine = tab.locator("section.family", { hasText: "My species" }).locator(".card");
    await mine.nth(1).waitFor();
    assert.equal(await mine.count(), 2);
  }
  assert.deepEqual(problems, []);
  await context.close();
});

test("every species of the gallery that is in view gets its picture", async () => {
  const { page, problems, context } = await newPage(studio, {}, "#gallery");
  await page.locator(".card").first().waitFor();
  await page.waitForFunction(
    () =>
      [...document.querySelectorAll(".card .thumb")]
        .filter((thumb) => thumb.getBoundingClientRect().top < innerHeight)
        .every((thumb) => thumb.classList.contains("drawn")),
    null,
    { timeout: 60_000 },
  );
  assert.deepEqual(problems, []);
  await context.close();
});
