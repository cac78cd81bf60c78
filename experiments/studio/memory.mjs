// What a browser holds after many fits: node experiments/studio/memory.mjs [FITS]
// web/dist has to be built. Each fit is short, of another goal than the one before; what is held is read after the page
// has come to rest, from the system: all processes of the page, in megabytes.

import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const tests = join(dirname(fileURLToPath(import.meta.url)), "../../web/tests");
const { atRest, open } = await import(join(tests, "browser.mjs"));
const { fitRoom, shortFit } = await import(join(tests, "fit-room.mjs"));
const fits = Number(process.argv[2] ?? 20);
const GOALS = ["palm", "acer", "quaking_aspen", "silver_birch"];

const studio = await open();
const { page, context } = await fitRoom(studio, `#fit?goal=${GOALS[0]}`);
const browser = await studio.browser.newBrowserCDPSession();
const own = await context.newCDPSession(page);
await own.send("HeapProfiler.enable");

async function held() {
  await atRest(page);
  await own.send("HeapProfiler.collectGarbage");
  const { processInfo } = await browser.send("SystemInfo.getProcessInfo");
  const pages = processInfo.filter(({ type }) => type === "renderer").map(({ id }) => id);
  const resident = pages.map((id) => {
    try {
      return Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8"))?.[1] ?? 0) / 1e3;
    } catch {
      // It has ended since.
      return 0;
    }
  });
  const { usedSize } = await own.send("Runtime.getHeapUsage");
  const card = await page.evaluate(() => window.studio.memory());
  return { resident: resident.reduce((sum, each) => sum + each, 0), heap: usedSize / 1e6, card };
}

const told = ({ resident, heap, card }) =>
  `${resident.toFixed(0)} MB resident, ${heap.toFixed(1)} MB of objects, ${JSON.stringify(card)}`;
console.log(`before: ${told(await held())}`);
for (let number = 1; number <= fits; number += 1) {
  const goal = GOALS[number % GOALS.length];
  await page.getByLabel("Goals of the page").selectOption(`${goal}.png`);
  await page.getByTestId("score").waitFor({ state: "detached" });
  await shortFit(page, goal);
  console.log(`${number}, ${goal}: ${told(await held())}`);
}
await studio.close();
