// Compiles crates/web to WebAssembly and writes it, with what JavaScript needs to load it, to src/wasm.
// Environment: CARGO_TARGET_DIR as for cargo; PLEACH_WASM=quick builds a larger, slower module in less time;
// PLEACH_BINDGEN is the absolute path of crates/web-bindgen as it was built before.

import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { megabytes, step } from "./step.mjs";

const web = dirname(dirname(fileURLToPath(import.meta.url)));
const root = dirname(web);
const target = process.env.CARGO_TARGET_DIR ? resolve(process.env.CARGO_TARGET_DIR) : join(root, "target");
const TRIPLE = "wasm32-unknown-unknown";
const quick = process.env.PLEACH_WASM === "quick";
const profile = quick ? "wasm-quick" : "wasm";

/** Runs a program at the root of the repository; ends the build if it fails. */
function run(program, args, more = {}) {
  const { status, error } = spawnSync(program, args, { cwd: root, stdio: "inherit", ...more });
  if (error || status !== 0) {
    console.error(error ? `${program} cannot be run: ${error.message}` : `${program} has failed`);
    process.exit(status || 1);
  }
}

/** Whether the standard library for WebAssembly is there, or could be installed. */
function hasTarget() {
  const root = spawnSync("rustc", ["--print", "sysroot"], { encoding: "utf8" });
  const there = root.status === 0 && existsSync(join(root.stdout.trim(), "lib", "rustlib", TRIPLE));
  return there || spawnSync("rustup", ["target", "add", TRIPLE], { stdio: "inherit" }).status === 0;
}

if (!hasTarget()) {
  console.error(
    `The Rust target ${TRIPLE} is missing: \`rustup target add ${TRIPLE}\` installs it; on Debian the packages rustc-web and rust-web-src have it. The rest of pleach does not need it.`,
  );
  process.exit(1);
}

// Vector instructions without fused ones: every browser since 2023 has them, and they round as scalar ones do.
const RUSTFLAGS = `${process.env.RUSTFLAGS ?? ""} -C target-feature=+simd128`.trim();
// Cargo shows how far it is where someone looks at it.
const quiet = process.stdout.isTTY ? [] : ["--quiet"];
const compiledIn = step(
  `library: cargo compiles crates/web to WebAssembly${quick ? ", quickly and larger than it need be" : ""}. The first time takes minutes`,
);
run("cargo", ["build", ...quiet, "-p", "pleach-web", "--target", TRIPLE, "--profile", profile], {
  env: { ...process.env, RUSTFLAGS },
});

const made = join(target, "web");
rmSync(made, { recursive: true, force: true });
mkdirSync(made, { recursive: true });
const compiled = join(target, TRIPLE, profile, "pleach_web.wasm");
compiledIn(megabytes(statSync(compiled).size));
const boundIn = step("library: JavaScript that loads it");
const bindgen = process.env.PLEACH_BINDGEN;
if (bindgen) run(bindgen, [compiled, made]);
else run("cargo", ["run", ...quiet, "-p", "pleach-web-bindgen", "--", compiled, made]);

boundIn(megabytes(statSync(join(made, "pleach_web_bg.wasm")).size));

// Binaryen takes another tenth off.
const optimisedIn = step("library: wasm-opt makes it smaller and faster");
const optimiser = join(
  dirname(createRequire(import.meta.url).resolve("binaryen/package.json")),
  "bin",
  "wasm-opt",
);
const out = join(web, "src", "wasm");
mkdirSync(out, { recursive: true });
const features = [
  "bulk-memory",
  "nontrapping-float-to-int",
  "sign-ext",
  "mutable-globals",
  "multivalue",
  "reference-types",
  "simd",
];
run(process.execPath, [
  optimiser,
  join(made, "pleach_web_bg.wasm"),
  quick ? "-O1" : "-O3",
  "--strip-debug",
  "--strip-producers",
  ...features.map((feature) => `--enable-${feature}`),
  "-o",
  join(out, "pleach_web_bg.wasm"),
]);
for (const file of ["pleach_web.js", "pleach_web.d.ts", "pleach_web_bg.wasm.d.ts"]) {
  copyFileSync(join(made, file), join(out, file));
}

// The species, as the page lists them before the library is loaded.
const library = await import(pathToFileURL(join(out, "pleach_web.js")).href);
await library.default({ module_or_path: readFileSync(join(out, "pleach_web_bg.wasm")) });
writeFileSync(join(out, "catalogue.json"), library.catalogue());

// Drawings of the known species, for a first guess without growing them.
mkdirSync(join(web, "public"), { recursive: true });
copyFileSync(join(root, "crates", "pleach", "src", "plan", "known.bin"), join(web, "public", "known.bin"));
optimisedIn(`src/wasm has ${megabytes(statSync(join(out, "pleach_web_bg.wasm")).size)}`);
