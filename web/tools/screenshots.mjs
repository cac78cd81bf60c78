// Pictures of every room, light, dark and narrow: node tools/screenshots.mjs FOLDER [ROOM...]
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { newPage, open } from "../tests/browser.mjs";

const [folder = "screenshots", ...only] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });

const LOOKS = [
  { look: "light", options: { colorScheme: "light" } },
  { look: "dark", options: { colorScheme: "dark" } },
  { look: "narrow", options: { viewport: { width: 360, height: 740 }, hasTouch: true } },
];

const ROOMS = {
  welcome: { hash: "#fit", ready: (page) => page.locator(".targets img").first().waitFor() },
  fit: {
    hash: "#fit?goal=quaking_aspen",
    async ready(page) {
      await page.getByTestId("goal").waitFor();
      await page.getByLabel("10 s").check();
      await page.getByTestId("start").click();
      await page.getByTestId("overlay").waitFor();
      await page.waitForTimeout(3000);
    },
  },
  done: {
    hash: "#fit?goal=palm",
    async ready(page) {
      await page.getByTestId("goal").waitFor();
      await page.getByLabel("10 s").check();
      await page.getByTestId("start").click();
      await page.getByTestId("score").waitFor();
      await page.waitForTimeout(3000);
    },
  },
  map: {
    hash: "#map",
    async ready(page) {
      await page.getByTestId("plane").waitFor();
      await page.waitForTimeout(2500);
      const box = await page.getByTestId("plane").boundingBox();
      await page.mouse.click(box.x + box.width * 0.55, box.y + box.height * 0.45);
      await page.getByTestId("under").waitFor({ state: "attached" });
      await page.waitForTimeout(1500);
    },
  },
  species: {
    hash: "#species",
    async ready(page) {
      await page.getByTestId("counts").waitFor();
      await page.waitForTimeout(5000);
    },
  },
  gallery: {
    hash: "#gallery",
    async ready(page) {
      await page.locator(".thumb.drawn").nth(3).waitFor({ state: "attached" });
      // All that are in view, however long they take.
      await page.waitForFunction(
        () =>
          [...document.querySelectorAll(".thumb:not(.drawn)")].every(
            (thumb) => thumb.getBoundingClientRect().top >= innerHeight,
          ),
        null,
        { timeout: 60_000 },
      );
    },
  },
};

const studio = await open();
for (const [name, { hash, ready }] of Object.entries(ROOMS)) {
  if (only.length > 0 && !only.includes(name)) continue;
  for (const { look, options } of LOOKS) {
    const { page, problems, context } = await newPage(studio, options, hash);
    try {
      await ready(page);
    } catch (error) {
      console.error(`${name} ${look}: ${error.message.split("\n")[0]}`);
    }
    await page.screenshot({ path: join(folder, `${name}-${look}.png`) });
    if (problems.length > 0) console.error(`${name} ${look}: ${problems.join("; ")}`);
    await context.close();
  }
}
await studio.close();
