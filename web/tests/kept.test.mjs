// Fits that are kept: listed, opened again, compared; and stores whose JSON is not what it should be.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { atRest, newPage, open, PATIENCE } from "./browser.mjs";
import { fitRoom, library, shortFit } from "./fit-room.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

const entries = (page) => page.getByTestId("kept-fit");
const names = (page) => entries(page).locator("h4").allTextContents();
const press = (page, name) => page.getByRole("button", { name, exact: true }).click();

/** A short fit of this goal, kept. */
async function keep(page, goal) {
  await page.getByLabel("Goals of the page").selectOption(`${goal}.png`);
  await page.getByTestId("score").waitFor({ state: "detached" });
  await shortFit(page, goal);
  await page.getByTestId("keep-fit").click();
  await entries(page).nth(1).waitFor();
}

test("kept fits are opened again, renamed, duplicated, compared, and deleted with undo, in all tabs", async () => {
  const { page, problems, context } = await fitRoom(studio, "#fit?goal=palm");
  await shortFit(page);
  await page.getByTestId("keep-fit").click();
  await entries(page).first().waitFor();
  const likeness = await page.locator(".score .big").textContent();
  await keep(page, "quaking_aspen");
  assert.deepEqual(await names(page), ["quaking aspen", "palm"]);

  await page.getByLabel("Compare").nth(0).check();
  await page.getByLabel("Compare").nth(1).check();
  const comparison = page.getByTestId("comparison");
  await comparison.locator("table").waitFor({ timeout: PATIENCE });
  assert.equal(await comparison.locator("canvas").count(), 6);
  await comparison.locator(".thumb").last().scrollIntoViewIfNeeded();
  await comparison.locator(".thumb.drawn").nth(1).waitFor({ timeout: PATIENCE });
  const drawn = await comparison
    .locator("figure:first-child canvas")
    .evaluateAll((all) => all.map((each) => each.toDataURL()));
  assert.notEqual(drawn[0], drawn[1]);
  const cells = await comparison
    .locator("tbody tr")
    .evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  assert.deepEqual(
    cells.slice(0, 4).map(([name]) => name),
    ["Likeness", "IoU", "Outline", "Species"],
  );
  assert.ok(cells.length > 4 || (await comparison.textContent()).includes("cannot be compared"));
  for (const [slot, one, other] of cells.slice(4)) assert.notEqual(one, other, slot);
  // Choices have the names of their numbers.
  const files = await page.evaluate(() => {
    const { fits } = JSON.parse(localStorage.getItem("pleach-studio.fits"));
    const toml = (id) => JSON.parse(localStorage.getItem(`pleach-studio.fit.${id}`)).fit.result.toml;
    return Object.fromEntries(fits.map(({ id, name }) => [name, toml(id)]));
  });
  const { Species } = await library();
  const declared = JSON.parse(Species.named("palm").declared());
  const choices = new Map(declared.filter(({ choices }) => choices).map((each) => [each.name, each]));
  const heads = (await comparison.locator("thead th").allTextContents()).slice(1);
  const rows = cells.slice(4).filter(([slot]) => choices.has(slot));
  assert.ok(
    rows.some(([slot]) => choices.get(slot).first > 0),
    JSON.stringify(cells),
  );
  for (const [slot, ...shown] of rows) {
    const { choices: words, first } = choices.get(slot);
    const numbers = heads.map((name) => Number(new RegExp(`^${slot} = (\\d+)`, "m").exec(files[name])?.[1]));
    const expected = numbers.map((number) => words[number - first].replaceAll("_", " "));
    assert.deepEqual(shown, expected, slot);
  }

  // A name is all that changes: nothing is read again, and the page stays where it is.
  await page.evaluate(() => {
    window.scrolls = 0;
    const scroll = Element.prototype.scrollIntoView;
    Element.prototype.scrollIntoView = function (...how) {
      if (this.matches(".comparison")) window.scrolls++;
      scroll.apply(this, how);
    };
  });
  await press(page, "Rename palm");
  await page.getByLabel("Name of the fit").fill("my palm");
  await page.keyboard.press("Enter");
  await comparison.locator("h4", { hasText: "my palm" }).waitFor();
  await comparison.locator("th", { hasText: "my palm" }).waitFor();
  await atRest(page);
  assert.equal(await page.evaluate(() => window.scrolls), 0);
  await press(page, "Duplicate my palm");
  assert.deepEqual(await names(page), ["quaking aspen", "my palm", "my palm, copy"]);
  const other = await context.newPage();
  await other.goto(`${studio.address}#fit`);
  await entries(other).nth(2).waitFor();

  await press(page, "Delete my palm");
  assert.deepEqual(await names(page), ["quaking aspen", "my palm, copy"]);
  await other.waitForFunction(() => document.querySelectorAll('[data-testid="kept-fit"]').length === 2);
  await press(page, "Undo");
  assert.deepEqual(await names(page), ["quaking aspen", "my palm", "my palm, copy"]);

  await page.reload();
  await press(page, "Open my palm");
  await page.waitForFunction(
    (likeness) => document.querySelector(".score .big")?.textContent === likeness,
    likeness,
  );
  assert.equal(await page.getByLabel("Goals of the page").inputValue(), "palm.png");
  await press(page, "Back to quaking aspen and its tree");
  assert.equal(await page.getByLabel("Goals of the page").inputValue(), "quaking_aspen.png");
  assert.deepEqual(problems, []);
  await context.close();
});

