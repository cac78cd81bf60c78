// Ten tasks of people from beginning to end, with what they press and how long the page takes:
// node experiments/studio/tasks.mjs [--quick] [TASK...]
// web/dist has to be built. Writes tasks.csv beside this file, unless only some tasks are asked for or all are quick: with
// searches of a few trees, to see whether they can still be done.

import { writeFileSync } from "node:fs";
import { loadavg } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const tests = join(here, "../../web/tests");
const { newPage, open, PATIENCE } = await import(join(tests, "browser.mjs"));
const { drop, library, tell } = await import(join(tests, "fit-room.mjs"));
const { colorPng } = await import(join(tests, "pictures.mjs"));

const quick = process.argv.includes("--quick");
const asked = process.argv.slice(2).filter((each) => each !== "--quick");

/** A person at a page: every press counts. Dragging a file onto the page, or moving to a place of the map, is one too. */
class Person {
  clicks = 0;
  keys = 0;

  constructor(page, touches = false) {
    this.page = page;
    this.touches = touches;
    page.setDefaultTimeout(PATIENCE);
  }

  async click(target, options = {}) {
    this.clicks += 1;
    const found = typeof target === "string" ? this.page.getByTestId(target) : target;
    await (this.touches ? found.first().tap(options) : found.first().click(options));
  }

  button = (name) => this.click(this.page.getByRole("button", { name, exact: true }));
  room = (name) => this.click(this.page.getByRole("link", { name }));
  part = (name) =>
    this.click(this.page.locator(".segmented label", { has: this.page.getByRole("radio", { name, exact: true }) }));

  async press(key) {
    this.keys += 1;
    await this.page.keyboard.press(key);
  }

  async type(text) {
    this.keys += text.length;
    await this.page.keyboard.type(text);
  }

  async pick(list, value) {
    this.clicks += 2;
    await this.page.getByLabel(list).selectOption(value);
  }

  async drop(name, bytes) {
    this.clicks += 1;
    await drop(this.page, name, bytes);
  }

  async download(press) {
    const waiting = this.page.waitForEvent("download", { timeout: 4 * PATIENCE });
    await press();
    await (await waiting).path();
  }

  /** Tab until a button has the focus. */
  async tabTo(is) {
    for (let tries = 0; tries < 200; tries += 1) {
      if (await this.page.evaluate(is)) return;
      await this.press("Tab");
    }
    throw new Error(`no Tab leads to ${is}`);
  }

  async shorten() {
    if (quick) await tell(this.page, { evaluations: 30, from: "palm", size: 64, individual: "off" });
  }

  async fit() {
    await this.shorten();
    await this.click("start");
  }

  done = (testid) => this.page.getByTestId(testid).first().waitFor({ timeout: 4 * PATIENCE });
  treeGrown = () => this.page.locator('[data-testid="counts"] dd').first().waitFor({ timeout: PATIENCE });
}

const studio = await open();

/** A tree before a sky, as a photograph of 800 × 800 pixels. */
const side = 800;
const silhouette = (await library()).Species.named("quaking_aspen").grow(1, true).silhouette(side, 0, 0);
const photograph = colorPng(side, side, (x, y) => {
  const light = ((x * 7 + y * 13) % 31) * 3;
  return silhouette[y * side + x] ? [70 + light, 110 + light, 30] : [150 + (y >> 4), 190 + (y >> 5), 235];
});

/** From a photograph to a result, with the shortest search that the page offers. */
async function fitPhotograph(person) {
  await person.drop("garden.png", photograph);
  await person.page.locator(".facts", { hasText: "garden" }).waitFor();
  await person.part("10 s");
  await person.fit();
  await person.done("score");
}

/** A fit of one of the page's own goals. */
async function fitGoal(person, goal) {
  await person.pick("Goals of the page", `${goal}.png`);
  await person.page.locator(".facts", { hasText: goal.replaceAll("_", " ") }).waitFor();
  await person.fit();
  await person.done("score");
}

