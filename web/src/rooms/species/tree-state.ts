// The mesh that the species room shows: grown in a worker, the newest wish first, coarse before fine.
import { computed, effect, signal } from "@preact/signals";
import { Refused } from "../../engine/client";
import { treeClient } from "../../engine/clients";
import { Latest } from "../../engine/latest";
import { thumbnails } from "../../engine/pool";
import type { CardPicture, MeshData, Spec, SpeciesSource } from "../../engine/protocol";
import { sentence } from "../../state/notes";
import { opened, recipes, spec, wanted } from "../../state/species";
import { debounce } from "../../state/store";
import { treeIsDrawn, vertexBudget } from "./view-budget";

export const LEAVES = ["outline", "simple", "cards", "none"] as const;
export type Leaves = (typeof LEAVES)[number];

const number = new Intl.NumberFormat("en");

/** As the switch above the tree calls them. */
export const levelName = (level: number) => (level === 0 ? "The finest level" : `LOD ${level}`);

/** How a file draws leaves at a level of detail: outlines are for the finest alone. */
export const leavesAt = (kind: Leaves, level: number): Leaves =>
  kind === "outline" && level > 0 ? "simple" : kind;

/** Telephones begin with fewer triangles. */
export const level = signal(matchMedia("(max-width: 820px)").matches ? 1 : 0);
export const leaves = signal<Leaves>("outline");
export interface Shown {
  data: MeshData;
  /** What was asked for: the mesh may be coarser. */
  asked: number;
  /** Where it has cards, of which species they are. */
  cardsOf: string | null;
}
export const mesh = signal<Shown | null>(null);
const growing = signal(false);
export const failure = signal<string | null>(null);
/** The line of the grammar that keeps the tree from growing, from 1. */
export const failedLine = signal<number | null>(null);

/** The level of the first answer while a slider moves. */
const COARSE = 2;

/** What the cards of a species show; null until it is drawn. Without it cards would be bare rectangles. */
const drawn = signal<{ key: string; source: string; cards: readonly CardPicture[] } | null>(null);

const NO_CARDS: readonly CardPicture[] = [];

/** Milliseconds without a change before the pictures of cards are drawn again. */
const QUIET = 700;

/** Milliseconds without a change before cards are drawn. */
const PAUSE = 300;

let drawings = 0;

/** The shape of leaves follows from the values, their colours from the season. */
const drawCards = debounce(QUIET, () => {
  const now = spec.peek();
  const { seed, season } = recipes.peek();
  const source = sourceOf({ spec: now, season });
  const key = `${source} ${leafValues(now)}`;
  if (leaves.peek() !== "cards" || drawn.peek()?.key === key) return;
  const mine = ++drawings;
  // Not in the worker of the mesh, which a slider waits for.
  thumbnails
    .call("cardPictures", { spec: now, seed, season })
    .then((cards) => {
      if (mine !== drawings) return;
      const before = drawn.peek();
      // Few changes of a species are changes of its leaves.
      const same = before?.source === source && isSame(before.cards, cards);
      drawn.value = { key, source, cards: same ? before.cards : cards };
    })
    .catch((error: unknown) => {
      if (mine !== drawings) return;
      failure.value = sentence(error);
      drawn.value = { key, source, cards: NO_CARDS };
    });
});

const bytes = (data: ArrayBufferView) => new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
const isEqual = (one: Uint8Array, other: Uint8Array) =>
  one.length === other.length && one.every((byte, at) => byte === other[at]);
const isSame = (some: readonly CardPicture[], others: readonly CardPicture[]) =>
  some.length === others.length &&
  some.every(({ material, png, uv }, at) => {
    const other = others[at];
    return other?.material === material && isEqual(png, other.png) && isEqual(bytes(uv), bytes(other.uv));
  });

const keyOf = (of: Spec, season: string) => JSON.stringify([of, season]);

/** The numbers on which the pictures of leaves and blossoms may depend. */
function leafValues({ values }: Spec): number[] {
  const slots = (opened.peek()?.declared ?? [])
    .filter(({ group, name }) => /lea[fv]|blossom/i.test(`${group} ${name}`))
    .flatMap((parameter) => parameter.slots);
  return values ? slots.map(({ index }) => values[index] ?? 0) : [];
}

const sourceOf = ({ spec: of, season }: Pick<Wish, "spec" | "season">) =>
  keyOf({ ...of, values: null }, season);
const sourceNow = computed(() => sourceOf({ spec: spec.value, season: recipes.value.season }));

