// Copies the goal pictures of ../targets into public/targets and lists them, so that the page can offer them.
import { copyFileSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";

const from = new URL("../../targets/", import.meta.url);
const to = new URL("../public/targets/", import.meta.url);
mkdirSync(to, { recursive: true });
const names = readdirSync(from)
  .filter((name) => name.endsWith(".png"))
  .sort();
for (const name of names) copyFileSync(new URL(name, from), new URL(name, to));
writeFileSync(new URL("list.json", to), `${JSON.stringify(names)}\n`);
console.log(`${names.length} goal pictures in public/targets`);
