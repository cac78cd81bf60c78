// Grammars as text in the species room: mistakes under their lines, the tree beside them, undo, files and links.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { atRest, newPage, open, PATIENCE, saved } from "./browser.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

const PLANT = "#species?s=abop_plant_f";
const field = (page) => page.getByLabel("Text of the grammar");
const height = async (page) =>
  /([\d.]+) m high/.exec(await page.getByTestId("tree").getAttribute("aria-label"))[1];

async function editor(hash = PLANT) {
  const opened = await newPage(studio, {}, hash);
  await opened.page.getByRole("radio", { name: "LOD 3" }).check();
  await opened.page.getByRole("radio", { name: "Grammar", exact: true }).check();
  await field(opened.page).waitFor();
  await opened.page.locator('[data-testid="counts"] dd').first().waitFor();
  await atRest(opened.page);
  return opened;
}

/** Sets the cursor behind a piece of the text, and types there as people do. */
async function typeBehind(page, piece, text) {
  await field(page).evaluate((area, piece) => {
    area.focus();
    const at = area.value.indexOf(piece) + piece.length;
    area.setSelectionRange(at, at);
  }, piece);
  await page.keyboard.type(text);
}

/** The line of the text in which a piece stands, from 1. */
const lineOf = async (page, piece) => (await field(page).inputValue()).split(piece)[0].split("\n").length;

test("a mistake stands under its line, and goes with it; the tree stays", async () => {
  const { page, problems, context } = await editor();
  const tree = await page.getByTestId("tree").getAttribute("aria-label");
  await typeBehind(page, "F ->", " Q(oops)");
  const remark = page.locator(".codeline.wrong .remark");
  await remark.waitFor();
  assert.match(await remark.textContent(), /^`oops` is not a known name/);
  const line = await lineOf(page, "oops");
  const places = await page
    .locator(".codeline")
    .evaluateAll((all) => all.map((each) => each.getBoundingClientRect().bottom));
  const under = await remark.boundingBox();
  assert.ok(Math.abs(under.y - places[line - 1]) < 2, `${under.y}, the line ends at ${places[line - 1]}`);
  // What lies under the field wraps as the field does, or the remarks would stand elsewhere.
  const [drawn, area] = await Promise.all([
    page.locator(".codelines").evaluate((lines) => lines.clientHeight),
    field(page).evaluate((area) => area.scrollHeight),
  ]);
  assert.ok(Math.abs(drawn - area) <= 1, `${drawn} and ${area} pixels`);
  assert.equal(await field(page).getAttribute("aria-invalid"), "true");
  // Those who do not see it hear it, and its entry leads there.
  await page.locator(".remarks button", { hasText: `Line ${line}` }).click();
  const chosen = await field(page).evaluate((area) =>
    area.value.slice(area.selectionStart, area.selectionEnd),
  );
  assert.equal(chosen, "oops");
  assert.equal(await page.getByTestId("tree").getAttribute("aria-label"), tree);
  assert.ok(await page.getByTestId("undo").isDisabled(), "the species has not changed");
  // The field has the browser's own undo.
  await page.keyboard.press("Control+z");
  await remark.waitFor({ state: "detached" });
  assert.ok(!(await field(page).inputValue()).includes("oops"));
  assert.deepEqual(problems, []);
  await context.close();
});

test("the tree follows the text; undo, the file and the link have both, and the comments", async () => {
  const { page, problems, context } = await editor();
  const [text, before] = [await field(page).inputValue(), await height(page)];
  await typeBehind(page, text.split("\n")[0], "\n# twice as high");
  await typeBehind(page, "F -> FF", "FF");
  await atRest(page);
  const after = await height(page);
  assert.ok(Number(after) > 2 * Number(before), `${before} m, then ${after} m`);
  const edited = await field(page).inputValue();
  // Sliders keep the text, and its file.
  const toml = await saved(page, "TOML, the species file", "Download");
  assert.ok(toml.includes(`'''\n${edited}'''`), toml);
  await page.getByRole("button", { name: "Keep in my species" }).click();
  await page.getByRole("radio", { name: "Grammar", exact: true }).check();
  await page.getByTestId("copy-link").click();
  await page.getByText("The link is copied").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  // The room's undo is a step of the whole text.
  while (await page.getByTestId("undo").isEnabled()) await page.getByTestId("undo").click();
  await atRest(page);
  assert.equal(await field(page).inputValue(), text);
  assert.equal(await height(page), before);
  while (await page.getByTestId("redo").isEnabled()) await page.getByTestId("redo").click();
  await atRest(page);
  assert.equal(await field(page).inputValue(), edited);
  assert.equal(await height(page), after);
  const other = await editor(link.slice(link.indexOf("#")));
  assert.equal(await field(other.page).inputValue(), edited);
  assert.equal(await height(other.page), after);
  await other.context.close();
  // Another example takes its place, and those that ship are in a list.
  await page.getByLabel("Examples").selectOption("abop_plant_a");
  await page.locator(".panelhead h2", { hasText: "plant a" }).waitFor();
  await page.waitForFunction((old) => document.querySelector(".codefield textarea").value !== old, edited);
  await page.getByLabel("Start from").selectOption({ label: "acer" });
  await page.getByRole("radio", { name: "Grammar", exact: true }).waitFor({ state: "detached" });
  assert.deepEqual(problems, []);
  await context.close();
});

test("a grammar that runs away is told of at its rule, and a newer text does not wait for it", async () => {
  const { page, problems, context } = await editor();
  const before = await height(page);
  const area = field(page);
  const run = "steps: 99\naxiom: A\n# more and more\nA -> AF\nF -> FF\n";
  await area.fill(run);
  const remark = page.locator(".codeline.wrong .remark");
  await remark.waitFor({ timeout: PATIENCE });
  assert.match(await remark.textContent(), /more than [\d,]+ (steps|knots|stems)/);
  assert.equal(await page.locator(".codeline").nth(4).locator(".remark").count(), 1);
  // One that grows for seconds is given up for the next.
  await area.fill(run.replace("F -> FF", "F -> FFF"));
  await page.waitForFunction(() => document.querySelector(".busy.on"));
  const begun = Date.now();
  await area.fill("steps: 1\naxiom: F(3)\n");
  await page.waitForFunction(() =>
    / 3\.0 m high/.test(document.querySelector('[data-testid="tree"]').ariaLabel),
  );
  console.log(`the newer tree came after ${Date.now() - begun} ms`);
  assert.equal(await remark.count(), 0);
  assert.notEqual(await height(page), before);
  assert.deepEqual(problems, []);
  await context.close();
});

test("numbers of sliders stay when the text changes, unless it says others", async () => {
  const { page, context } = await editor("#species?s=abop_monopodial_a");
  await page.getByRole("radio", { name: "Parameters", exact: true }).check();
  const number = (slot) => page.locator(`[data-slot="${slot}"] input[type="number"]`);
  await number("r1").fill("0.8");
  await number("r1").press("Enter");
  await page.getByRole("radio", { name: "Grammar", exact: true }).check();
  await typeBehind(page, "axiom: A(1, 1", "1");
  await atRest(page);
  await page.getByRole("radio", { name: "Parameters", exact: true }).check();
  assert.equal(await number("r1").inputValue(), "0.8");
  await context.close();
});
