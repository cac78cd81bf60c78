// Species between two others, and what each was made of.
import { computed } from "@preact/signals";
import { speciesClient } from "../engine/clients";
import { Latest } from "../engine/latest";
import type { Spec, SpeciesSource } from "../engine/protocol";
import { sayError } from "./notes";
import { change, openSource, recipes, spec, speciesName } from "./species";

interface End {
  readonly spec: Spec;
  readonly name: string;
}

export interface Pair {
  readonly from: End;
  readonly to: End;
  /** 0 is the first of the two, 1 the second. */
  readonly at: number;
}

/** By the text of the species file that a pair gave: so a step back finds it again. */
const made = new Map<string, Pair>();
const KEPT = 200;

function keep(toml: string, pair: Pair): void {
  made.set(toml, pair);
  const oldest = made.keys().next().value;
  if (made.size > KEPT && oldest !== undefined) made.delete(oldest);
}

/** What the open species was made of, if it is between two. */
export const pair = computed<Pair | null>(() => {
  const { source } = recipes.value;
  return "toml" in source ? (made.get(source.toml) ?? null) : null;
});

/** In characters: names of species may not be much longer. */
const MAX_NAME = 48;

interface Wish {
  readonly wanted: Pair;
  /** Steps with the same key that follow each other closely are undone together. */
  readonly key: string;
}

const blender = new Latest<Wish>(async ({ wanted, key }, isStale) => {
  const { from, to, at } = wanted;
  const before = recipes.peek();
  const name = [...`${from.name}_${to.name}`].slice(0, MAX_NAME).join("");
  const toml = await speciesClient.call("blend", { from: from.spec, to: to.spec, at, name });
  const source = { toml, name };
  await openSource(source);
  // Another species may have been opened meanwhile.
  if (isStale() || recipes.peek() !== before) return;
  keep(toml, wanted);
  change({ source, values: null }, key);
}, sayError);

/** Blends the open species, as it is, with another. */
export function blendWith(source: SpeciesSource, name: string): void {
  const from = pair.peek()?.from ?? { spec: spec.peek(), name: speciesName.peek() };
  const to = { spec: { source, values: null }, name };
  blender.ask({ wanted: { from, to, at: 0.5 }, key: "" });
}

/** Moves the open species between the two that it was made of. */
export function moveBlend(at: number): void {
  const now = pair.peek();
  if (now) blender.ask({ wanted: { ...now, at }, key: "blend" });
}

/** Goes back to the first of the two. */
export function endBlend(): void {
  const now = pair.peek();
  if (now) change({ source: now.from.spec.source, values: now.from.spec.values });
}
