// The fitted tree as a GLB file: the one that is shown is the one that is saved.
import { computed, signal } from "@preact/signals";
import { fileClient } from "../../engine/clients";
import { Glb } from "../../engine/glb";
import { Latest } from "../../engine/latest";
import { sentence } from "../../state/notes";
import { openSource } from "../../state/species";
import { fileName } from "../../ui/files";
import { BUDGETS, optionsFor } from "../species/exports";
import { shownTree } from "./record";

export interface Wanted {
  readonly name: string;
  readonly toml: string;
  /** Empty for the species' own. */
  readonly season: string;
}

/** The season in which the tree is shown and saved. */
export const season = signal("");

/** Whether wind blows in the view. */
export const blowing = signal(false);

/** The seasons that the species knows; empty until it is read. */
export const seasons = signal<readonly string[]>([]);

export interface Model {
  readonly of: Wanted;
  /** Of the file. */
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly triangles: number;
  /** What the user is to be told, or empty. */
  readonly note: string;
}

/** The file that belongs to what is shown. */
export const wanted = computed<Wanted | null>(() => {
  const tree = shownTree.value;
  return tree && { name: tree.name, toml: tree.toml, season: season.value };
});

/** The last file that was written; null before the first. */
export const model = signal<Model | null>(null);
export const drawing = signal(false);
export const modelFailure = signal<string | null>(null);

/** This very tree and its kind, so that going between them is quick. */
const KEPT = 2;
const kept = new Map<string, Model>();

const keyOf = ({ toml, season: when }: Wanted) => `${when}\n${toml}`;
export const isOf = (made: Model | null, of: Wanted) => made !== null && keyOf(made.of) === keyOf(of);
export async function modelOf(of: Wanted): Promise<Model> {
  const known = kept.get(keyOf(of));
  if (known) return known;
  const source = { name: of.name, toml: of.toml };
  const spec = { source, values: null };
  const { info } = await openSource(source);
  seasons.value = info.seasons;
  const options = optionsFor("glb", BUDGETS[0], { wind: true, season: of.season || null });
  const name = fileName(of.season ? `${of.name}-${of.season}` : of.name, "glb");
  const input = { spec, seed: info.tree_seed ?? 1, format: "glb", stem: of.name, options } as const;
  const { files, note } = await fileClient.call("export", input);
  const [file] = files;
  if (!file) throw new Error("The library has written no file.");
  const made = { of, name, bytes: file.bytes, triangles: new Glb(file.bytes).triangles, note };
  kept.set(keyOf(of), made);
  const oldest = kept.keys().next().value;
  if (kept.size > KEPT && oldest !== undefined) kept.delete(oldest);
  return made;
}

const drawer = new Latest<Wanted>(
  async (of, isStale) => {
    drawing.value = true;
    modelFailure.value = null;
    const made = await modelOf(of);
    if (isStale()) return;
    model.value = made;
    drawing.value = false;
  },
  (error) => {
    drawing.value = false;
    modelFailure.value = sentence(error);
  },
);

export const drawModel = (of: Wanted) => drawer.ask(of);
