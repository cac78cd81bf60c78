// The map room: its trees are those of the command line, and they come quickly.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";
import { newPage, open, saved } from "./browser.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

async function map(hash = "#map") {
  const opened = await newPage(studio, {}, hash);
  await opened.page.getByTestId("plane").waitFor();
  await opened.page.waitForFunction(() => !document.querySelector(".plane .empty"));
  return { ...opened, box: await opened.page.getByTestId("plane").boundingBox() };
}

test("a dragged point gives the species that `pleach blend --point` writes", async () => {
  const { page, problems, box, context } = await map();
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height * 0.5);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.6, { steps: 8 });
  await page.mouse.up();
  const toml = await saved(page, "TOML");
  const at = /^# At (\S+) of a map/m.exec(toml)?.[1];
  assert.ok(at, "the file does not say where it is from");
  // The link follows shortly.
  await page.waitForFunction((at) => new URLSearchParams(location.hash.split("?")[1]).get("at") === at, at);
  assert.match(toml, /^# A blend/);
  assert.match(toml, /generator = "weber-penn"/);
  if (process.env.PLEACH) {
    const written = execFileSync(process.env.PLEACH, ["blend", `--point=${at}`], { encoding: "utf8" });
    assert.equal(toml, written);
  }
  assert.deepEqual(problems, []);
  await context.close();
});

test("keys move the point, Enter opens its species", async () => {
  const { page, context } = await map("#map?at=0,0.5");
  await page.locator(".plane").focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("p");
  await page.locator(".pins li").waitFor();
  await page.keyboard.press("Enter");
  await page.locator(".panelhead h2", { hasText: "blend" }).waitFor();
  await context.close();
});

test("a drawn path gives a row of trees", async () => {
  const { page, box, context } = await map();
  await page.getByRole("radio", { name: "Draw a path" }).check();
  await page.mouse.move(box.x + box.width * 0.3, box.y + box.height * 0.7);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.7, { steps: 12 });
  await page.mouse.up();
  await page.locator(".rowoftrees li").nth(7).waitFor();
  await context.close();
});

test("the layout by looks is another plane", async () => {
  const { page, problems, context } = await map();
  await page.getByRole("radio", { name: "By looks" }).check();
  await page.waitForFunction(() => !document.querySelector(".plane .empty"));
  await page.getByText("What the axes mean").click();
  await page.getByText("The axes mean nothing here").waitFor();
  assert.deepEqual(problems, []);
  await context.close();
});

test("a link to another layout opens it while the map is open", async () => {
  const { page, problems, context } = await map("#map?at=0,0.4&pins=0.1,0.2");
  await page.locator(".pins li").waitFor();
  await page.evaluate(() => {
    location.hash = "#map?layout=looks";
  });
  await page.getByText("Move over the map").waitFor();
  await page.waitForFunction(() => !document.querySelector(".plane .empty"));
  assert.equal(await page.getByRole("radio", { name: "By looks" }).isChecked(), true);
  assert.deepEqual(problems, []);
  await context.close();
});
