// Goals: the brush, photographs, measures, and pictures that are none.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { atRest, newPage, open } from "./browser.mjs";
import { drop, fitRoom, ink, inkIs, library } from "./fit-room.mjs";
import { colorPng, plainPng } from "./pictures.mjs";

let studio;
before(async () => {
  studio = await open();
});
after(() => studio?.close());

const fit = (hash) => fitRoom(studio, hash);

test("the brush changes the mask, and undo brings it back", async () => {
  const { page, problems, context } = await fit();
  const before = await ink(page);
  const box = await page.getByTestId("goal").boundingBox();
  await page.mouse.move(box.x + 40, box.y + box.height * 0.7);
  await page.mouse.down();
  await page.mouse.move(box.x + 120, box.y + box.height * 0.75, { steps: 5 });
  await page.mouse.up();
  await inkIs(page, (now) => now > before + 50);
  await page.getByTestId("undo-mask").click();
  await inkIs(page, (now) => now === before);
  const ground = page.getByRole("slider", { name: "Ground" });
  const row = Number(await ground.getAttribute("aria-valuenow"));
  await ground.focus();
  await page.keyboard.press("ArrowUp");
  assert.equal(Number(await ground.getAttribute("aria-valuenow")), row - 1);
  assert.deepEqual(problems, []);
  await context.close();
});

test("a stroke ends with its picture, and with a second finger", async () => {
  const options = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
  const { page, context } = await newPage(studio, options, "#fit?goal=palm");
  await page.waitForFunction(() => document.querySelector('[data-testid="goal"]')?.width === 256);
  await page.locator(".segmented label", { hasText: "Add" }).tap();
  await page.evaluate(() => document.querySelector("main").scrollTo(0, 0));
  const client = await context.newCDPSession(page);
  const { x, y, width } = await page.getByTestId("goal").boundingBox();
  const touch = (type, ...points) =>
    client.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(([right, down], id) => ({ x: x + right, y: y + down, id })),
    });
  const left = 20;
  const right = width - 20;
  const columns = () =>
    page.getByTestId("goal").evaluate((canvas) => {
      const { width, height } = canvas;
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
      const count = (from, to) => {
        let sum = 0;
        for (let row = 0; row < height; row++)
          for (let at = from; at < to; at++) if (data[4 * (row * width + at) + 3]) sum++;
        return sum;
      };
      return [count(0, 26), count(width - 26, width)];
    });
  const before = await columns();
  await touch("touchStart", [left, 60]);
  await touch("touchMove", [left, 120]);
  await touch("touchStart", [left, 120], [right, 60]);
  await touch("touchMove", [left, 120], [right, 160]);
  await touch("touchEnd");
  await atRest(page);
  const after = await columns();
  assert.ok(after[0] > before[0] + 50, `${before} and then ${after}`);
  assert.equal(after[1], before[1]);
  await touch("touchStart", [left, 200]);
  await touch("touchMove", [left, 240]);
  await drop(page, "drawn.png", readFileSync(new URL("../public/targets/bamboo.png", import.meta.url)));
  await page.locator(".facts", { hasText: "drawn" }).waitFor();
  const own = await ink(page);
  await touch("touchMove", [left, 260]);
  await touch("touchEnd");
  await atRest(page);
  assert.doesNotMatch(await page.locator(".facts").textContent(), /painted over/);
  assert.equal(await ink(page), own);
  await context.close();
});

