// What the page weighs and how fast it is, beside the program: node experiments/studio/measure.mjs [--all] PLEACH PICTURE...
// PLEACH is the program, built for release; web/dist has to be built. PICTURE is a photograph of a tree, whose name in the
// results is that of its file. Writes results.csv beside this file. With --all it measures short
// searches of the other species of Hewitt's dissertation, and writes speed.csv.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, parse } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const root = dirname(dirname(here));
const { newPage, open } = await import(join(root, "web/tests/browser.mjs"));
const all = process.argv[2] === "--all";
const [pleach, ...photographs] = process.argv.slice(all ? 3 : 2);
if (!pleach) throw new Error("usage: node experiments/studio/measure.mjs [--all] PLEACH PICTURE...");

/** Goals whose trees take little, middling and much time to grow. */
const GOALS = ["palm", "quaking_aspen", "silver_birch", "weeping_willow"];
const OTHERS = [
  ...["acer", "apple", "balsam_fir", "bamboo", "black_oak", "black_tupelo", "douglas_fir", "european_larch"],
  ...["hill_cherry", "lombardy_poplar", "small_pine"],
];
const SECONDS = all ? 10 : 30;
/** Files that a visitor does not load who looks at nothing in three dimensions. */
const LATER = /(scene-view|model-view|tree-view|growing-worker)-/;
const rows = [["what", "value", "unit"]];
const note = (what, value, unit) => {
  rows.push([what, typeof value === "number" ? Number(value.toPrecision(4)) : value, unit]);
  console.log(what, value, unit);
};
const cell = (value) => (String(value).includes(",") ? `"${value}"` : value);
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

/** What every visitor loads, and what only some do. */
function noteSizes() {
  const dist = join(root, "web/dist");
  const weight = (name) => gzipSync(readFileSync(join(dist, name)), { level: 9 }).length / 1e6;
  const assets = readdirSync(join(dist, "assets")).map((name) => `assets/${name}`);
  const later = assets.filter((name) => LATER.test(name));
  const sum = (names) => names.map(weight).reduce((a, b) => a + b);
  const first = ["index.html", "icon.svg", ...assets.filter((name) => !later.includes(name))];
  note("size of the page, compressed", sum(first), "MB");
  note("of it the library", weight(assets.find((name) => name.includes("pleach_web_bg"))), "MB");
  note("views in three dimensions, loaded with the first of them", sum(later), "MB");
  note(
    "drawings for the first guess, loaded with the first fit",
    statSync(join(dist, "known.bin")).size / 1e6,
    "MB",
  );
}

const studio = await open();

/** Those who look at nothing in three dimensions load nothing of it. */
async function checkLoading() {
  const { page, context } = await newPage(studio);
  await page.waitForTimeout(3000);
  const loaded = await page.evaluate(() =>
    performance.getEntriesByType("resource").map((entry) => entry.name),
  );
  const early = loaded.filter((name) => LATER.test(name));
  if (early.length > 0) throw new Error(`loaded with the page: ${early.join(", ")}`);
  await context.close();
}

/** Seconds from the address to the first silhouette on the map, in a browser that has nothing cached. */
async function firstTree() {
  const { page, context } = await newPage(studio, {}, "#gallery");
  await page.locator(".thumb.drawn").first().waitFor({ state: "attached" });
  const seconds = await page.evaluate(() => performance.now() / 1000);
  await context.close();
  return seconds;
}
async function noteGallery() {
  const firsts = [];
  for (let time = 0; time < 5; time += 1) firsts.push(await firstTree());
  note("first tree of the gallery, after the address", median(firsts), "s");
}

/** From the pointer to the coarse and to the full silhouette, as the page itself takes the times. */
async function noteMap() {
  const { page, context } = await newPage(studio, {}, "#map");
  await page.getByTestId("plane").waitFor();
  await page.waitForTimeout(6000);
  const box = await page.getByTestId("plane").boundingBox();
  const POINTS = 60;
  for (let step = 0; step < POINTS; step += 1) {
    // A spiral inside the hull.
    const [angle, reach] = [step * 2.4, 0.03 + 0.2 * ((step * 0.37) % 1)];
    await page.mouse.move(
      box.x + box.width * (0.5 + reach * Math.cos(angle)),
      box.y + box.height * (0.66 + reach * 0.8 * Math.sin(angle)),
    );
    await page.waitForTimeout(600);
  }
  const { coarse, full } = await page.evaluate(() => window.studio.mapTimes);
  note("map: points walked over", POINTS, "points");
  note("map: pointer to coarse silhouette, median", median(coarse), "ms");
  note("map: pointer to full silhouette, median", median(full), "ms");
  await context.close();
}

