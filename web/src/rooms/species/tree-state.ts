// The mesh that the species room shows: grown in a worker, the newest wish first, coarse before fine.
import { effect, signal } from "@preact/signals";
import { treeClient } from "../../engine/clients";
import { Latest } from "../../engine/latest";
import type { MeshData, Spec } from "../../engine/protocol";
import { sentence } from "../../state/notes";
import { recipes, spec, wanted } from "../../state/species";

export const LEAVES = ["outline", "simple", "cards", "none"] as const;
export type Leaves = (typeof LEAVES)[number];

/** Telephones begin with fewer triangles. */
export const level = signal(matchMedia("(max-width: 820px)").matches ? 1 : 0);
export const leaves = signal<Leaves>("outline");
export const mesh = signal<{ data: MeshData; level: number } | null>(null);
export const growing = signal(false);
export const failure = signal<string | null>(null);

/** The level of the first answer while a slider moves. */
const COARSE = 2;

interface Wish {
  spec: Spec;
  seed: number;
  season: string;
  leaves: Leaves;
  level: number;
}

const grower = new Latest<Wish>(
  async (wish, isStale) => {
    growing.value = true;
    const steps = wish.level < COARSE ? [COARSE, wish.level] : [wish.level];
    for (const step of steps) {
      const data = await treeClient.call("mesh", { ...wish, level: step });
      mesh.value = { data, level: step };
      failure.value = null;
      if (isStale()) return;
    }
    growing.value = false;
  },
  (error) => {
    growing.value = false;
    failure.value = sentence(error);
  },
);

effect(() => {
  const { seed, season } = recipes.value;
  const wish = { spec: spec.value, seed, season, leaves: leaves.value, level: level.value };
  if (wanted.value) grower.ask(wish);
});

export interface Counts {
  bark: number;
  leaves: number;
  vertices: number;
}

export function counts(data: MeshData): Counts {
  const triangles = (bark: boolean) =>
    data.parts
      .filter((part) => (part.material === "bark") === bark)
      .reduce((sum, part) => sum + part.count / 3, 0);
  return { bark: triangles(true), leaves: triangles(false), vertices: data.positions.length / 3 };
}