/** The page with this in its store. */
function stored(values) {
  const store = (values) => {
    if (sessionStorage.getItem("once")) return;
    sessionStorage.setItem("once", "1");
    for (const [key, value] of Object.entries(values)) {
      localStorage.setItem(`pleach-studio.${key}`, JSON.stringify(value));
    }
  };
  return newPage(studio, { first: [store, values] }, "#fit");
}

const THUMB = { width: 8, height: 1, ink: "_w" };
/** Eight rows of eight pixels, all of them ink. */
const INK = deflateRawSync(Buffer.alloc(8, 255)).toString("base64url");
const GOAL = {
  name: "x",
  width: 8,
  height: 8,
  full: { width: 8, height: 8 },
  target: null,
  masked: false,
  confidence: null,
  ink: INK,
  ground: null,
  axis: null,
  painted: false,
};
const CARD = { likeness: 0.5, iou: 0.5, boundary_f: 0.5, species: "x" };
const RESULT = { report: CARD, toml: "", verdict: null, own_toml: null };
const FIT = { result: RESULT, curve: [], width: 8, height: 8, ink: INK, ownInk: null, goal: INK };
const saved = (goal, fit) => ({ fit: { version: 1, goal, fit, treeHeight: 1, seconds: 10 } });

for (const [what, values] of Object.entries({
  "a goal without the size of its file": saved({ ...GOAL, full: undefined }, null),
  "a goal whose name is a number": saved({ ...GOAL, name: 5 }, null),
  "a fit without its scores": saved(GOAL, FIT),
})) {
  test(`${what}, of the right version, is cleared and told of`, async () => {
    const { page, problems, context } = await stored(values);
    await page.getByText("damaged, and was cleared").waitFor();
    await page.locator(".welcome").waitFor();
    await page.getByRole("button", { name: "palm", exact: true }).click();
    await page.getByTestId("goal").waitFor();
    assert.deepEqual(problems, []);
    await context.close();
  });
}

/** Everything that the page has stored under keys of kept fits. */
const bodies = (page) =>
  page.evaluate(() =>
    Object.keys(localStorage)
      .filter((key) => key.startsWith("pleach-studio.fit."))
      .sort(),
  );
const ENTRY = { id: "d", name: "whole", time: 1e12, likeness: 0.5, thumb: THUMB };