test("a finger scrolls over the goal, and paints once a brush is picked", async () => {
  const options = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
  const { page, context } = await newPage(studio, options, "#fit?goal=palm");
  await page.getByTestId("goal").waitFor();
  await page.waitForFunction(() => document.querySelector('[data-testid="goal"]').width === 256);
  const before = await ink(page);
  const client = await context.newCDPSession(page);
  const swipe = async () => {
    const box = await page.getByTestId("goal").boundingBox();
    const touch = (type, y) =>
      client.send("Input.dispatchTouchEvent", {
        type,
        touchPoints: type === "touchEnd" ? [] : [{ x: box.x + 60, y }],
      });
    await touch("touchStart", box.y + 300);
    for (let y = 290; y >= 100; y -= 10) await touch("touchMove", box.y + y);
    await touch("touchEnd");
    await atRest(page);
  };
  const scrolled = () => page.evaluate(() => document.querySelector("main").scrollTop);
  // Handles are large enough for a finger.
  await page.locator(".handle.measure").first().waitFor();
  for (const handle of await page.locator(".handle").all()) {
    const { width, height } = await handle.boundingBox();
    assert.ok(width >= 44 && height >= 44, `a handle of ${width} × ${height} pixels`);
  }
  await swipe();
  assert.ok((await scrolled()) > 80, `scrolled by ${await scrolled()}`);
  assert.equal(await ink(page), before);
  await page.evaluate(() => document.querySelector("main").scrollTo(0, 0));
  await page.locator(".segmented label", { hasText: "Add" }).tap();
  await page.evaluate(() => document.querySelector("main").scrollTo(0, 0));
  await swipe();
  assert.equal(await scrolled(), 0);
  assert.ok((await ink(page)) > before + 50);
  await context.close();
});

test("a tree is found in a photograph by its colour", async () => {
  const { page, problems, context } = await fit();
  const side = 400;
  const tree = (await library()).Species.named("quaking_aspen").grow(1, true).silhouette(side, 0, 0);
  // Leaves in sun and shade, some as bright as the sky, which is lighter towards the ground.
  const at = (x, y) => {
    const light = ((x * 7 + y * 13) % 31) * 3;
    return tree[y * side + x] ? [70 + light, 110 + light, 30] : [150 + (y >> 3), 190 + (y >> 4), 235];
  };
  await drop(page, "garden.png", colorPng(side, side, at));
  await page.locator(".facts", { hasText: "garden" }).waitFor();
  if (await page.getByText("Look for a tree in a photograph").isVisible()) {
    await page.getByText("Look for a tree in a photograph").click();
  }
  await page.locator(".facts", { hasText: "a tree found in a photograph" }).waitFor();
  await page.getByText("Take the dark pixels instead").click();
  await page.locator(".facts", { hasText: "a silhouette" }).waitFor();
  // With a box around it, the tree is found again; a slip of the hand asks for nothing.
  await page.getByRole("radio", { name: "Box" }).check({ force: true });
  const goal = await page.getByTestId("goal").boundingBox();
  const drag = async (from, to) => {
    await page.mouse.move(goal.x + goal.width * from[0], goal.y + goal.height * from[1]);
    await page.mouse.down();
    await page.mouse.move(goal.x + goal.width * to[0], goal.y + goal.height * to[1], { steps: 4 });
    await page.mouse.up();
  };
  await drag([0.5, 0.5], [0.501, 0.501]);
  assert.ok(await page.locator(".facts", { hasText: "a silhouette" }).isVisible());
  await drag([0.02, 0.02], [0.98, 0.99]);
  await page.locator(".facts", { hasText: "a tree found in a photograph" }).waitFor();
  const planted = (100 * tree.reduce((sum, value) => sum + value, 0)) / (side * side);
  const found = Number(/(\d+) % tree/.exec(await page.getByTestId("goal").getAttribute("aria-label"))[1]);
  assert.ok(
    Math.abs(found - planted) < 0.2 * planted + 1,
    `${found} % of the picture, ${planted} % are tree`,
  );
  // Strokes show what is not of it, and what is found by them is a step that can be undone.
  await page.getByRole("radio", { name: "Take away" }).check({ force: true });
  await drag([0.35, 0.4], [0.65, 0.4]);
  const guided = page.getByRole("button", { name: "Find the tree by these strokes" });
  await guided.click();
  await guided.waitFor({ state: "detached" });
  await page.locator(".facts", { hasText: /sure$/ }).waitFor();
  await page.getByTestId("start").focus();
  await page.keyboard.press("Control+z");
  await page.locator(".facts", { hasText: "painted over" }).waitFor();
  assert.ok(await guided.isVisible());
  assert.deepEqual(problems, []);
  await context.close();
});

