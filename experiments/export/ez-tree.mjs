// Trees of ez-tree and of pleach, measured alike: `node experiments/export/ez-tree.mjs PACKAGES PROGRAM`.
//
// PACKAGES is a folder outside of the repository, after `npm install @dgreenheck/ez-tree@1.1.0 three@0.187.0
// playwright-core sharp` in it; PROGRAM is the path of `pleach`. Writes ez-tree.csv and ez-tree.png beside this file and
// prints the README's table; with `--picture` at the end the picture alone. Columns that begin with
// `wall_` are times. Draws without a graphics card (SwiftShader).
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { extname, join, resolve } from "node:path";

const SPECIES = [
  "quaking_aspen", "weeping_willow", "palm", "small_pine", "acer", "black_oak", "hill_cherry", "stylised_oak",
  "natural_oak", "natural_aspen",
];
const PICTURE = [
  ["ez-tree", "Oak Medium"], ["ez-tree", "Aspen Medium"], ["ez-tree", "Pine Medium"],
  ["pleach", "natural_oak"], ["pleach", "natural_aspen"], ["pleach", "small_pine"],
];
const RUNS = 2;
const COLUMNS = [
  "program", "tree", "triangles", "draw_calls", "glb_bytes", "wall_tree_s", "wall_glb_s", "wall_frame_200_s",
];
const PICTURE_ALONE = process.argv[4] === "--picture";
const here = import.meta.dirname;
const packages = resolve(process.argv[2], "node_modules");
const pleach = resolve(process.argv[3]);
const require = createRequire(join(packages, "x.js"));
const files = mkdtempSync(join(tmpdir(), "pleach-ez-tree-"));

const HTML = `<!doctype html><script type="importmap">{"imports": {
  "three": "/packages/three/build/three.module.js",
  "three/addons/": "/packages/three/examples/jsm/",
  "ez-tree": "/packages/@dgreenheck/ez-tree/build/ez-tree.es.js"
}}</script><body style="margin:0">`;