test("what no list names is removed at the start, unless the list is of a newer page", async () => {
  const held = { "fit.c": { version: 1 }, "fit.d": { version: 1 }, "fit.e": "no fit", fitting: 1 };
  const fits = [{ id: "c", name: "no date", likeness: 1, thumb: THUMB }, ENTRY];
  const own = await stored({ fits: { version: 1, fits }, ...held });
  await entries(own.page).first().waitFor();
  assert.deepEqual(await names(own.page), ["whole"]);
  assert.deepEqual(await bodies(own.page), ["pleach-studio.fit.d"]);
  assert.equal(await own.page.evaluate(() => localStorage.getItem("pleach-studio.fitting")), "1");
  assert.deepEqual(own.problems, []);
  await own.context.close();
  const newer = await stored({ fits: { version: 9, fits }, ...held });
  await newer.page.locator(".welcome").waitFor();
  assert.equal((await bodies(newer.page)).length, 3);
  await newer.context.close();
});

test("a fit is neither deleted nor kept once a newer page has the list, and both are told of", async () => {
  const { page, problems, context } = await stored({
    fits: { version: 1, fits: [ENTRY] },
    "fit.d": { version: 1 },
  });
  await entries(page).first().waitFor();
  const newer = JSON.stringify({ version: 9, fits: [ENTRY] });
  await page.evaluate((list) => localStorage.setItem("pleach-studio.fits", list), newer);
  await press(page, "Delete whole");
  const told = page.getByText("A newer version of this page keeps your fits now.");
  await told.waitFor();
  assert.deepEqual(await names(page), ["whole"]);
  assert.deepEqual(await bodies(page), ["pleach-studio.fit.d"]);
  await page.locator(".note").getByRole("button").first().click();
  await told.waitFor({ state: "detached" });
  await page.getByRole("button", { name: "palm", exact: true }).click();
  await page.getByTestId("goal").waitFor();
  await shortFit(page);
  await page.getByTestId("keep-fit").click();
  await told.waitFor();
  assert.equal(await page.getByText("The browser has no room left").count(), 0);
  assert.deepEqual(await bodies(page), ["pleach-studio.fit.d"]);
  assert.equal(await page.evaluate(() => localStorage.getItem("pleach-studio.fits")), newer);
  assert.deepEqual(problems, []);
  await context.close();
});

test("lists of another shape lose what is damaged and nothing else", async () => {
  const { page, problems, context } = await stored({
    species: { version: 1, species: [{ id: "a", name: 7 }, null, { id: "b", name: "mine", toml: "x = 1" }] },
    fits: {
      version: 1,
      fits: [
        "no fit",
        { id: "c", name: "no date", likeness: 1, thumb: THUMB },
        { id: "d", name: "bodiless", time: 1e12, likeness: 0.5, thumb: { ...THUMB, ink: "*" } },
      ],
    },
    theme: { dark: true },
    link: 5,
  });
  await entries(page).first().waitFor();
  assert.deepEqual(await names(page), ["bodiless"]);
  await press(page, "Open bodiless");
  await page.getByText("What the browser has stored of bodiless is damaged").waitFor();
  await press(page, "Delete bodiless");
  await entries(page).waitFor({ state: "detached" });
  await page.getByRole("link", { name: "Gallery" }).click();
  await page.getByRole("heading", { name: "My species" }).waitFor();
  assert.equal(await page.locator(".family").first().locator("li").count(), 1);
  assert.deepEqual(problems, []);
  await context.close();
});

test("lists that are no lists are empty ones, and those of a newer page stay as they are", async () => {
  const newer = { version: 9, fits: "otherwise" };
  const { page, problems, context } = await stored({ species: { version: 1, species: {} }, fits: newer });
  await page.locator(".welcome").waitFor();
  await atRest(page);
  assert.equal(await entries(page).count(), 0);
  const kept = await page.evaluate(() => localStorage.getItem("pleach-studio.fits"));
  assert.deepEqual(JSON.parse(kept), newer);
  await page.getByRole("link", { name: "Species" }).click();
  await page.getByLabel("Start from").selectOption("built:palm");
  await page.locator(".panelhead h2", { hasText: "palm" }).waitFor();
  assert.deepEqual(problems, []);
  await context.close();
});