test("a tree that was cut out of a photograph is seen in its colours", async () => {
  const { page, problems, context } = await fit();
  const side = 64;
  const tree = (await library()).Species.named("acer").grow(1, true).silhouette(side, 0, 0);
  const at = (x, y) => (tree[y * side + x] ? [60, 140, 40, 255] : [200, 0, 0, 0]);
  await drop(page, "cut.png", colorPng(side, side, at));
  await page.locator(".facts", { hasText: "cut" }).waitFor();
  await atRest(page);
  const pixel = (at) =>
    page.evaluate((at) => {
      const canvas = document.querySelector('[data-testid="goal"]');
      const side = canvas.width;
      return [...canvas.getContext("2d").getImageData(at % side, Math.floor(at / side), 1, 1).data];
    }, at);
  const [red, green] = await pixel(tree.indexOf(1));
  assert.ok(green > red + 10, `the leaves are ${[red, green]}`);
  assert.deepEqual(await pixel(0), [255, 255, 255, 255], "what is clear is paper, whatever its colour");
  assert.deepEqual(problems, []);
  await context.close();
});

test("what was read in the goal is dragged, undone, and kept", async () => {
  const { page, problems, context } = await fit("#fit?goal=acer");
  await page.getByText("All measures").click();
  const row = (name) =>
    page.getByTestId("reading-table").locator("tr", { has: page.locator(`th:text-is("${name}")`) });
  await row("feet").filter({ hasText: "one trunk" }).waitFor();
  const handle = (name) => page.getByRole("slider", { name, exact: true });
  const now = async (name) => Number(await handle(name).getAttribute("aria-valuenow"));
  const drag = async (name, right, up) => {
    const from = await handle(name).boundingBox();
    const [x, y] = [from.x + from.width / 2, from.y + from.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + right, y - up, { steps: 5 });
    await page.mouse.up();
  };
  const goal = await page.getByTestId("goal").boundingBox();
  const [bare, width] = [await now("Bare"), await now("Trunk width")];
  await drag("Bare", 0, goal.height * 0.2);
  const dragged = await now("Bare");
  assert.ok(dragged > bare + 0.1, `bare up to ${bare}, then ${dragged}`);
  await row("bare trunk").filter({ hasText: "100 %" }).waitFor();
  await drag("Trunk width", goal.width * 0.05, 0);
  const wide = await now("Trunk width");
  assert.ok(wide > width + 0.08 && wide < width + 0.2, `${width} wide, then ${wide}`);
  await row("feet")
    .filter({ hasText: `one trunk, ${wide.toFixed(2)} of the height wide` })
    .waitFor();
  await handle("Lean").focus();
  await page.keyboard.press("ArrowLeft");
  await row("lean").filter({ hasText: "100 %" }).waitFor();
  await page.getByLabel("Trunks").fill("3");
  await page.getByLabel("Trunks").press("Enter");
  await row("feet").filter({ hasText: "3 trunks" }).waitFor();
  // Each is a step of its own.
  await page.getByTestId("start").focus();
  await page.keyboard.press("Control+z");
  await row("feet").filter({ hasText: "one trunk" }).waitFor();
  await atRest(page);
  await page.reload();
  await page.getByText("All measures").click();
  await row("bare trunk").filter({ hasText: "100 %" }).waitFor();
  assert.deepEqual([await now("Bare"), await now("Trunk width")], [dragged, wide]);
  await page.getByRole("button", { name: "As it was read" }).click();
  await atRest(page);
  assert.deepEqual([await now("Bare"), await now("Trunk width")], [bare, width]);
  // The drawing goes by a switch, and takes its handles with it; ground and trunk are of the goal.
  await page.getByLabel("Show it over the goal").uncheck();
  assert.equal(await page.locator(".look, .handle.measure").count(), 0);
  assert.equal(await handle("Ground").count(), 1);
  assert.deepEqual(problems, []);
  await context.close();
});

