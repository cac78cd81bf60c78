// Cards of the species room show leaves.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { atRest, newPage, open } from "./browser.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

/** How many pixels of the view are green, once the tree is drawn. */
async function green(page, leaves) {
  await page.locator(".stagebar select").selectOption(leaves);
  await atRest(page);
  assert.equal(await page.locator(".busy.on").count(), 0);
  const png = await page.getByTestId("tree").screenshot();
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) {
      if (data[at + 1] > 1.2 * data[at] && data[at + 1] > 1.5 * data[at + 2]) count++;
    }
    return count;
  }, png.toString("base64"));
}

const leafTriangles = async (page) => {
  const row = page.locator('[data-testid="counts"] div', { hasText: "Leaf triangles" }).locator("dd");
  return Number((await row.textContent()).replaceAll(",", ""));
};

test("cards cover what leaves cover, and are no rectangles", async () => {
  const { page, problems, context } = await newPage(studio, {}, "#species?s=quaking_aspen");
  await page.locator('[data-testid="counts"] dd').first().waitFor();
  await page.getByRole("radio", { name: "LOD 2" }).check();
  await page.getByText("Leaves", { exact: true }).waitFor();
  // Near enough that the tree does not hide its own gaps.
  await page.locator(".stage .view").focus();
  for (let step = 0; step < 13; step++) await page.keyboard.press("+");
  const simple = await green(page, "simple");
  const triangles = await leafTriangles(page);
  const cards = await green(page, "cards");
  // Each leaf has a card across it too, which shows where the leaf itself is seen from the side.
  assert.equal(await leafTriangles(page), 2 * triangles);
  const ratio = cards / simple;
  console.log(`cards cover ${ratio.toFixed(2)} times what simple leaves do`);
  assert.ok(ratio > 0.95 && ratio < 1.3, `${cards} green pixels with cards, ${simple} with simple leaves`);

  // A slider's step keeps them, and another species has its own.
  const textures = () => page.evaluate(() => window.studio.memory().textures);
  const before = await textures();
  await page.locator('input[type="number"][aria-label^="g_scale"]').first().fill("15");
  await page.locator('input[type="number"][aria-label^="g_scale"]').first().press("Enter");
  await atRest(page);
  assert.equal((await leafTriangles(page)) > triangles, true);
  assert.equal(await textures(), before);
  await page.getByLabel("Start from").selectOption("built:palm");
  await atRest(page);
  assert.equal(await textures(), before);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a tree is shown without pictures of leaves where they cannot be read", async () => {
  const { page, problems, context } = await newPage(studio, {}, "#species?s=quaking_aspen");
  await page.locator('[data-testid="counts"] dd').first().waitFor();
  await page.getByRole("radio", { name: "LOD 2" }).check();
  await page.getByText("Leaves", { exact: true }).waitFor();
  const textures = () => page.evaluate(() => window.studio.memory().textures);
  const before = await textures();
  const simple = await green(page, "simple");
  await page.evaluate(() => {
    const read = window.createImageBitmap;
    window.createImageBitmap = (...what) =>
      window.reads ? read(...what) : Promise.reject(new Error("damaged"));
  });
  await page.locator(".stagebar select").selectOption("cards");
  await atRest(page);
  await page.evaluate(() => {
    window.reads = true;
  });
  const cards = await green(page, "cards");
  assert.equal(await textures(), before);
  // Whole rectangles cover more than leaves.
  assert.ok(cards > 1.1 * simple, `${cards} green pixels with cards, ${simple} with simple leaves`);
  assert.deepEqual(problems, []);
  await context.close();
});
