// Trees, silhouettes, blends and a fit have the bits of the library on every other platform: those of
// tests/data/bits.csv, which the library's own test compares with what it gives.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { runSteps } from "./steps.mjs";

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const expected = readFileSync(at("../../tests/data/bits.csv"), "utf8").trim().split("\n").slice(1);
const drawings = readFileSync(at("../public/known.bin"));
const palm = readFileSync(at("../../targets/palm.png"));

/**
 * Everything that is compared, by the functions of a loaded module; runs in Node and in the browser. With `drawings` of
 * the known species, as in the page, the fit need not grow them all; in parity.test.mjs it does.
 */
function bits(pleach, runSteps, names, goal, drawings) {
  const fnv = (bytes) => {
    let hash = 0xcbf29ce484222325n;
    for (const byte of bytes) hash = ((hash ^ BigInt(byte)) * 0x100000001b3n) & 0xffffffffffffffffn;
    return hash.toString(16).padStart(16, "0");
  };
  const text = (string) => fnv(new TextEncoder().encode(string));
  const map = new pleach.BlendMap("numbers");
  return names.map((name) => {
    const [what, ...of] = name.split(" ");
    if (what === "map") return `${name},${text(map.at(Number(of[0]), Number(of[1]), "blend").to_toml())}`;
    if (what === "fit") {
      const options = { height: 14, evaluations: 300, individual: "off" };
      const fit = new pleach.Fit(pleach.Goal.read("palm.png", goal, "auto"), JSON.stringify(options));
      fit.use_drawings(drawings);
      runSteps(fit, pleach.Evaluator);
      return `${name},${text(JSON.parse(fit.finish(() => {})).toml)}`;
    }
    const tree = pleach.Species.named(of[0]).grow(1, true);
    const hash = what === "tree" ? tree.digest() : fnv(tree.silhouette(256, 0, 0));
    tree.free();
    return `${name},${hash}`;
  });
}

const names = expected.map((line) => line.split(",")[0]);

test("in Node", async () => {
  const pleach = await import("../src/wasm/pleach_web.js");
  await pleach.default({ module_or_path: readFileSync(at("../src/wasm/pleach_web_bg.wasm")) });
  assert.deepEqual(bits(pleach, runSteps, names, palm, drawings), expected);
});

test("in Chromium", async () => {
  const types = { js: "text/javascript", wasm: "application/wasm" };
  const server = createServer((request, response) => {
    const name = request.url.slice(1);
    if (name === "known.bin") return response.end(drawings);
    if (!/^pleach_web(_bg)?\.(js|wasm)$/.test(name)) return response.end("<!doctype html>");
    response.setHeader("content-type", types[name.split(".").pop()]);
    return response.end(readFileSync(at(`../src/wasm/${name}`)));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox"],
  });
  try {
    const page = await browser.newPage();
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    const found = await page.evaluate(
      async ([source, steps, names, goal]) => {
        const pleach = await import("/pleach_web.js");
        await pleach.default({ module_or_path: fetch("/pleach_web_bg.wasm") });
        const drawings = new Uint8Array(await (await fetch("/known.bin")).arrayBuffer());
        const [of, runSteps] = [source, steps].map((text) => new Function(`return ${text}`)());
        return of(pleach, runSteps, names, Uint8Array.from(goal), drawings);
      },
      [bits.toString(), runSteps.toString(), names, [...palm]],
    );
    assert.deepEqual(found, expected);
  } finally {
    await browser.close();
    server.close();
  }
});