test("what was not read in the goal is added to it", async () => {
  const { page, problems, context } = await fit("#fit?goal=palm");
  await page.getByText("All measures").click();
  const row = page.getByTestId("reading-table").locator("tr", { hasText: "first fork" });
  await row.filter({ hasText: "none seen" }).waitFor();
  const fork = page.getByRole("slider", { name: "Fork", exact: true });
  assert.equal(await fork.count(), 0);
  // With the drawing hidden it would be an addition that nobody sees.
  await page.getByLabel("Show it over the goal").uncheck();
  await page.getByRole("button", { name: "Add a fork" }).click();
  await fork.focus();
  await page.keyboard.press("ArrowUp");
  await row.filter({ hasText: "at 0.31 of the height" }).filter({ hasText: "100 %" }).waitFor();
  assert.equal(await page.getByRole("button", { name: "Add a fork" }).count(), 0);
  await page.getByRole("button", { name: "As it was read" }).click();
  await row.filter({ hasText: "none seen" }).waitFor();
  assert.deepEqual([await fork.count(), problems], [0, []]);
  await context.close();
});

test("a fit has the colours of the picture that its mask is of", async () => {
  const { Evaluator, Fit, Goal, Species } = await library();
  const side = 128;
  const tree = Species.named("acer").grow(3, true).silhouette(side, 0, 0);
  const orange = [208, 120, 30];
  const photo = Uint8Array.from(
    [...tree].flatMap((ink, at) => {
      const trunk = at > side * side * 0.9;
      const light = ((at * 7) % 31) - 15;
      const color = ink ? (trunk ? [80, 62, 45] : orange) : [150, 190, 235];
      return [...color.map((value) => value + light), 255];
    }),
  );
  const inked = () => Goal.from_pixels("tree", side, side, tree);
  const plain = inked().look(undefined, "{}");
  assert.deepEqual([JSON.parse(plain.json).found.colors, plain.layers.length], [null, 0]);
  const { json, layers } = inked().look(photo, '{"lean_deg": -8}');
  const { found, anchor } = JSON.parse(json);
  // Wood and leaves lie on the tree, and most of a maple is leaves.
  const count = (kind) => layers.reduce((sum, layer) => sum + (layer === kind ? 1 : 0), 0);
  assert.ok(layers.every((layer, at) => layer === 0 || tree[at] === 1));
  assert.ok(count(1) > 20 && count(2) > 5 * count(1), `${count(1)} of wood, ${count(2)} of leaves`);
  assert.equal(found.lean_deg, -8);
  assert.ok(anchor.height > 60 && found.colors.season === "autumn", JSON.stringify(found.colors));
  const autumn = (goal) => {
    const fit = new Fit(goal, '{"evaluations": 4, "individual": "off", "from": "acer"}');
    fit.compare(() => {});
    fit.begin();
    const evaluator = new Evaluator(fit.recipe());
    const pieces = fit.ask(1, 0);
    fit.tell(
      pieces.map((piece) => evaluator.score(piece)),
      0,
    );
    return /season = "autumn"/.test(fit.best_toml());
  };
  assert.ok(autumn(inked().with_colors(JSON.stringify(found.colors), layers)) && !autumn(inked()));
});

