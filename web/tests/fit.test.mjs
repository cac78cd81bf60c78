// A search in the fit room: it finds the tree, the page never stalls, and what is found stands in three dimensions.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import validator from "gltf-validator";
import { atRest, colors, newPage, open, PATIENCE, saved } from "./browser.mjs";
import { endless, fitRoom, fitted, inkOf, library, modelView, shortFit, start, trees } from "./fit-room.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

const fit = (hash) => fitRoom(studio, hash);

async function silhouetteOf(toml) {
  const species = (await library()).Species.read(toml, "best.toml");
  return species.grow(JSON.parse(species.info()).tree_seed ?? 1, true).silhouette(256, 0, 0);
}

test("a fit finds the palm, and its file grows the same tree in the program", async () => {
  const { page, problems, context } = await fit();
  const likeness = await fitted(page, { ...trees(150), individual: "400trees" });
  console.log(`likeness ${likeness}`);
  assert.ok(likeness >= 0.8);
  // What the picture says of the numbers: a palm is like those that the page has learnt from.
  const told = await page.getByLabel("What the picture determines").textContent();
  assert.match(told, /where nine in ten trees around palm that look so have the number/);
  assert.match(told, /base_size\[0\] [\d.]+ \([\d.]+ to [\d.]+\)/);
  const toml = await saved(page, "TOML");
  const file = process.env.FIT_TOML ?? join(mkdtempSync(join(tmpdir(), "studio-")), "best.toml");
  writeFileSync(file, toml);
  if (process.env.PLEACH) {
    const picture = file.replace(/\.toml$/, ".png");
    execFileSync(process.env.PLEACH, ["silhouette", file, "-o", picture, "--size", "256", "--quiet"]);
    assert.deepEqual(await inkOf(readFileSync(picture)), await silhouetteOf(toml));
  }
  // It is this very tree, with draws of its own; its kind is beside it.
  assert.match(toml, /^\[individual\]/m);
  const shown = () => page.getByTestId("overlay").evaluate((canvas) => canvas.toDataURL());
  const own = await shown();
  assert.equal(await page.getByText("How far this very tree lies on the goal.").count(), 1);
  await page.getByRole("radio", { name: "Its kind" }).check();
  assert.doesNotMatch(await saved(page, "TOML"), /\[individual\]/);
  await page.waitForFunction(
    (before) => document.querySelector('[data-testid="overlay"]').toDataURL() !== before,
    own,
  );
  assert.equal(await page.getByText("How far this very tree lies on the goal.").count(), 0);
  // A reload keeps the goal and both trees.
  await atRest(page);
  await page.reload();
  await page.getByTestId("score").waitFor();
  assert.equal(Number(await page.locator(".score .big").textContent()), likeness);
  assert.equal(await shown(), own);
  assert.deepEqual(problems, []);
  await context.close();
});

/** Counts the shaders that the page has linked from now on: in steps of their own, and while a frame was drawn. */
const countShaders = (page) =>
  page.evaluate(() => {
    window.shaders = { before: 0, whileDrawing: 0 };
    let isDrawing = false;
    const { requestAnimationFrame } = window;
    window.requestAnimationFrame = (draw) =>
      requestAnimationFrame((time) => {
        isDrawing = true;
        draw(time);
        isDrawing = false;
      });
    const { linkProgram } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.linkProgram = function (program) {
      window.shaders[isDrawing ? "whileDrawing" : "before"] += 1;
      linkProgram.call(this, program);
    };
  });

