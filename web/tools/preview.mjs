// The picture that goes with links to the page, of a fit on the built page: node tools/preview.mjs
import { fileURLToPath } from "node:url";
import { newPage, open } from "../tests/browser.mjs";

const studio = await open();
const { page } = await newPage(
  studio,
  { viewport: { width: 1200, height: 630 }, colorScheme: "light", reducedMotion: "reduce" },
  "#fit?goal=quaking_aspen",
);
await page.getByTestId("goal").waitFor();
await page.getByLabel("30 s").check();
await page.getByTestId("start").click();
await page.getByTestId("score").waitFor({ timeout: 180_000 });
await page.locator('[data-testid="model"][data-state="shown"]').waitFor({ timeout: 60_000 });
await page.waitForTimeout(4000);
const path = fileURLToPath(new URL("../public/preview.jpg", import.meta.url));
await page.screenshot({ path, type: "jpeg", quality: 86 });
await studio.close();