// Fits: trees a second, and tasks of the page's own thread above 50 ms.
const folder = mkdtempSync(join(tmpdir(), "studio-"));

/** Notes from now on the tasks of the page's own thread above 50 ms. */
const noteStalls = (page) =>
  page.evaluate(() => {
    window.stalls = [];
    const watch = (list) => window.stalls.push(...list.getEntries().map((entry) => entry.duration));
    new PerformanceObserver(watch).observe({ type: "longtask" });
  });

/** A fit of the goal that the page shows, and one of the same file by the program. */
async function compare(name, file, page) {
  await page.getByRole("radio", { name: `${SECONDS} s` }).check();
  const height = await page.getByRole("spinbutton", { name: /Height/ }).inputValue();
  const pressed = Date.now();
  await page.getByTestId("start").click();
  await page.getByTestId("overlay").waitFor();
  note(`${name}: nearest known tree, after Start`, (Date.now() - pressed) / 1000, "s");
  await page.waitForFunction(() =>
    document.querySelector('[data-testid="overlay"]')?.getAttribute("aria-label").includes("Likeness"),
  );
  note(`${name}: first tree of a search, after Start`, (Date.now() - pressed) / 1000, "s");
  await page.getByTestId("score").waitFor({ timeout: 8 * SECONDS * 1000 });
  const likeness = Number(await page.locator(".score .big").textContent());
  const { trees, seconds } = await page.evaluate(() => window.studio.search());
  const stalls = await page.evaluate(() => window.stalls);
  const options = ["--height", height, "--timeout", `${SECONDS}s`, "--individual", "off"];
  const out = ["--out", join(folder, name), "--quiet"];
  const run = spawnSync(pleach, ["fit", file, ...options, ...out], { encoding: "utf8" });
  if (run.status !== 0) throw new Error(run.stderr);
  const summary = JSON.parse(readFileSync(join(folder, name, "summary.json"), "utf8"));
  const native = summary.evaluations / summary.search_seconds;
  note(`${name}: likeness after ${SECONDS} s in the page`, likeness, "");
  note(`${name}: trees a second in the page`, trees / seconds, "1/s");
  note(`${name}: trees a second by the program`, native, "1/s");
  note(`${name}: page over program`, trees / seconds / native, "");
  note(`${name}: tasks above 50 ms on the page's own thread`, stalls.length, "tasks");
  if (stalls.length > 0) note(`${name}: the longest of them`, Math.max(...stalls), "ms");
}

if (!all) {
  noteSizes();
  await checkLoading();
  await noteGallery();
  await noteMap();
}
for (const goal of all ? OTHERS : GOALS) {
  const { page, context } = await newPage(studio, {}, `#fit?goal=${goal}`);
  await page.getByTestId("goal").waitFor();
  await page.waitForFunction(() => document.querySelector('[data-testid="goal"]').width > 2);
  await noteStalls(page);
  await compare(goal, join(root, "targets", `${goal}.png`), page);
  await context.close();
}
for (const file of photographs) {
  const { page, context } = await newPage(studio, {}, "#fit");
  const { name } = parse(file);
  const choose = page.getByRole("button", { name: "Choose a picture" });
  await choose.waitFor();
  await noteStalls(page);
  const chooser = page.waitForEvent("filechooser");
  await choose.click();
  const given = Date.now();
  await (await chooser).setFiles(file);
  await page.locator(".facts", { hasText: name.replaceAll("_", " ") }).waitFor();
  note(`${name}: read, after it was given`, (Date.now() - given) / 1000, "s");
  await compare(name, file, page);
  await context.close();
}
await studio.close();
writeFileSync(
  join(here, all ? "speed.csv" : "results.csv"),
  `${rows.map((row) => row.map(cell).join(",")).join("\n")}\n`,
);