/** Adds to a slider of the handles by keys, which is what a drag does. */
async function slide(person, handle, steps) {
  const slider = person.page.locator(`[data-handle="${handle}"] input[type="range"]`).first();
  person.clicks += 1;
  await slider.focus();
  for (let step = 0; step < steps; step += 1) await person.page.keyboard.press("ArrowRight");
}

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** Each with the room in which it begins. */
const TASKS = {
  "a photograph to a GLB": {
    hash: "#fit",
    async run(person) {
      await fitPhotograph(person);
      await person.download(() => person.click("fit-glb"));
    },
  },
  "more weeping, saved, the link sent": {
    hash: "#species?s=weeping_willow",
    async run(person) {
      await person.treeGrown();
      await slide(person, await person.page.locator("[data-handle]", { hasText: /droop/i }).first().getAttribute("data-handle"), 5);
      await person.part("Download");
      await person.button("Keep in my species");
      await person.page.getByText("is kept in my species").waitFor();
      await person.click("copy-link");
      await person.page.getByText("The link is copied").waitFor();
    },
  },
  "a tree between oak and willow": {
    hash: "#gallery",
    async run(person) {
      const { page } = person;
      await person.click(page.locator(".card button", { hasText: "black oak" }));
      await page.getByTestId("blend-with").waitFor();
      await person.pick("Blend with", "built:weeping_willow");
      await page.getByTestId("blend-at").waitFor();
      await page.waitForFunction(() => !document.querySelector(".busy.on"));
    },
  },
  "going on with yesterday's fit": {
    hash: "#fit?goal=palm",
    async before(person) {
      await person.part("10 s");
      await person.fit();
      await person.done("score");
      await person.click("keep-fit");
      await person.page.getByTestId("kept-fit").waitFor();
      await person.pick("Goals of the page", "acer.png");
      await person.page.reload();
    },
    async run(person) {
      await person.button("Open palm");
      await person.done("score");
      await person.fit();
      await person.page.getByTestId("pause").waitFor();
      await person.page.getByTestId("pause").waitFor({ state: "detached", timeout: 4 * PATIENCE });
      await person.done("score");
    },
  },
  "two fits, compared": {
    hash: "#fit?goal=palm",
    async run(person) {
      await person.part("10 s");
      await person.fit();
      await person.done("score");
      await person.click("keep-fit");
      await fitGoal(person, "quaking_aspen");
      await person.click("keep-fit");
      await person.page.getByTestId("kept-fit").nth(1).waitFor();
      for (const at of [0, 1]) await person.click(person.page.getByLabel("Compare").nth(at));
      await person.page.getByTestId("comparison").locator("table").waitFor();
    },
  },
  "a photograph to a GLB on a telephone": {
    hash: "#fit",
    options: PHONE,
    async run(person) {
      await fitPhotograph(person);
      await person.download(() => person.click("fit-glb"));
    },
  },
  "a goal to a GLB by keys alone": {
    hash: "#fit",
    async run(person) {
      await person.page.locator(".targets button").first().waitFor();
      await person.tabTo(() => document.activeElement?.closest(".targets") !== null);
      await person.press("Enter");
      // Nobody presses Tab before the panel is there.
      await person.page.getByTestId("start").waitFor();
      await person.tabTo(() => document.activeElement?.dataset.testid === "start");
      await person.shorten();
      await person.press("Enter");
      await person.done("score");
      await person.page.getByTestId("fit-glb").waitFor();
      await person.tabTo(() => document.activeElement?.dataset.testid === "fit-glb");
      await person.download(() => person.press("Enter"));
    },
  },
  "a fit without a network": {
    hash: "#fit",
    options: { serviceWorkers: "allow" },
    async before(person) {
      await person.page.getByTestId("works-offline").waitFor({ timeout: PATIENCE });
      await person.page.context().setOffline(true);
    },
    async run(person) {
      await person.page.reload();
      await person.button("palm");
      await person.page.getByTestId("goal").waitFor();
      await person.part("10 s");
      await person.fit();
      await person.done("score");
      await person.download(() => person.click("fit-glb"));
    },
  },
  "a grammar of one's own": {
    hash: "#gallery",
    async run(person) {
      const { page } = person;
      await person.room("Species");
      await person.pick("Start from", "built:abop_plant_f");
      await person.part("Grammar");
      await page.getByLabel("Text of the grammar").waitFor();
      await person.treeGrown();
      person.clicks += 1;
      await page.getByLabel("Text of the grammar").evaluate((area) => {
        area.focus();
        area.setSelectionRange(area.value.indexOf("X -> F") + 6, area.value.indexOf("X -> F") + 6);
      });
      // A mistake, its words, and its mending.
      await person.type("[/(9)");
      await page.locator(".codeline.wrong .remark").waitFor();
      const before = await page.getByTestId("tree").getAttribute("aria-label");
      await person.type("+X]");
      await page.locator(".codeline.wrong .remark").waitFor({ state: "detached" });
      await page.waitForFunction(
        (before) => document.querySelector('[data-testid="tree"]').ariaLabel !== before,
        before,
      );
      await person.part("Download");
      await person.button("Keep in my species");
      await page.getByText("is kept in my species").waitFor();
    },
  },
};

const rows = [["task", "clicks", "keys", "seconds"]];
const [load] = loadavg();
for (const [name, { hash, options, before, run }] of Object.entries(TASKS)) {
  if (asked.length > 0 && !asked.some((each) => name.includes(each))) continue;
  const { page, problems, context } = await newPage(studio, options, hash);
  const person = new Person(page, options === PHONE);
  try {
    await before?.(person);
    person.clicks = person.keys = 0;
    const begun = performance.now();
    await run(person);
    const seconds = ((performance.now() - begun) / 1000).toFixed(1);
    rows.push([name, person.clicks, person.keys, seconds]);
    console.log(`${name}: ${person.clicks} clicks, ${person.keys} keys, ${seconds} s`);
    const own = problems.filter((text) => !text.includes("ERR_INTERNET_DISCONNECTED"));
    if (own.length > 0) console.log(`  but: ${own.join("; ")}`);
  } catch (error) {
    process.exitCode = 1;
    console.log(`${name}: not done, ${error.message.split("\n")[0]}`);
  }
  await context.close();
}
await studio.close();
console.log(`The load of the machine was ${load.toFixed(1)} before the first task.`);
if (asked.length === 0 && !quick) {
  const cell = (value) => (String(value).includes(",") ? `"${value}"` : value);
  writeFileSync(join(here, "tasks.csv"), `${rows.map((row) => row.map(cell).join(",")).join("\n")}\n`);
}
