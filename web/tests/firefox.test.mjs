// The main ways through the page in Firefox: gallery, species, a photograph, a fit, its GLB, and without a network.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import validator from "gltf-validator";
import { dist } from "./browser.mjs";
import { findFirefox, openFirefox } from "./firefox.mjs";
import { colorPng } from "./pictures.mjs";
import { serve } from "./server.mjs";

const path = findFirefox();
const skip = path ? false : "no Firefox is found: put firefox-esr into PATH, or its path into FIREFOX";
if (skip) console.log(`Firefox is not tried: ${skip}`);

let server;
let firefox;
before(async () => {
  if (skip) return;
  server = await serve(dist);
  firefox = await openFirefox(path);
});
after(async () => {
  await firefox?.close();
  server?.close();
});

const isThere = (selector) => firefox.wait((selector) => document.querySelector(selector) !== null, selector);

/** How many colours a canvas shows. */
const colors = (selector) =>
  firefox.evaluate((selector) => {
    const shown = document.querySelector(selector);
    const canvas = new OffscreenCanvas(shown.width, shown.height);
    const context = canvas.getContext("2d");
    context.drawImage(shown, 0, 0);
    const { data } = context.getImageData(0, 0, shown.width, shown.height);
    return new Set(new Uint32Array(data.buffer)).size;
  }, selector);

/** Options of a fit that is over soon. */
const SHORT = { evaluations: 30, timeout: undefined, from: "palm", size: 64, individual: "off" };

/** An oak of a child's drawing before a pale sky. */
const at = (x, y) => {
  const light = ((x * 7 + y * 13) % 31) * 2;
  const isCrown = (x - 150) ** 2 + (y - 110) ** 2 < 80 ** 2;
  const isTrunk = Math.abs(x - 150) < 12 && y > 150 && y < 285;
  if (isCrown) return [60 + light, 105 + light, 30];
  return isTrunk ? [80 + (light >> 1), 62, 45] : [170, 200 + (y >> 4), 235];
};

test("gallery, species, photograph, fit, GLB, and all of it without a network", { skip }, async (t) => {
  await firefox.go(`${server.address}#gallery`);
  await isThere(".thumb.drawn");
  assert.ok((await colors(".thumb.drawn")) > 3, "a picture of one colour");

  await firefox.go(`${server.address}#species?s=palm`);
  await isThere('[data-testid="counts"] dd');
  const webgl = await firefox.evaluate(() => new OffscreenCanvas(1, 1).getContext("webgl2") !== null);
  t.diagnostic(webgl ? "with WebGL" : "without WebGL: trees are flat pictures");
  await isThere(webgl ? '[data-testid="tree"]' : ".flat .thumb.drawn");

  await firefox.click('.rooms a[href="#fit"]');
  await isThere('[data-testid="works-offline"]');

  // A photograph, dropped.
  await firefox.evaluate(
    (base64) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const files = new DataTransfer();
      files.items.add(new File([bytes], "garden.png", { type: "image/png" }));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
    },
    colorPng(300, 300, at).toString("base64"),
  );
  await firefox.wait(() => /garden/.test(document.querySelector(".facts")?.textContent));
  const share = await firefox.evaluate(() =>
    Number(/(\d+) % tree/.exec(document.querySelector('[data-testid="goal"]').ariaLabel)?.[1]),
  );
  assert.ok(share > 20 && share < 32, `${share} % of the photograph are tree`);

  // A short fit, and its file: of a goal of the page, since trees for photographs take their time.
  await firefox.evaluate(() => {
    const goals = document.querySelector('[aria-label="Goals of the page"]');
    goals.value = "palm.png";
    goals.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await firefox.wait(() => /palm/.test(document.querySelector(".facts")?.textContent));
  await firefox.evaluate((options) => window.studio.tell(options), SHORT);
  await firefox.click('[data-testid="start"]');
  await isThere('[data-testid="score"]');
  await firefox.click('[data-testid="fit-glb"]');
  const { info, issues } = await validator.validateBytes(new Uint8Array(await firefox.downloaded(".glb")));
  assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 5)));
  assert.ok(info.totalTriangleCount > 500);

  // The host is gone.
  server.close();
  await firefox.inBrowser(() => {
    Services.io.offline = true;
  });
  await firefox.go(`${server.address}index.html#gallery`);
  await isThere(".thumb.drawn");
  assert.deepEqual(await firefox.problems(server.address), []);
});