test("pictures that are none are refused in words, and the goal stays", async () => {
  const { page, problems, context } = await fit();
  const bad = [
    ["text.png", Buffer.from("This is no picture.")],
    ["huge.png", plainPng(10_000, 6_000, 0xff)],
    ["white.png", plainPng(256, 256, 0xff)],
    ["black.png", plainPng(256, 256, 0x00)],
  ];
  const before = await ink(page);
  let last = "";
  for (const [name, bytes] of bad) {
    await drop(page, name, bytes);
    await page.waitForFunction((before) => {
      const text = document.querySelector(".panelbody > .alert")?.textContent ?? "";
      return text !== "" && text !== before && !document.querySelector(".reading");
    }, last);
    last = await page.locator(".panelbody > .alert").textContent();
    console.log(`${name}: ${last}`);
    assert.ok(last.length > 20);
    assert.equal(await ink(page), before);
    assert.ok(await page.getByTestId("start").isEnabled());
  }
  // What is odd is said in a whole sentence of the library, with what to do about it.
  const side = 100;
  const square = (x, y) => (x > 30 && x < 70 && y > 30 && y < 70 ? [0, 0, 0] : [255, 255, 255]);
  await drop(page, "square.png", colorPng(side, side, square));
  const odd = page.locator('.warning[data-kind="solid"]');
  await odd.waitFor();
  const { Goal } = await library();
  const { warnings } = JSON.parse(Goal.read("square.png", colorPng(side, side, square), "auto").info());
  const { message } = warnings.find(({ kind }) => kind === "solid");
  assert.equal(await odd.locator("p").textContent(), `${message}.`);
  assert.doesNotMatch(message, / --|`/);
  await odd.getByRole("button", { name: "Draw a box around the tree" }).click();
  assert.ok(await page.getByRole("radio", { name: "Box" }).isChecked());
  assert.deepEqual(problems, []);
  await context.close();
});

const TREE =
  "<path fill='#000' d='M46 100 L46 50 A30 30 0 1 1 54 50 L54 100 Z'/><path fill='#000' d='M10 98 H90 V100 H10 Z'/>";

test("a drawing in SVG is a goal, with or without a size, and nothing outside of it is read", async () => {
  const { page, problems, context } = await fit();
  const svg = async (name, attributes, inside = TREE) => {
    const text = `<svg xmlns="http://www.w3.org/2000/svg" ${attributes}>${inside}</svg>`;
    await drop(page, name, Buffer.from(text));
  };
  const elsewhere =
    "<style>.none { fill: none }</style><rect class='none' width='99' height='40'/><image href='https://example.org/a.png' width='9' height='9'/><style>@import url(https://example.org/a.css);</style>";
  for (const [name, attributes, size] of [
    ["sized", 'width="10cm" height="5cm" viewBox="0 0 200 100"', "1024 × 512"],
    ["boxed", 'viewBox="0 0 100 100"', "1024 × 1024"],
    ["percent", 'width="100%" height="100%" viewBox="0 0 50 100"', "512 × 1024"],
  ]) {
    await svg(`${name}.svg`, attributes, elsewhere + TREE);
    await page.locator(".facts", { hasText: name }).waitFor();
    assert.ok((await page.locator(".facts").textContent()).includes(size), name);
    assert.ok((await ink(page)) > 1000);
  }
  // What is wrong is told, and the goal stays.
  const endless = "<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>";
  const many = Array.from(
    { length: 16 },
    (_, at) => `<g id='n${at}'><use href='#n${at + 1}'/><use href='#n${at + 1}'/></g>`,
  );
  const refused = async (name, attributes, inside, words) => {
    await svg(`${name}.svg`, attributes, inside);
    const told = page.locator(".alert", { hasText: `${name}.svg` });
    await told.waitFor();
    assert.ok((await told.textContent()).includes(words), await told.textContent());
    assert.ok((await page.locator(".facts").textContent()).includes("percent"));
  };
  for (const each of [
    ["none", "", TREE, "neither width and height nor a viewBox"],
    ["blurred", 'viewBox="0 0 9 9"', "<filter id='f'/>", "It has the element filter"],
    ["endless", 'viewBox="0 0 9 9"', endless, "nested more than"],
    ["many", 'viewBox="0 0 9 9"', `${many.join("")}<rect id='n16'/>`, "more than 20,000 shapes"],
    ["empty", 'viewBox="0 0 9 9"', "", ""],
  ]) {
    await refused(...each);
  }
  assert.deepEqual(problems, []);
  // Chromium complains in the console of the style of its own message.
  await refused("broken", 'viewBox="0 0 9 9"', "<path", "It is no complete XML");
  await context.close();
});
