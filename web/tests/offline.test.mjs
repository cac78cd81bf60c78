// The page without a network, and newer builds of it.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { buildOf, writeBuild } from "../tools/offline.mjs";
import { atRest, dist, newPage, open, PATIENCE } from "./browser.mjs";
import { shortFit } from "./fit-room.mjs";

const WORKERS = { serviceWorkers: "allow" };

/** A browser and a host, which end with the test. */
async function opened(t, copy) {
  const studio = await open(copy?.folder);
  t.after(async () => {
    await studio.close();
    copy?.remove();
  });
  return studio;
}

const ready = (page) => page.getByTestId("works-offline").waitFor({ timeout: PATIENCE });

test("after the first visit the page opens, grows a species and fits a goal without a network", async (t) => {
  const studio = await opened(t);
  const { page, problems, context } = await newPage(studio, WORKERS, "#fit");
  await ready(page);
  studio.cutNetwork();
  await context.setOffline(true);
  assert.equal(await page.evaluate(() => fetch("./no-such-file").catch(() => "cut")), "cut");
  await page.reload();
  await ready(page);
  await page.getByRole("link", { name: "Species" }).click();
  await page.locator('[data-testid="counts"] dd').first().waitFor({ timeout: PATIENCE });
  await page.getByRole("link", { name: "Fit" }).click();
  await page.getByRole("button", { name: "palm", exact: true }).click();
  await page.getByTestId("goal").waitFor();
  await shortFit(page);
  await page.locator('[data-testid="model"][data-state="shown"]').waitFor({ timeout: PATIENCE });
  const other = await context.newPage();
  await other.goto(`${studio.address}index.html#gallery`);
  await other.locator(".thumb.drawn").first().waitFor({ timeout: PATIENCE });
  assert.deepEqual(
    problems.filter((text) => !text.includes("ERR_INTERNET_DISCONNECTED")),
    [],
  );
});

test("nothing is said of working offline where the copy is incomplete or there is none", async (t) => {
  const studio = await opened(t);
  const first = () => {
    window.answers = 0;
    window.MessageChannel = class extends MessageChannel {
      constructor() {
        super();
        this.port1.addEventListener("message", () => window.answers++);
      }
    };
  };
  const { page, context } = await newPage(studio, { ...WORKERS, first }, "#fit");
  await ready(page);
  await page.evaluate(async () => {
    const [name] = await caches.keys();
    const cache = await caches.open(name);
    await cache.delete((await cache.keys()).find(({ url }) => url.endsWith(".wasm")));
  });
  await page.reload();
  await page.locator(".targets img").first().waitFor();
  // The service worker has said whether it has all.
  await page.waitForFunction(() => window.answers === 1);
  await atRest(page);
  assert.equal(await page.getByTestId("works-offline").count(), 0);
  await context.close();
  const blocked = await newPage(studio, {}, "#fit");
  await blocked.page.locator(".targets img").first().waitFor();
  await blocked.page.waitForLoadState();
  await atRest(blocked.page);
  assert.equal(await blocked.page.getByTestId("works-offline").count(), 0);
});

/** A copy of the built page, which becomes another build as a new version on a host does. */
function copyOfPage() {
  const folder = mkdtempSync(join(tmpdir(), "pleach-page-"));
  cpSync(dist, folder, { recursive: true });
  const files = () => buildOf(folder).files.map(([path]) => path);
  const change = (path, edit) =>
    writeFileSync(join(folder, path), edit(readFileSync(join(folder, path), "utf8")));
  const rename = (pattern, stamp) => {
    const before = files().find((path) => pattern.test(path));
    const after = before.replace(/-[^-]+(\.\w+)$/, `-${stamp}$1`);
    renameSync(join(folder, before), join(folder, after));
    const [old, next] = [before, after].map((path) => path.replace("assets/", ""));
    for (const path of files().filter((each) => /\.(js|html)$/.test(each))) {
      change(path, (text) => text.replaceAll(old, next));
    }
  };
  return {
    folder,
    build: () => buildOf(folder),
    /** All files with a hash in their name have another one, and the page says which build it is. */
    update(stamp) {
      const before = JSON.stringify(buildOf(folder));
      for (const pattern of [/_bg-.*wasm$/, /worker-.*js$/, /tree-view-.*js$/, /index-.*js$/])
        rename(pattern, stamp);
      change("index.html", (text) =>
        text.replace(/<html lang="en"[^>]*>/, `<html lang="en" data-build="${stamp}">`),
      );
      writeBuild(folder, before);
    },
    change,
    remove: () => rmSync(folder, { recursive: true }),
  };
}

