// A browser on the built page, which lets no request leave the page's own origin.
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
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
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

/** A new page; `problems` fills with foreign requests, console errors and refusals of the policy. */
export async function newPage(studio, options = {}, hash = "") {
  const context = await studio.browser.newContext({
    viewport: { width: 1280, height: 800 },
    acceptDownloads: true,
    // The routes below see no request that a service worker answers. Its own tests are in offline.test.mjs.
    serviceWorkers: "block",
    ...options,
  });
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const problems = [];
  const origin = new URL(studio.address).origin;
  await context.route("**/*", (route) => {
    const address = route.request().url();
    if (address.startsWith(origin) || /^(blob|data):/.test(address)) return route.continue();
    problems.push(`request to ${address}`);
    return route.abort();
  });
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
