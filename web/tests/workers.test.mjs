// A worker that dies is told of, replaced, and nothing is lost.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { newPage, open } from "./browser.mjs";
import { endless, fitRoom, shortFit, start } from "./fit-room.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

/** Every worker of the page can be made to fail as the browser would tell of it: those that were asked for `op`. */
async function killable(page) {
  await page.evaluate(() => {
    const asked = new Map();
    window.Worker = class extends window.Worker {
      postMessage(message, ...rest) {
        if (message.op) asked.set(this, (asked.get(this) ?? new Set()).add(message.op));
        super.postMessage(message, ...rest);
      }

      terminate() {
        asked.delete(this);
        super.terminate();
      }
    };
    window.kill = (op) => {
      const found = [...asked].filter(([, ops]) => op === undefined || ops.has(op)).map(([worker]) => worker);
      for (const worker of found) worker.dispatchEvent(new ErrorEvent("error", { message: "out of memory" }));
      return found.length;
    };
  });
  return (op) => page.evaluate((op) => window.kill(op), op);
}

test("a dead worker is told of and replaced", async () => {
  const { page, context } = await newPage(studio, {}, "#fit");
  const kill = await killable(page);
  await page.getByRole("link", { name: "Species" }).click();
  const height = page.locator('[data-slot="g_scale"] input[type="number"]');
  await height.waitFor();
  await page.locator('[data-testid="counts"] dd').first().waitFor();
  await kill();
  await page.getByText("stopped (out of memory)").first().waitFor();
  await height.fill("21");
  await height.press("Enter");
  await page.locator('[data-testid="tree"][aria-label*="2"]').waitFor();
  await page.waitForFunction(() => !document.querySelector(".busy.on"));
  assert.equal(await height.inputValue(), "21");
  assert.equal(await page.locator(".stage .alert").count(), 0);
  await context.close();
});

test("a search goes on without workers that died in it, and can be begun again if its own did", async () => {
  const { page, context } = await fitRoom(studio);
  const kill = await killable(page);
  const found = () => page.evaluate(() => window.studio.search().trees);
  await start(page, endless("palm"));
  await page.getByTestId("overlay").waitFor();
  const before = await found();
  assert.ok((await kill("evaluate")) > 0, "no worker has scored a tree");
  await page.getByText("The worker of the search stopped (out of memory)").waitFor();
  await page.waitForFunction((before) => window.studio.search().trees > before + 20, before);
  // The one that holds the search.
  assert.equal(await kill("fitStep"), 1);
  await page.getByTestId("start").waitFor();
  await page.locator(".alert", { hasText: /The search is lost|The worker of the search stopped/ }).waitFor();
  assert.ok(Number(await shortFit(page)) > 0.5);
  assert.equal(await page.locator(".alert").count(), 0);
  await context.close();
});
