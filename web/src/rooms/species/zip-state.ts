// Several trees of a kind in one zip: what it costs, and writing it.
import { signal } from "@preact/signals";
import { zipClient } from "../../engine/clients";
import type { ExportOptions, MeshFormat, ZipTree } from "../../engine/protocol";
import { announce, say, sayError } from "../../state/notes";
import { cost } from "../../ui/cost";
import { download, fileName } from "../../ui/files";

export interface ZipJob {
  readonly name: string;
  readonly trees: readonly ZipTree[];
  readonly format: MeshFormat;
  readonly options: ExportOptions;
}

/** How many trees a zip has. */
export const MANY = 8;

/** So many seeds of a kind besides one. */
export const otherSeeds = (own: number, count: number): number[] =>
  Array.from({ length: count + 1 }, (_, at) => at + 1)
    .filter((seed) => seed !== own)
    .slice(0, count);

export const keyOf = (job: ZipJob) => JSON.stringify(job);

/** What a job costs, by its first tree. */
export const estimate = signal<{ key: string; words: string } | null>(null);
/** How far the zip is that is written; null where none is. */
export const writing = signal<{ text: string; share: number } | null>(null);

let asked = 0;

/** Writes the first tree of a job and keeps only how large it is. */
export async function measure(job: ZipJob): Promise<void> {
  const key = keyOf(job);
  const mine = ++asked;
  if (estimate.peek()?.key === key || writing.peek()) return;
  // What is measured now is of no use any more.
  if (zipClient.pending > 0) zipClient.cancel();
  const { trees, format, options } = job;
  const first = trees.slice(0, 1);
  const { zip, triangles } = await zipClient.call("zip", { trees: first, format, options });
  if (mine !== asked) return;
  const times = trees.length;
  const all = triangles === null ? null : round(times * triangles);
  estimate.value = { key, words: `about ${cost(all, times * zip.size)}` };
}

/** To two digits: the trees are not of one size. */
const round = (count: number) => Number(count.toPrecision(2));

export async function writeZip(job: ZipJob): Promise<void> {
  if (writing.peek()) return;
  asked++;
  zipClient.cancel();
  writing.value = { text: "Starting", share: 0 };
  announce("Writing the zip");
  try {
    const { name, trees, format, options } = job;
    const { zip, triangles, notes } = await zipClient.call("zip", { trees, format, options }, (now) => {
      writing.value = { text: now.stage, share: (now.done ?? 0) / (now.all ?? 1) };
    });
    const file = fileName(`${name}-${trees.length}-trees`, "zip");
    download(file, zip);
    for (const note of notes) say(note);
    say(`${file} is written: ${trees.length} trees, ${cost(triangles, zip.size)}.`);
  } catch (error) {
    sayError(error);
  } finally {
    writing.value = null;
  }
}

export function cancelZip(): void {
  zipClient.cancel();
  announce("The zip is cancelled");
}
