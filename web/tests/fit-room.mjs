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

/** Options of the library for the fits that follow, beside those of the page. */
export const tell = (page, options) => page.evaluate((options) => window.studio.tell(options), options);

/** Begins a fit with these options. */
export async function start(page, options = {}) {
  await tell(page, options);
  await page.getByTestId("start").click();
}

/** A fit of so many trees: one of so many seconds would find more on one machine than on another. */
export const trees = (evaluations) => ({ evaluations, timeout: undefined });

/** Comparing a goal with all known species takes seconds, unless a fit begins from one; then small trees do too. */
const beginning = (from) => (from ? { from, size: 64 } : {});

/** A search that goes on until it is stopped; then this very tree is looked for in a moment. */
export const endless = (from) => ({ ...trees(1e6), individual: "20trees", ...beginning(from) });

/** Runs a fit to its score card; its likeness. */
export async function fitted(page, options) {
  await start(page, options);
  await page.getByTestId("score").waitFor({ timeout: 120_000 });
  return Number(await page.locator(".score .big").textContent());
}

/** A fit for those who look at something else than what it finds. */
export const shortFit = (page, from = "palm") => fitted(page, { ...trees(40), ...beginning(from) });

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
