// A fit says the same in the page, by the program and by Python: the cases of tests/data/parity.json.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { test } from "node:test";
import { runSteps } from "./steps.mjs";

const at = (path) => new URL(`../../${path}`, import.meta.url);
const { times, cases } = JSON.parse(readFileSync(at("tests/data/parity.json")));

/** Without what depends on the clock. */
function withoutTimes(report) {
  for (const key of times) {
    const place = key.split(".");
    const last = place.pop();
    const inner = place.reduce((outer, step) => outer[step], report);
    if (inner !== null) delete inner[last];
  }
  return report;
}

for (const { name, goal, options, report } of cases) {
  test(name, async () => {
    const pleach = await import("../src/wasm/pleach_web.js");
    await pleach.default({ module_or_path: readFileSync(at("web/src/wasm/pleach_web_bg.wasm")) });
    const read = pleach.Goal.read(basename(goal), readFileSync(at(goal)), "auto");
    const fit = new pleach.Fit(read, JSON.stringify(options));
    const families = runSteps(fit, pleach.Evaluator);
    assert.equal(families.length > 0, name === "a race");
    const found = withoutTimes(JSON.parse(fit.finish(() => {})).report);
    assert.deepEqual(Object.keys(found).sort(), Object.keys(report).sort());
    for (const [key, value] of Object.entries(report)) assert.deepEqual(found[key], value, key);
  });
}