const buildShown = (page) => page.evaluate(() => document.documentElement.dataset.build ?? "first");
const offered = (page) => page.locator(".note", { hasText: "There is a new version of this page." });
const grown = async (page) => {
  await page.getByRole("link", { name: "Species" }).click();
  await page.locator('[data-testid="counts"] dd').first().waitFor({ timeout: PATIENCE });
};

test("a newer build is taken whole, by the only tab, and leaves nothing of the older one", async (t) => {
  const copy = copyOfPage();
  const studio = await opened(t, copy);
  const { page, problems, context } = await newPage(studio, WORKERS, "#fit");
  await ready(page);
  copy.update("second00");
  await page.reload();
  await offered(page).waitFor({ timeout: PATIENCE });
  // The files of the older build are not on the host any more, and the page still has all of them.
  assert.equal(await buildShown(page), "first");
  await grown(page);

  const other = await context.newPage();
  await other.goto(`${studio.address}#gallery`);
  await other.locator(".thumb.drawn").first().waitFor({ timeout: PATIENCE });
  assert.equal(await buildShown(other), "first");
  await page.bringToFront();
  await page.getByRole("button", { name: "Load it" }).click();
  await page.getByText("The page is open in other tabs too.").waitFor();
  assert.equal(await buildShown(page), "first");
  await other.close();

  await page.getByRole("button", { name: "Load it" }).click();
  await page.waitForFunction(() => document.documentElement.dataset.build === "second00");
  await grown(page);
  const kept = await page.evaluate(() => caches.keys());
  assert.deepEqual(
    kept.map((name) => name.split(" ").at(-1)),
    [copy.build().version],
  );
  const workers = await page.evaluate(() =>
    performance.getEntriesByType("resource").filter(({ name }) => name.endsWith(".wasm")),
  );
  assert.ok(workers.length > 0 && workers.every(({ name }) => name.endsWith("second00.wasm")), `${workers}`);
  assert.deepEqual(problems, []);
});

test("a page that no service worker controls is loaded again with the newer build too", async (t) => {
  const copy = copyOfPage();
  const studio = await opened(t, copy);
  const { page, context } = await newPage(studio, WORKERS, "#fit");
  await ready(page);
  // The tab that keeps the older service worker: without it the newer one would not wait.
  const other = await context.newPage();
  await other.goto(`${studio.address}#gallery`);
  await other.locator(".thumb.drawn").first().waitFor({ timeout: PATIENCE });
  copy.update("second00");
  await page.reload();
  await offered(page).waitFor({ timeout: PATIENCE });
  const session = await context.newCDPSession(page);
  await session.send("Page.reload", { ignoreCache: true });
  await offered(page).waitFor({ timeout: PATIENCE });
  assert.equal(await page.evaluate(() => navigator.serviceWorker.controller), null);
  await other.close();
  await page.evaluate(() => {
    document.documentElement.dataset.build = "not loaded again";
  });
  await page.getByRole("button", { name: "Load it" }).click();
  await page.waitForFunction(() => document.documentElement.dataset.build === "second00");
});

