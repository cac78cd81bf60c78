// A browser on the built page, which lets no request leave the page's own origin.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { serve } from "./server.mjs";

export const dist = fileURLToPath(new URL("../dist/", import.meta.url));

/** Longer than a slow machine needs, shorter than a person waits. */
export const PATIENCE = 60_000;

/** Chromium, and a server of the built page or of another folder. */
export async function open(folder = dist) {
  const server = await serve(folder);
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      // Without a graphics card the page itself is put together faster without pretending to have one.
      "--disable-gpu-compositing",
    ],
  });
  return {
    address: server.address,
    browser,
    /** From now on the page's host answers nothing. */
    cutNetwork: () => server.close(),
    async close() {
      await browser.close();
      server.close();
    },
  };
}

/**
 * Runs in the page before its own scripts. It notes what the page has begun and not ended: calls to workers, timers,
 * pictures of the screen that it has asked for, pictures that are decoded. Then [atRest] need not guess how long that takes.
 */
function noteWork() {
  /** Longer ones are not waited for: messages that go away by themselves. */
  const SOON = 2000;
  const calls = new Map();
  const timers = new Map();
  const frames = new Set();
  let decoding = 0;
  const { setTimeout, clearTimeout, requestAnimationFrame, cancelAnimationFrame, createImageBitmap } = window;

  window.Worker = class extends Worker {
    constructor(...how) {
      super(...how);
      calls.set(this, new Map());
      this.addEventListener("message", ({ data }) => {
        if (data.kind !== "progress") calls.get(this)?.delete(data.id);
      });
      this.addEventListener("error", () => calls.delete(this));
    }

    postMessage(message, ...rest) {
      if (message.op) calls.get(this)?.set(message.id, message.op);
      super.postMessage(message, ...rest);
    }

    terminate() {
      calls.delete(this);
      super.terminate();
    }
  };
  window.setTimeout = (run, wait = 0, ...rest) => {
    const id = setTimeout(() => {
      timers.delete(id);
      run(...rest);
    }, wait);
    if (wait <= SOON) timers.set(id, wait);
    return id;
  };
  window.clearTimeout = (id) => {
    timers.delete(id);
    clearTimeout(id);
  };
  window.requestAnimationFrame = (run) => {
    const id = requestAnimationFrame((time) => {
      frames.delete(id);
      run(time);
    });
    frames.add(id);
    return id;
  };
  window.cancelAnimationFrame = (id) => {
    frames.delete(id);
    cancelAnimationFrame(id);
  };
  window.createImageBitmap = (...what) => {
    decoding++;
    return createImageBitmap(...what).finally(() => decoding--);
  };

  /** In words; empty when there is nothing. */
  const work = (workers) => [
    ...(workers ? [...calls.values()].flatMap((each) => [...each.values()].map((op) => `call ${op}`)) : []),
    ...[...timers.values()].map((wait) => `timer of ${wait} ms`),
    ...(frames.size > 0 ? ["a picture of the screen"] : []),
    ...(decoding > 0 ? ["a picture that is decoded"] : []),
    ...document
      .getAnimations()
      .filter((each) => each.playState === "running" && each.effect.getTiming().iterations !== Infinity)
      .map((each) => `animation of ${each.effect.target?.className}`),
  ];
  /** True after some pictures of the screen in which there was no work: observers and promises have had their turn. */
  window.rest = (patience, workers) =>
    new Promise((resolve) => {
      const until = performance.now() + patience;
      let calm = 0;
      const look = () => {
        const now = work(workers);
        calm = now.length === 0 ? calm + 1 : 0;
        if (calm > 5) resolve("");
        else if (performance.now() > until) resolve(now.join(", ") || "little");
        else requestAnimationFrame(look);
      };
      look();
    });
}

/** The page has done all that it had begun, and draws nothing more; its workers may be left out. */
export async function atRest(page, { workers = true } = {}) {
  const work = await page.evaluate(
    ([patience, workers]) => window.rest(patience, workers),
    [PATIENCE, workers],
  );
  assert.equal(work, "", "the page is not at rest");
}

/**
 * A new page; `problems` fills with foreign requests, console errors and refusals of the policy. `first` runs in the page
 * before its scripts: a function, or one and what it gets.
 */
export async function newPage(studio, { first, ...options } = {}, hash = "") {
  const context = await studio.browser.newContext({
    viewport: { width: 1280, height: 800 },
    acceptDownloads: true,
    // The routes below see no request that a service worker answers. Its own tests are in offline.test.mjs.
    serviceWorkers: "block",
    ...options,
  });
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const problems = [];
  const own = new URL(studio.address).origin.replaceAll(".", "\\.");
  await context.route(new RegExp(`^(?!${own}/|blob:|data:)`), (route) => {
    problems.push(`request to ${route.request().url()}`);
    return route.abort();
  });
  await context.addInitScript(noteWork);
  if (first) await context.addInitScript(...[first].flat());
  const page = await context.newPage();
  page.setDefaultTimeout(20_000);
  page.on("console", (message) => {
    // known.bin is optional: a host without it answers 404, and the browser says so.
    const optional = message.location().url.endsWith("known.bin");
    if (message.type() === "error" && !optional) problems.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => problems.push(`page: ${error.message}`));
  await page.goto(studio.address + hash);
  return { page, problems, context };
}

/** How many different colours a canvas shows, sampled as the screen does. */
export async function colors(page, selector) {
  const png = await page.locator(selector).screenshot();
  return page.evaluate(async (base64) => {
    const blob = new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "image/png" });
    const bitmap = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const seen = new Set(
      new Uint32Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer),
    );
    return seen.size;
  }, png.toString("base64"));
}

/** The text of the file that a button downloads, after the tab of a panel was opened. */
export async function saved(page, button, tab) {
  if (tab) await page.getByRole("radio", { name: tab, exact: true }).check();
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: button }).first().click();
  return readFile(await (await waiting).path(), "utf8");
}
