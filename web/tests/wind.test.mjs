// Wind in the view of a fitted tree.
import assert from "node:assert/strict";
import { test } from "node:test";
import { open, PATIENCE } from "./browser.mjs";
import { fitRoom, modelView, shortFit } from "./fit-room.mjs";

test("the fitted tree sways in wind and stands still without", async (t) => {
  const studio = await open();
  t.after(() => studio.close());
  const { page, problems, context } = await fitRoom(studio, "#fit?goal=palm");
  await shortFit(page);
  await modelView(page, "shown").waitFor({ timeout: PATIENCE });
  await page.waitForTimeout(3000);
  const canvas = page.locator(".model-stage .view canvas");
  const picture = async () => (await canvas.screenshot()).toString("base64");
  const moves = async () => {
    const before = await picture();
    await page.waitForTimeout(1500);
    return before !== (await picture());
  };
  assert.equal(await moves(), false);
  await page.getByTestId("fit-wind").click();
  await page.waitForTimeout(1500);
  assert.equal(await moves(), true);
  await page.getByTestId("fit-wind").click();
  await page.waitForTimeout(1500);
  assert.equal(await moves(), false);
  // Another season is another model, with the same wind.
  await page.getByTestId("fit-wind").click();
  await page.getByLabel("Season").selectOption("winter");
  await page.waitForTimeout(6000);
  assert.equal(await moves(), true);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.waitForTimeout(1500);
  assert.equal(await moves(), false);
  assert.equal(await page.getByTestId("fit-wind").isDisabled(), true);
  assert.deepEqual(problems, []);
  await context.close();
});
