// The species room's state: a recipe with undo, and what the library says of it.
import { computed, effect, signal } from "@preact/signals";
import { speciesClient } from "../engine/clients";
import { Latest } from "../engine/latest";
import type { OpenedSpecies, Slot, Spec, SpeciesSource } from "../engine/protocol";
import { History } from "./history";
import { sayError, sentence } from "./notes";

/** All that a tree needs to be grown again. */
export interface Recipe {
  source: SpeciesSource;
  /** The whole list of values, or null for the source's own. */
  values: readonly number[] | null;
  seed: number;
  /** "" is the species' own. */
  season: string;
}

export const FIRST: Recipe = { source: { builtin: "acer" }, values: null, seed: 1, season: "" };

export const recipes = new History<Recipe>(FIRST);
/** What the source declares; null until it is read. */
export const opened = signal<OpenedSpecies | null>(null);
export const active = signal<readonly boolean[]>([]);
export const locked = signal<ReadonlySet<string>>(new Set());
/** What the library has against the present values. */
export const refusal = signal<string | null>(null);
/** False until the room or a link asks for a tree: the other rooms need none. */
export const wanted = signal(false);

export const recipe = () => recipes.value;
export const values = computed<readonly number[]>(() => recipes.value.values ?? opened.value?.values ?? []);
export const spec = computed<Spec>(() => ({ source: recipes.value.source, values: recipes.value.values }));

export const speciesName = computed(() => {
  const { source } = recipes.value;
  return "builtin" in source ? source.builtin : source.name;
});

/** Of a grammar that is typed there are many sources. */
const KEPT = 40;
const kept = new Map<string, OpenedSpecies>();
const keyOf = (source: SpeciesSource) =>
  "builtin" in source ? source.builtin : `\n${source.name}\n${source.toml}`;

export async function openSource(source: SpeciesSource): Promise<OpenedSpecies> {
  const key = keyOf(source);
  const known = kept.get(key);
  if (known) return known;
  const read = await speciesClient.call("open", { source, values: null });
  kept.set(key, read);
  for (const oldest of kept.keys()) {
    if (kept.size <= KEPT) break;
    kept.delete(oldest);
  }
  return read;
}

/** Opens a species, as a step that can be undone. Throws if it cannot be read: then nothing changes. */
export async function start(source: SpeciesSource, change: Partial<Recipe> = {}): Promise<void> {
  const read = await openSource(source);
  locked.value = new Set();
  const season = recipes.peek().season;
  const keeps = season === "" || season === "winter" || read.info.seasons.includes(season);
  recipes.push({
    source,
    values: null,
    seed: read.info.tree_seed ?? 1,
    season: keeps ? season : "",
    ...change,
  });
}

export function change(part: Partial<Recipe>, key = ""): void {
  recipes.push({ ...recipes.peek(), ...part }, key);
}

export function setSlot(slot: Slot, value: number): void {
  const list = [...values.peek()];
  if (list[slot.index] === value) return;
  list[slot.index] = value;
  change({ values: list }, slot.slot);
}

/** The value that the source gives a slot. */
export const original = (slot: Slot): number => opened.value?.values[slot.index] ?? slot.default;

export function resetAll(): void {
  change({ values: null });
}

export function toggleLock(slot: string): void {
  const next = new Set(locked.peek());
  if (!next.delete(slot)) next.add(slot);
  locked.value = next;
}

export async function throwDice(strength: number): Promise<void> {
  const known = opened.peek();
  if (!known) return;
  const flags = new Uint8Array(known.values.length);
  for (const parameter of known.declared) {
    for (const slot of parameter.slots) if (locked.peek().has(slot.slot)) flags[slot.index] = 1;
  }
  const seed = Math.floor(Math.random() * 2 ** 31);
  const thrown = await speciesClient.call("dice", { spec: spec.peek(), seed, locked: flags, strength });
  change({ values: thrown });
}

/** The species as a file. `name` null keeps the file's own name. */
export function toToml(name: string | null = null): Promise<string> {
  const { seed } = recipes.peek();
  const own = opened.peek()?.info.tree_seed ?? 1;
  return speciesClient.call("toml", { spec: spec.peek(), name, treeSeed: seed === own ? null : seed });
}

const ask = new Latest<Spec>(
  async (input) => {
    const read = await openSource(input.source);
    if (keyOf(recipes.peek().source) === keyOf(input.source)) opened.value = read;
    active.value = input.values ? await speciesClient.call("active", input) : read.active;
    refusal.value = null;
  },
  (error) => {
    refusal.value = sentence(error);
  },
);

effect(() => {
  const { source } = recipes.value;
  // Parameters of another source must not be shown beside these values.
  const known = kept.get(keyOf(source));
  if (known) opened.value = known;
  else opened.value = null;
});

effect(() => {
  if (wanted.value) ask.ask(spec.value);
});

export const startOrSay = (source: SpeciesSource, part: Partial<Recipe> = {}) =>
  start(source, part).catch(sayError);