test("another copy of the page below this one's path does not keep a newer build from it", async (t) => {
  const copy = copyOfPage();
  const studio = await opened(t, copy);
  const { page, context } = await newPage(studio, WORKERS, "#fit");
  await ready(page);
  copy.update("second00");
  cpSync(dist, join(copy.folder, "beta"), { recursive: true });
  await page.reload();
  await offered(page).waitFor({ timeout: PATIENCE });
  const beta = await context.newPage();
  await beta.goto(`${studio.address}beta/index.html#gallery`);
  await beta.locator(".thumb.drawn").first().waitFor({ timeout: PATIENCE });
  await page.bringToFront();
  await page.getByRole("button", { name: "Load it" }).click();
  await page.waitForFunction(() => document.documentElement.dataset.build === "second00");
  assert.equal(await buildShown(beta), "first");
});

test("a host in the middle of an update does not break the page", async (t) => {
  const copy = copyOfPage();
  const studio = await opened(t, copy);
  // What becomes of each newer service worker.
  const first = async () => {
    window.ends = [];
    const registration = await navigator.serviceWorker.getRegistration();
    const follow = () => {
      const worker = registration.installing;
      worker?.addEventListener("statechange", () => window.ends.push(worker.state));
    };
    registration?.addEventListener("updatefound", follow);
    if (registration) follow();
  };
  const { page } = await newPage(studio, { ...WORKERS, first }, "#fit");
  await ready(page);
  copy.update("second00");
  // One file is not the one that the new list names.
  copy.change("targets/list.json", (text) => `${text} `);
  await page.reload();
  await page.waitForFunction(() => window.ends.includes("redundant"), null, { timeout: PATIENCE });
  await atRest(page);
  assert.equal(await offered(page).count(), 0);
  await grown(page);
  assert.equal(await buildShown(page), "first");
});

test("two copies of the page on one host leave each other alone", async (t) => {
  const studio = await opened(t);
  const { page, context } = await newPage(studio, WORKERS, "#fit");
  await ready(page);
  const other = "pleach-studio /some/other/ 000000000000";
  await page.evaluate((name) => caches.open(name), other);
  await page.evaluate(async () => {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration.unregister();
  });
  await page.reload();
  await ready(page);
  assert.ok((await page.evaluate(() => caches.keys())).includes(other));
  await context.close();
});

test("the manifest has all that an app needs, and its icons are as large as it says", async (t) => {
  const studio = await opened(t);
  const { page } = await newPage(studio, {}, "#fit");
  const session = await page.context().newCDPSession(page);
  const { errors, data } = await session.send("Page.getAppManifest");
  assert.deepEqual(errors, []);
  const manifest = JSON.parse(data);
  assert.equal(manifest.display, "standalone");
  const { installabilityErrors } = await session.send("Page.getInstallabilityErrors");
  assert.deepEqual(
    // A private window cannot install anything.
    installabilityErrors.filter(({ errorId }) => errorId !== "in-incognito"),
    [],
  );
  for (const { src, sizes } of manifest.icons.filter(({ type }) => type === "image/png")) {
    const side = await page.evaluate(async (address) => {
      const image = await createImageBitmap(await (await fetch(address)).blob());
      return `${image.width}x${image.height}`;
    }, src);
    assert.equal(side, sizes, src);
  }
});

test("a link to the page has a picture of its own", async (t) => {
  const studio = await opened(t);
  const { page } = await newPage(studio, {}, "#fit");
  const tag = (name) => page.locator(`meta[property="${name}"]`).getAttribute("content");
  assert.ok((await tag("og:description")).length > 50);
  const image = await tag("og:image");
  const [width, height] = await page.evaluate(async (address) => {
    const picture = await createImageBitmap(await (await fetch(address)).blob());
    return [`${picture.width}`, `${picture.height}`];
  }, image);
  assert.deepEqual([width, height], [await tag("og:image:width"), await tag("og:image:height")]);
  assert.ok(statSync(join(dist, image)).size <= 200_000);
});
