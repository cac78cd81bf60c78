// A worker that dies is told of, replaced, and nothing is lost.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { newPage, open } from "./browser.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

test("a dead worker is told of and replaced", async () => {
  const { page, context } = await newPage(studio, {}, "#fit");
  // Every worker of the page can be made to fail as the browser would tell of it.
  await page.evaluate(() => {
    const Real = window.Worker;
    window.killed = [];
    window.Worker = class extends Real {
      constructor(...how) {
        super(...how);
        window.killed.push(this);
      }
    };
  });
  await page.getByRole("link", { name: "Species" }).click();
  const height = page.locator('[data-slot="g_scale"] input[type="number"]');
  await height.waitFor();
  await page.locator('[data-testid="counts"] dd').first().waitFor();
  await page.evaluate(() => {
    for (const worker of window.killed)
      worker.dispatchEvent(new ErrorEvent("error", { message: "out of memory" }));
  });
  await page.getByText("stopped (out of memory)").first().waitFor();
  await height.fill("21");
  await height.press("Enter");
  await page.locator('[data-testid="tree"][aria-label*="2"]').waitFor();
  await page.waitForFunction(() => !document.querySelector(".busy.on"));
  assert.equal(await height.inputValue(), "21");
  assert.equal(await page.locator(".stage .alert").count(), 0);
  await context.close();
});
