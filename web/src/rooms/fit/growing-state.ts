// The best tree so far in three dimensions, while the search runs. The search comes first: trees are grown by a worker of
// their own, and so rarely that little of the processor goes into them.
import { effect, signal } from "@preact/signals";
import { Client } from "../../engine/client";
import { Latest } from "../../engine/latest";
import { picturesOnly } from "../../engine/pictures-only";
import { cores } from "../../engine/pool";
import type { PicturedMesh, SpeciesSource } from "../../engine/protocol";
import type { Growing } from "../../view3d/growing-protocol";
import { running } from "./fit-state";
import { bestToml, guess } from "./record";

const client = new Client("the growing tree");

/** The tree that is to be seen; null where no search runs. */
export const growing = signal<Growing | null>(null);

/** A modest level of detail, and its most vertices: the graphics card gets them within a few milliseconds. */
const LEVEL = 3;
const MOST = 40_000;

/** Milliseconds from a tree to the next: at least these, and so many that all cores spend no more than this share. */
const LEAST = 1000;
const SHARE = 0.02;
/** Milliseconds between pictures of bark and leaves, which take longer than trees. */
const PICTURES_EVERY = 10_000;

/** What it took to draw the last tree, which a processor may have done in the place of a graphics card. */
let drawing = 0;
/** How many trees of searches were drawn, with how many shader programs: for the test that they share theirs. */
export const drawn = { trees: 0, programs: 0 };

export function treeIsDrawn(milliseconds: number, programs: number): void {
  drawing = milliseconds;
  drawn.trees++;
  drawn.programs = programs;
}

interface Pictures {
  file: Growing["pictures"];
  looks: string;
  /** Whether the search had begun: before it, generators are tried in turn. */
  searching: boolean;
  time: number;
}
let pictures: Pictures | null = null;

async function picturesFor({ looks }: PicturedMesh, source: SpeciesSource): Promise<Growing["pictures"]> {
  const searching = guess.peek() !== null;
  if (pictures) {
    const waits = pictures.searching === searching && performance.now() - pictures.time < PICTURES_EVERY;
    if (pictures.looks === looks) pictures = { ...pictures, searching };
    if (pictures.looks === looks || waits) return pictures.file;
  }
  const spec = { source, values: null };
  const input = { spec, seed: 1, format: "glb", stem: "growing", options: picturesOnly("") } as const;
  const { files } = await client.call("export", input);
  const [file] = files;
  if (!file) throw new Error("The library has written no file.");
  pictures = { file: file.bytes, looks, searching, time: performance.now() };
  return file.bytes;
}

/** Ends the pause after a tree. */
let wake = () => {};

const grower = new Latest<string>(
  async (toml) => {
    const begun = performance.now();
    const source = { toml, name: "growing" };
    const tree = await client.call("picturedMesh", { source, level: LEVEL, most: MOST });
    const spent = performance.now() - begun;
    const file = await picturesFor(tree, source);
    if (!running.peek()) return;
    growing.value = { tree, pictures: file };
    const pause = Math.max(LEAST, (spent + drawing) / (SHARE * cores));
    await new Promise<void>((go) => {
      wake = go;
      setTimeout(go, pause);
    });
  },
  // The flat picture is there all the same.
  () => {},
);

effect(() => {
  const toml = bestToml.value;
  if (toml !== null && running.value) grower.ask(toml);
});

effect(() => {
  if (running.value) return;
  client.cancel();
  wake();
  growing.value = null;
  drawing = 0;
});
