// The fit room, for the tests that work in it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { newPage } from "./browser.mjs";

/** The fit room with a goal, in a browser that [open](browser.mjs) has started. */
export async function fitRoom(studio, hash = "#fit?goal=palm") {
  const opened = await newPage(studio, {}, hash);
  await opened.page.getByTestId("goal").waitFor();
  await opened.page.waitForFunction(() => document.querySelector('[data-testid="goal"]').width === 256);
  return opened;
}

/** The library in this process: what the page's workers have. */
export async function library() {
  const pleach = await import("../src/wasm/pleach_web.js");
  const module = new URL("../src/wasm/pleach_web_bg.wasm", import.meta.url);
  await pleach.default({ module_or_path: readFileSync(module) });
  return pleach;
}

export const inkOf = async (png) => (await library()).Goal.read("silhouette.png", png, "off").pixels();

export const start = async (page) => {
  await page.getByRole("radio", { name: "10 s" }).check();
  await page.getByTestId("start").click();
};

/** Runs a fit to its score card; the likeness, and the tasks of the page's own thread above 50 ms. */
export async function fitted(page) {
  await page.evaluate(() => {
    window.stalls = [];
    const watch = (list) =>
      window.stalls.push(
        ...list
          .getEntries()
          .map((entry) => `${Math.round(entry.duration)} ms at ${Math.round(entry.startTime)}`),
      );
    new PerformanceObserver(watch).observe({ type: "longtask" });
  });
  await start(page);
  await page.getByTestId("score").waitFor({ timeout: 120_000 });
  const likeness = Number(await page.locator(".score .big").textContent());
  return { likeness, stalls: await page.evaluate(() => window.stalls) };
}

/** A search that is ended soon. */
export async function shortFit(page) {
  await start(page);
  await page.getByTestId("overlay").waitFor();
  await page.waitForTimeout(2000);
  await page.getByTestId("stop").click();
  await page.getByTestId("score").waitFor({ timeout: 120_000 });
}

export const modelView = (page, state) => page.locator(`[data-testid="model"][data-state="${state}"]`);

export const ink = (page) =>
  page.getByTestId("goal").evaluate((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, value, at) => sum + (at % 4 === 3 && value > 0 ? 1 : 0), 0);
  });

/** The page paints with the next picture of the screen. */
export async function inkIs(page, right) {
  for (let patience = 50; patience > 0; patience--) {
    if (right(await ink(page))) return;
    await page.waitForTimeout(100);
  }
  assert.fail(`the mask has ${await ink(page)} pixels`);
}

/** Drops a file on the page. */
export const drop = (page, name, bytes) =>
  page.evaluate(
    ([name, base64]) => {
      const files = new DataTransfer();
      files.items.add(
        new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name, { type: "image/png" }),
      );
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
    },
    [name, bytes.toString("base64")],
  );