test("after a fit the tree that is exported stands in three dimensions beside its goal", async () => {
  const { page, problems, context } = await fit("#fit?goal=acer");
  await countShaders(page);
  await Promise.all([
    page.getByText("Drawing the tree").waitFor({ timeout: PATIENCE }),
    // As many trees as it takes to find one that is not just the kind's.
    fitted(page, { ...trees(40), from: "acer", individual: "200trees" }),
  ]);
  await modelView(page, "shown").waitFor({ timeout: PATIENCE });
  const { before: linked, whileDrawing } = await page.evaluate(() => window.shaders);
  assert.ok(linked > 4, `${linked} shaders for tree, shadow, meadow and sky`);
  assert.equal(whileDrawing, 0, "a frame waits for shaders");
  const [goal, tree] = await Promise.all(
    ["goal", "model"].map((name) => page.getByTestId(name).boundingBox()),
  );
  assert.ok(Math.abs(goal.y - tree.y) < 4 && tree.x > goal.x + goal.width, "beside the goal");
  assert.ok(tree.height >= goal.height * 0.9, "as large as the goal");
  assert.ok((await colors(page, '[data-testid="model"]')) > 1000, "bark, leaves, meadow and sky");
  const memory = () => page.evaluate(() => window.studio.memory());
  const held = await memory();
  // What is downloaded is what is seen, and the button says how large it is.
  const button = page.getByTestId("fit-glb");
  const [, triangles, size] = /GLB, ([\d,]+) triangles, ([\d.]+) MB/.exec(await button.textContent());
  const waiting = page.waitForEvent("download");
  await button.click();
  const bytes = new Uint8Array(readFileSync(await (await waiting).path()));
  const { info, issues } = await validator.validateBytes(bytes);
  assert.equal(issues.numErrors, 0);
  assert.equal(info.totalTriangleCount, Number(triangles.replaceAll(",", "")));
  assert.equal((bytes.length / 1e6).toFixed(1), size);
  const pictures = info.resources.filter(({ mimeType }) => mimeType === "image/png").length;
  assert.ok(pictures >= 3 && held.textures > pictures + 2, `${held.textures} of ${pictures} pictures`);
  // Its link has the species, and opens it elsewhere.
  await page.getByTestId("fit-link").click();
  await page.getByText("The link to this tree is copied.").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const elsewhere = await newPage(studio, {}, link.slice(link.indexOf("#")));
  await elsewhere.page.locator('[data-testid="counts"] dd').first().waitFor();
  const there = await saved(elsewhere.page, "TOML, the species file", "Download");
  assert.equal(there, await saved(page, "TOML"));
  await elsewhere.context.close();
  // Keys and the mouse turn it.
  const seen = async () => (await page.getByTestId("model").screenshot()).toString("base64");
  const before = await seen();
  await page.getByRole("group", { name: "View of the tree" }).focus();
  for (const key of ["ArrowLeft", "ArrowLeft", "+"]) await page.keyboard.press(key);
  const turned = await seen();
  assert.notEqual(turned, before);
  await page.mouse.move(tree.x + tree.width / 2, tree.y + tree.height / 2);
  await page.mouse.down();
  await page.mouse.move(tree.x + tree.width / 2 + 90, tree.y + tree.height / 2, { steps: 4 });
  await page.mouse.up();
  assert.notEqual(await seen(), turned);
  // Its kind takes the place of the tree, and nothing of that stays on the graphics card.
  await page.getByRole("radio", { name: "Its kind" }).check();
  await modelView(page, "busy").waitFor();
  await modelView(page, "shown").waitFor();
  await page.getByRole("radio", { name: "This very tree" }).check();
  await modelView(page, "shown").waitFor();
  await atRest(page);
  assert.deepEqual(await memory(), held);
  // In winter it is bare, and so is its file.
  const inLabel = async () =>
    Number(/GLB, ([\d,]+) triangles/.exec(await button.textContent())[1].replaceAll(",", ""));
  const full = await inLabel();
  await page.getByLabel("Season").selectOption("winter");
  // Without a file of that season there is no number in the label.
  await page.waitForFunction(
    (before) => {
      const label = document.querySelector('[data-testid="fit-glb"]').textContent;
      return /triangles/.test(label) && label !== before;
    },
    await button.textContent(),
  );
  const bare = await inLabel();
  assert.ok(bare < full, `${bare} triangles in winter, ${full} before`);
  await modelView(page, "shown").waitFor();
  const winter = page.waitForEvent("download");
  await button.click();
  assert.equal((await winter).suggestedFilename(), "acer-winter.glb");
  const usual = await page.evaluate(() => navigator.clipboard.readText());
  assert.doesNotMatch(usual, /season=/);
  await page.getByTestId("fit-link").click();
  await page.waitForFunction(async () => /season=winter/.test(await navigator.clipboard.readText()));
  await page.getByRole("link", { name: "Gallery" }).click();
  await page.locator(".card").first().waitFor();
  assert.equal(await memory(), null);
  assert.deepEqual(problems, []);
  await context.close();
});

