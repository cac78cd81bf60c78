// The end of a build: what the page weighs, and what a visit loads.
import { readdirSync, readFileSync } from "node:fs";
import { join, relative } from "node:path";
import { gzipSync } from "node:zlib";
import { megabytes } from "./step.mjs";

/** Not loaded with the page, but when a room asks for it; what is not named here comes at once. */
const LATER = [
  ["three.js, with the first tree in three dimensions", /(scene-view|tree-view|model-view|growing-worker)-/],
  ["drawings of known species, with the first fit", /known\.bin$/],
  ["goals, each when it is seen", /^targets\//],
  ["of apps, service workers and links", /^(icon-|preview|manifest|service-worker)/],
];

/** Pictures and drawings are compressed already. */
const SHRINKS = /\.(css|html|js|json|svg|wasm|webmanifest)$/;

/** Bytes as they are and as hosts send them, by when they are loaded. */
export function weigh(folder) {
  const files = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(folder, join(entry.parentPath, entry.name)).replaceAll("\\", "/"));
  const first = { name: "the page and its library", files: 0, bytes: 0, sent: 0 };
  const later = LATER.map(([name]) => ({ name, files: 0, bytes: 0, sent: 0 }));
  for (const path of files) {
    const content = readFileSync(join(folder, path));
    const group = later[LATER.findIndex(([, pattern]) => pattern.test(path))] ?? first;
    group.files += 1;
    group.bytes += content.length;
    group.sent += SHRINKS.test(path) ? gzipSync(content).length : content.length;
  }
  return [first, ...later];
}

/** A plugin of Vite, behind all that write files. */
export function sizes() {
  let folder = "dist";
  return {
    name: "sizes",
    apply: "build",
    configResolved(config) {
      folder = join(config.root, config.build.outDir);
    },
    closeBundle: {
      order: "post",
      handler() {
        const groups = weigh(folder);
        const all = groups.reduce((sum, { files }) => sum + files, 0);
        const bytes = groups.reduce((sum, group) => sum + group.bytes, 0);
        console.log(`dist is ready: ${all} files, ${megabytes(bytes)}. Compressed with gzip:`);
        for (const { name, sent } of groups) console.log(`  ${megabytes(sent).padStart(8)}  ${name}`);
      },
    },
  };
}
