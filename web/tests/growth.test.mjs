// The shader of docs/growth.md, in the library that it is for, with a file that the program writes.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFile, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { open } from "./browser.mjs";

const SIDE = 160;
const near = (path) => fileURLToPath(new URL(path, import.meta.url));

/** Draws the tree at a time, as what of each row of pixels is not paper; without the shader where there is no time. */
const PAGE = /* js */ `
import * as THREE from "three";
import { GLTFLoader } from "./GLTFLoader.js";
import { grow, growth } from "./shader.js";
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(${SIDE}, ${SIDE});
window.drawn = async (now) => {
  const { scene } = await new GLTFLoader().loadAsync("./tree.glb");
  const box = new THREE.Box3().setFromObject(scene);
  const half = box.max.y * 0.6;
  const camera = new THREE.OrthographicCamera(-half, half, box.max.y * 1.1, -half * 0.2, 0.1, 1000);
  camera.position.set(0, 0, 500);
  scene.traverse((one) => {
    if (!one.isMesh) return;
    const { map, alphaTest, side } = one.material;
    one.material = new THREE.MeshBasicMaterial({ map, alphaTest, side });
    if (now !== null) grow(one.material);
    one.frustumCulled = false;
  });
  growth.now.value = now ?? 1;
  const paper = new THREE.Scene();
  paper.background = new THREE.Color(1, 0, 1);
  paper.add(scene);
  renderer.render(paper, camera);
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * ${SIDE * SIDE});
  gl.readPixels(0, 0, ${SIDE}, ${SIDE}, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const ink = (at) => !(pixels[at] === 255 && pixels[at + 1] === 0 && pixels[at + 2] === 255);
  return Array.from({ length: ${SIDE} }, (_, row) =>
    Array.from({ length: ${SIDE} }, (_, column) => Number(ink(4 * (row * ${SIDE} + column)))).join(""),
  );
};
window.ready = true;
`;

test("the shader of the document lets a tree grow in three.js", async (t) => {
  const folder = await mkdtemp(join(tmpdir(), "pleach-growth-"));
  t.after(() => rm(folder, { recursive: true }));
  const text = await readFile(near("../../docs/growth.md"), "utf8");
  const shader = text.match(/```js\n([\s\S]*?)```/)[1];
  const three = near("../node_modules/three/");
  const loader = await readFile(join(three, "examples/jsm/loaders/GLTFLoader.js"), "utf8");
  for (const name of ["three.module.js", "three.core.js"]) {
    await copyFile(join(three, "build", name), join(folder, name));
  }
  for (const name of ["BufferGeometryUtils", "SkeletonUtils"]) {
    await copyFile(join(three, `examples/jsm/utils/${name}.js`), join(folder, `${name}.js`));
  }
  await writeFile(join(folder, "GLTFLoader.js"), loader.replaceAll("../utils/", "./"));
  await writeFile(join(folder, "shader.js"), `import * as THREE from "three";\n${shader}`);
  await writeFile(join(folder, "page.js"), PAGE);
  const imports = JSON.stringify({ imports: { three: "./three.module.js" } });
  await writeFile(
    join(folder, "index.html"),
    `<link rel="icon" href="data:,"><script type="importmap">${imports}</script><script type="module" src="./page.js"></script>`,
  );
  execFileSync(process.env.PLEACH ?? near("../../target/release/pleach"), [
    ...[
      "grow",
      "acer",
      "--growth",
      "--triangles",
      "8000",
      "--textures",
      "512",
      "-o",
      join(folder, "tree.glb"),
    ],
  ]);
  const studio = await open(folder);
  t.after(() => studio.close());
  const page = await studio.browser.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  await page.goto(studio.address);
  await page.waitForFunction(() => window.ready);
  const drawn = (now) => page.evaluate((time) => window.drawn(time), now);
  const ink = (rows) => rows.join("").replaceAll("0", "").length;
  const top = (rows) => rows.findLastIndex((row) => row.includes("1"));
  const whole = await drawn(null);
  assert.ok(ink(whole) > 1000, `${ink(whole)} pixels of the tree`);
  assert.equal(ink(await drawn(0)), 0);
  assert.deepEqual(await drawn(1), whole);
  const steps = [];
  for (const time of [0.2, 0.4, 0.6, 0.8]) steps.push(await drawn(time));
  const inks = [...steps, whole].map(ink);
  const tops = [...steps, whole].map(top);
  assert.ok(
    inks.every((own, at) => own > 0 && (at === 0 || own > inks[at - 1])),
    `${inks} pixels`,
  );
  assert.ok(
    tops.every((own, at) => at === 0 || own >= tops[at - 1]) && tops[0] < 0.5 * tops.at(-1),
    `up to rows ${tops}`,
  );
  assert.deepEqual(problems, []);
});