test("while it is searched the best tree grows in three dimensions, with the same shaders", async () => {
  const { page, problems, context } = await fit("#fit?goal=acer");
  // Far from its goal, so that better trees follow each other.
  await start(page, endless("black_oak"));
  const growing = page.locator('[data-testid="growing"][data-state="growing"]');
  await growing.waitFor({ timeout: PATIENCE });
  const drawn = () => page.evaluate(() => window.studio.search().drawn);
  const nextAfter = async ({ trees }) => {
    await page.waitForFunction((trees) => window.studio.search().drawn.trees > trees, trees, {
      timeout: PATIENCE,
    });
    return drawn();
  };
  // The first is the nearest known tree, which may have other leaves.
  const before = await nextAfter(await drawn());
  assert.ok(before.programs > 0);
  assert.ok((await colors(page, '[data-testid="growing"]')) > 1000, "bark, leaves, meadow and sky");
  assert.equal((await nextAfter(before)).programs, before.programs);
  // Keys turn it.
  const picture = async () => (await growing.screenshot()).toString("base64");
  const seen = await picture();
  await growing.getByRole("group").focus();
  for (let at = 0; at < 4; at++) await page.keyboard.press("ArrowLeft");
  assert.notEqual(await picture(), seen);
  await page.getByTestId("stop").click();
  await page.getByTestId("score").waitFor({ timeout: PATIENCE });
  await modelView(page, "shown").waitFor({ timeout: PATIENCE });
  assert.equal(await growing.count(), 0, "the fitted tree takes its place");
  // One of eight others takes the place of the tree, and is what is saved.
  const others = page.getByLabel("Other trees of the kind").getByRole("button");
  assert.equal(await others.count(), 8);
  await others.nth(2).click();
  await page.getByRole("radio", { name: "Seed 4" }).waitFor();
  assert.equal(await others.nth(2).getAttribute("aria-pressed"), "true");
  await modelView(page, "shown").waitFor({ timeout: PATIENCE });
  assert.match(await saved(page, "TOML"), /^tree_seed = 4$/m);
  await page.getByRole("radio", { name: "Its kind" }).check();
  assert.doesNotMatch(await saved(page, "TOML"), /^tree_seed = 4$/m);
  assert.deepEqual(problems, []);
  await context.close();
});

test("without WebGL the tree is a flat picture", async () => {
  const first = () => {
    const found = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : found.call(this, kind, ...rest);
    };
  };
  const { page, context } = await newPage(studio, { first }, "#fit?goal=palm");
  await page.getByTestId("goal").waitFor();
  await shortFit(page);
  await modelView(page, "flat").waitFor();
  assert.ok(await page.getByRole("img", { name: /^Best tree so far/ }).isVisible());
  await page.waitForFunction(() =>
    document.querySelector('[data-testid="fit-glb"]').textContent.includes("MB"),
  );
  await context.close();
});

test("the family can be the one that the goal looks like", async () => {
  const { page, problems, context } = await fit();
  // A race between the families is a search before the search.
  await page.getByLabel("Family").selectOption("auto");
  const likeness = await fitted(page, { ...trees(150), individual: "off" });
  assert.ok(likeness >= 0.6, `likeness ${likeness}`);
  assert.deepEqual(problems, []);
  await context.close();
});

test("without this very tree there is only the kind", async () => {
  const { page, problems, context } = await fit();
  await page.getByLabel("Look for this very tree too").uncheck();
  await shortFit(page);
  assert.equal(await page.getByRole("radio", { name: "Its kind" }).count(), 0);
  assert.doesNotMatch(await saved(page, "TOML"), /\[individual\]/);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a race between families shows a known tree, then its own, and may be stopped", async () => {
  const { page, problems, context } = await fit("#fit?goal=acer");
  await page.getByLabel("Family").selectOption("trees");
  // A search of the race may be over before a test that asks again and again has seen it.
  await page.evaluate(() => {
    window.seen = { known: false, trying: false, overlay: false };
    const look = () => {
      const text = document.body.innerText;
      window.seen.known ||= !window.seen.trying && text.includes("Nearest known tree");
      window.seen.trying ||= /^Trying .+, search 1 of \d$/m.test(text);
      window.seen.overlay ||=
        !!document.querySelector('[data-testid="overlay"]') && !text.includes("Looks like");
    };
    new MutationObserver(look).observe(document.body, {
      childList: true,
      characterData: true,
      subtree: true,
    });
  });
  await start(page, endless());
  await page.waitForFunction(() => window.seen.trying && window.seen.overlay, null, { timeout: PATIENCE });
  assert.ok(await page.evaluate(() => window.seen.known), "no known tree was shown before the race");
  await page.getByTestId("stop").click();
  await page.getByTestId("score").waitFor({ timeout: 60_000 });
  await page.getByText("Looks like").waitFor();
  assert.deepEqual(problems, []);
  await context.close();
});

test("a search can be paused, continued and stopped", async () => {
  const { page, context } = await fit();
  await start(page, endless("palm"));
  const numbers = page.locator(".livenumbers dd").nth(1);
  await numbers.waitFor({ timeout: PATIENCE });
  await page.getByTestId("pause").click();
  await page.getByText("Paused").waitFor();
  const tried = () => numbers.textContent();
  // Workers end what they have begun.
  await atRest(page);
  const held = await tried();
  await page.waitForTimeout(500);
  assert.equal(await tried(), held);
  await page.getByTestId("resume").click();
  await page.waitForFunction(
    (before) => document.querySelectorAll(".livenumbers dd")[1]?.textContent !== before,
    held,
  );
  await page.getByTestId("stop").click();
  await page.getByTestId("score").waitFor();
  await context.close();
});