/** Pictures of this species are there, if only from before the last step of a slider. Not all families have any. */
const hasCards = computed(() => drawn.value?.source === sourceNow.value && drawn.value.cards.length > 0);

/** Whether the view is not yet what was asked for. */
export const busy = computed(
  () => growing.value || (leaves.value === "cards" && drawn.value?.source !== sourceNow.value),
);

/** What the cards of the present mesh show; null where those pictures are gone, since another mesh is coming. */
export const cards = computed(() => {
  const of = mesh.value?.cardsOf ?? null;
  if (of === null) return NO_CARDS;
  return drawn.value?.source === of ? drawn.value.cards : null;
});

interface Wish {
  spec: Spec;
  seed: number;
  season: string;
  leaves: Leaves;
  level: number;
}

/** What is drawn on the way to a wish: coarse before fine, and plain leaves before cards. */
function stepsTo({ leaves: kind, level: fine }: Wish): Pick<Wish, "leaves" | "level">[] {
  const last = { leaves: kind, level: fine };
  if (kind === "cards") return [{ leaves: "simple", level: Math.max(fine, COARSE) }, last];
  return fine < COARSE ? [{ leaves: kind, level: COARSE }, last] : [last];
}

/** When the tree that grows now was begun. */
let begun: number | null = null;

/** Milliseconds that a tree may take while another waits for it. */
const PATIENCE = 800;

/** Gives up the tree that grows if it takes long: another is wanted now. */
function hurry(): void {
  const since = begun;
  if (since === null) return;
  const left = Math.max(0, since + PATIENCE - performance.now());
  setTimeout(() => {
    if (begun === since) treeClient.cancel();
  }, left);
}

const grower = new Latest<Wish>(
  async (wish, isStale) => {
    growing.value = true;
    const steps = stepsTo(wish);
    for (const [at, step] of steps.entries()) {
      // Cards take the graphics card longer than a slider may.
      if (at > 0 && step.leaves === "cards") await new Promise((go) => setTimeout(go, PAUSE));
      if (at > 0 && isStale()) return;
      const { leaves, level } = step;
      begun = performance.now();
      const input = { ...wish, leaves: leavesAt(leaves, level), level, most: vertexBudget() };
      const data = await treeClient.call("mesh", input).finally(() => {
        begun = null;
      });
      mesh.value = { data, asked: level, cardsOf: leaves === "cards" ? sourceOf(wish) : null };
      if (at + 1 < steps.length) await treeIsDrawn();
      failure.value = null;
      failedLine.value = null;
    }
    growing.value = false;
  },
  (error) => {
    growing.value = false;
    failedLine.value = error instanceof Refused ? error.line : null;
    failure.value = sentence(error);
  },
);

/** What the tree that grows now, or grew last, is of. */
let source: SpeciesSource | null = null;

/** A tree of another species is not waited for: one that runs away takes seconds. */
function giveUpOthers(wish: Wish): void {
  if (source !== wish.spec.source && growing.peek() && treeClient.pending === 1) treeClient.cancel();
  source = wish.spec.source;
}

effect(() => {
  const { seed, season } = recipes.value;
  const kind = leaves.value === "cards" && !hasCards.value ? "simple" : leaves.value;
  const wish = { spec: spec.value, seed, season, leaves: kind, level: level.value };
  if (!wanted.value) return;
  giveUpOthers(wish);
  hurry();
  grower.ask(wish);
  if (leaves.value === "cards") drawCards();
});

export interface Counts {
  bark: number;
  leaves: number;
  vertices: number;
}

/** In words, that what was asked for is too much for the view; null where it is not. */
export function coarser({ data, asked }: Shown): string | null {
  const drawn = data.indices.length / 3;
  // What is coarse on the way to what was asked for is soon gone.
  if (data.wanted <= drawn || asked !== level.value) return null;
  const has = `${levelName(asked)} has ${number.format(data.wanted)} triangles, too many for this view.`;
  const shown =
    data.level > asked ? `${levelName(data.level)} is shown.` : `The thinnest stems are left out.`;
  return `${has} ${shown}`;
}

export function counts(data: MeshData): Counts {
  const triangles = (bark: boolean) =>
    data.parts
      .filter((part) => (part.material === "bark") === bark)
      .reduce((sum, part) => sum + part.count / 3, 0);
  return { bark: triangles(true), leaves: triangles(false), vertices: data.positions.length / 3 };
}
