// The last step of a build: tells the service worker which files there are.
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const WORKER = "service-worker.js";
/** Not the page's: only programs that show links load it. */
const OTHERS = [WORKER, "preview.jpg"];

const hash = (bytes) => createHash("sha256").update(bytes).digest();

/** All files of a built page with their hashes, and a version that changes with any of them. */
export function buildOf(folder) {
  const files = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name).slice(join(folder, "/").length).replaceAll("\\", "/"))
    .filter((path) => !OTHERS.includes(path))
    .sort()
    .map((path) => [path, `sha256-${hash(readFileSync(join(folder, path))).toString("base64")}`]);
  return { version: hash(JSON.stringify(files)).toString("hex").slice(0, 12), files };
}

/** Puts the list of a folder's files in the place of `before` in its service worker. */
export function writeBuild(folder, before) {
  const path = join(folder, WORKER);
  const text = readFileSync(path, "utf8");
  if (!text.includes(before)) throw new Error(`${path} has no place for the list of files`);
  writeFileSync(
    path,
    text.replace(before, () => JSON.stringify(buildOf(folder))),
  );
}

/** A plugin of Vite. */
export function offline() {
  let folder = "dist";
  return {
    name: "offline",
    apply: "build",
    configResolved(config) {
      folder = join(config.root, config.build.outDir);
    },
    buildStart() {
      this.emitFile({ type: "chunk", id: "src/offline/service-worker.ts", fileName: WORKER });
    },
    closeBundle() {
      writeBuild(folder, "__BUILD__");
    },
  };
}
