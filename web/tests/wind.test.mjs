// Wind in the view of a fitted tree.
import assert from "node:assert/strict";
import { test } from "node:test";
import { atRest, open, PATIENCE } from "./browser.mjs";
import { fitRoom, modelView, shortFit } from "./fit-room.mjs";

test("the fitted tree sways in wind and stands still without", async (t) => {
  const studio = await open();
  t.after(() => studio.close());
  const { page, problems, context } = await fitRoom(studio, "#fit?goal=palm");
  await shortFit(page);
  await modelView(page, "shown").waitFor({ timeout: PATIENCE });
  const canvas = page.locator(".model-stage .view canvas");
  const picture = async () => (await canvas.screenshot()).toString("base64");
  const sways = async () => {
    const before = await picture();
    for (const until = Date.now() + PATIENCE; Date.now() < until; ) {
      if (before !== (await picture())) return;
    }
    assert.fail("nothing moves");
  };
  const standsStill = async () => {
    // In wind it never comes to rest.
    await atRest(page);
    const before = await picture();
    await page.waitForTimeout(300);
    assert.equal(before, await picture());
  };
  const wind = page.getByTestId("fit-wind");
  await standsStill();
  await wind.click();
  await sways();
  await wind.click();
  await standsStill();
  // Another season is another model, with the same wind.
  await wind.click();
  await page.getByLabel("Season").selectOption("winter");
  await modelView(page, "busy").waitFor();
  await modelView(page, "shown").waitFor({ timeout: PATIENCE });
  await sways();
  await page.emulateMedia({ reducedMotion: "reduce" });
  await standsStill();
  assert.equal(await wind.isDisabled(), true);
  assert.deepEqual(problems, []);
  await context.close();
});