/** A server of the packages and of the files that pleach wrote. */
async function serve() {
  const types = { ".js": "text/javascript", ".glb": "model/gltf-binary" };
  const server = createServer((request, response) => {
    const path = new URL(request.url, "http://x").pathname;
    if (path === "/") return response.setHeader("content-type", "text/html").end(HTML);
    try {
      const file = path.startsWith("/packages/") ? join(packages, path.slice(10)) : join(files, path.slice(7));
      const content = readFileSync(file);
      response.setHeader("content-type", types[extname(path)] ?? "application/octet-stream").end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return server;
}

/** Runs in the page: what is measured of a tree of either program. */
async function prepare() {
  const THREE = await import("three");
  const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
  const { GLTFExporter } = await import("three/addons/exporters/GLTFExporter.js");
  const { Tree, TreePreset } = await import("ez-tree");
  // Without their pictures trees of ez-tree are white.
  await new Promise((done) => setTimeout(done, 3000));
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  document.body.append(renderer.domElement);

  /** A new scene with sun and sky. */
  function scene() {
    const scene = new THREE.Scene();
    scene.background = new THREE.Color(0xbfd9f2);
    const sun = new THREE.DirectionalLight(0xfff4e0, 3);
    sun.position.set(12, 18, 14);
    scene.add(sun, new THREE.HemisphereLight(0xdcebff, 0x8a7f66, 1.6));
    return [scene, sun];
  }

  /** The tree's box without parts that show nothing. */
  const box = (tree) => new THREE.Box3().setFromObject(tree, true);

  /** A picture, and the seconds until its first pixel can be read. */
  function draw(scene, camera) {
    const start = performance.now();
    renderer.render(scene, camera);
    const context = renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
    return (performance.now() - start) / 1000;
  }

  /** The tree ten metres high, its foot in the middle. */
  function placed(tree, height = 10) {
    const size = box(tree);
    const group = new THREE.Group();
    group.add(tree);
    group.scale.setScalar(height / (size.max.y - Math.min(size.min.y, 0)));
    return group;
  }

  function measure(tree) {
    renderer.setSize(640, 360);
    renderer.shadowMap.enabled = false;
    const [one] = scene();
    const camera = new THREE.PerspectiveCamera(40, 16 / 9, 1, 1000);
    const group = placed(tree);
    one.add(group);
    camera.position.set(0, 8, 30);
    camera.lookAt(0, 5, 0);
    draw(one, camera);
    const { triangles, calls } = renderer.info.render;
    const [many] = scene();
    for (let i = 0; i < 200; i++) {
      const copy = group.clone();
      copy.position.set(((i % 20) - 9.5) * 8, 0, -Math.floor(i / 20) * 8);
      copy.rotation.y = i * 2.4;
      many.add(copy);
    }
    camera.position.set(0, 30, 70);
    camera.lookAt(0, 0, -30);
    // One frame: pictures and shaders are there since the single tree was drawn.
    return { triangles, calls, frame: draw(many, camera) };
  }

  function picture(tree) {
    const [width, height] = [256, 288];
    renderer.setSize(width, height);
    renderer.shadowMap.enabled = true;
    const [one, sun] = scene();
    const ground = new THREE.Mesh(new THREE.CircleGeometry(60, 64), new THREE.MeshStandardMaterial({ color: 0x8d9a6b }));
    ground.rotation.x = -Math.PI / 2;
    ground.receiveShadow = true;
    const group = placed(tree);
    group.traverse((part) => {
      part.castShadow = part.receiveShadow = true;
      if (part.material?.map) part.material.map.anisotropy = 8;
    });
    Object.assign(sun.shadow.camera, { left: -12, right: 12, top: 12, bottom: -12, far: 60 });
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.normalBias = 0.03;
    one.add(ground, group);
    const size = box(group);
    const camera = new THREE.PerspectiveCamera(24, width / height, 1, 1000);
    const away = Math.max(28, (size.max.x - size.min.x) * 2.9, (size.max.z - size.min.z) * 2.9);
    camera.position.set(0, 6, away);
    camera.lookAt(0, 4.9, 0);
    draw(one, camera);
    return renderer.domElement.toDataURL("image/png");
  }

  async function ez(name) {
    const start = performance.now();
    const tree = new Tree();
    tree.loadPreset(name);
    return [tree, (performance.now() - start) / 1000];
  }

  async function ours(name) {
    return (await new GLTFLoader().loadAsync(`/files/${name}.glb`)).scene;
  }

  window.presets = Object.keys(TreePreset);
  window.measureEz = async (name, runs) => {
    let [made, whole, bytes] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, 0];
    for (let i = 0; i < runs; i++) {
      const [tree, seconds] = await ez(name);
      const start = performance.now();
      bytes = (await new GLTFExporter().parseAsync(tree, { binary: true })).byteLength;
      whole = Math.min(whole, seconds + (performance.now() - start) / 1000);
      made = Math.min(made, seconds);
    }
    return { made, whole, bytes, ...measure((await ez(name))[0]) };
  };
  window.measureOurs = async (name) => measure(await ours(name));
  window.picture = async (program, name) => picture(program === "pleach" ? await ours(name) : (await ez(name))[0]);
}

/** Grows a tree; the bytes of its file and the shortest seconds of a whole process. */
function grow(species, name, more) {
  const file = join(files, `${name}.glb`);
  let shortest = Number.POSITIVE_INFINITY;
  for (let i = 0; i < (PICTURE_ALONE ? 1 : RUNS); i++) {
    const start = performance.now();
    execFileSync(pleach, ["--quiet", "grow", species, "--seed", "1", ...more, "-o", file], { stdio: "ignore" });
    shortest = Math.min(shortest, (performance.now() - start) / 1000);
  }
  return [readFileSync(file).length, shortest];
}

const seconds = (value) => value.toFixed(4);
const median = (values) => {
  const sorted = values.map(Number).sort((a, b) => a - b);
  return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
};

async function sheet(page) {
  const sharp = require("sharp");
  const pictures = [];
  for (const [i, [program, name]] of PICTURE.entries()) {
    const data = await page.evaluate(([program, name]) => window.picture(program, name), [program, name]);
    pictures.push({ input: Buffer.from(data.split(",")[1], "base64"), left: (i % 3) * 256, top: Math.floor(i / 3) * 288 });
  }
  await sharp({ create: { width: 768, height: 576, channels: 3, background: "white" } })
    .composite(pictures)
    .png({ palette: true, colours: 96, dither: 0, compressionLevel: 9 })
    .toFile(join(here, "ez-tree.png"));
}

async function main() {
  const server = await serve();
  const browser = await require("playwright-core").chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const page = await browser.newPage();
  page.setDefaultTimeout(0);
  page.on("pageerror", (error) => console.error(error.message));
  page.on("console", (said) => said.type() === "error" && console.error(said.text()));
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.evaluate(prepare);
  const rows = [];
  if (!PICTURE_ALONE) {
    for (const name of await page.evaluate(() => window.presets)) {
      const got = await page.evaluate(([name, runs]) => window.measureEz(name, runs), [name, RUNS]);
      const times = [got.made, got.whole, got.frame].map(seconds);
      rows.push(["ez-tree", name, got.triangles, got.calls, got.bytes, ...times]);
      console.log(rows.at(-1).join(","));
    }
  }
  for (const species of SPECIES) {
    for (const [program, more] of [["pleach", []], ["pleach 8000", ["--triangles", "8000"]]]) {
      const name = `${species}${more.join("")}`;
      const pictured = more.length === 0 && PICTURE.some(([, name]) => name === species);
      if (PICTURE_ALONE && !pictured) continue;
      const [bytes, whole] = grow(species, name, more);
      if (PICTURE_ALONE) continue;
      const got = await page.evaluate((name) => window.measureOurs(name), name);
      rows.push([program, species, got.triangles, got.calls, bytes, "", seconds(whole), seconds(got.frame)]);
      console.log(rows.at(-1).join(","));
    }
  }
  await sheet(page);
  await browser.close();
  server.close();
  rmSync(files, { recursive: true });
  if (rows.length === 0) return;
  writeFileSync(join(here, "ez-tree.csv"), `${[COLUMNS, ...rows].map((row) => row.join(",")).join("\n")}\n`);
  for (const program of ["ez-tree", "pleach", "pleach 8000"]) {
    const mine = rows.filter((row) => row[0] === program);
    const of = (column) => median(mine.map((row) => row[column]));
    const least = (column) => Math.min(...mine.map((row) => row[column]));
    const most = (column) => Math.max(...mine.map((row) => row[column]));
    console.log(
      `| ${program} | ${mine.length} | ${of(2)} (${least(2)} to ${most(2)}) | ${of(3)} | ${(of(4) / 1e6).toFixed(1)} ` +
        `| ${mine[0][5] && of(5).toFixed(3)} | ${of(6).toFixed(3)} | ${of(7).toFixed(2)} |`,
    );
  }
}

await main();
