// Copies the goal pictures of ../targets into public/targets and lists them, so that the page can offer them.
import { copyFileSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { step } from "./step.mjs";

const copied = step("goals: pictures that the page offers");

const from = new URL("../../targets/", import.meta.url);
const to = new URL("../public/targets/", import.meta.url);
mkdirSync(to, { recursive: true });
const names = readdirSync(from)
  .filter((name) => name.endsWith(".png"))
  .sort();
for (const name of names) copyFileSync(new URL(name, from), new URL(name, to));
writeFileSync(new URL("list.json", to), `${JSON.stringify(names)}\n`);
copied(`${names.length} in public/targets`);
