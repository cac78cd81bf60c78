// A fit and what it found: one record, which belongs to one goal and goes with it.
import { batch, computed, effect, signal } from "@preact/signals";
import type { Card, FitResult, Guess } from "../../engine/protocol";
import { chooseGoal, masks, picture, putGoal, treeHeight, type WholeGoal, wholeGoal } from "./goal-state";

export interface CurvePoint {
  seconds: number;
  likeness: number;
  iou: number;
}

/** The best tree so far, in the goal's frame. */
export interface Best {
  ink: Uint8Array<ArrayBuffer>;
  /** This very tree, once it was found. */
  ownInk: Uint8Array<ArrayBuffer> | null;
}

export interface Fitted {
  /** The picture's, of which the goal is. */
  readonly id: number;
  readonly width: number;
  readonly height: number;
  /** The mask that it was fitted to, which may be painted over since. */
  readonly goal: Uint8Array<ArrayBuffer>;
  readonly guess: Guess | null;
  readonly curve: readonly CurvePoint[];
  readonly best: Best | null;
  /** Its species, while the search runs and if it fails. */
  readonly soFar: string | null;
  readonly result: FitResult | null;
  /** The last that was finished, while the same goal is fitted again. */
  readonly earlier: Fitted | null;
}

/** It or, before it has its result, the one that it is to replace. */
export const finished = (fit: Fitted | null): Fitted | null => (fit?.result ? fit : (fit?.earlier ?? null));

export const record = signal<Fitted | null>(null);

export function change(part: Partial<Fitted>): void {
  const before = record.peek();
  if (before) record.value = { ...before, ...part };
}

export const guess = computed(() => record.value?.guess ?? null);
export const result = computed(() => record.value?.result ?? null);
const NO_CURVE: readonly CurvePoint[] = [];
export const curve = computed(() => record.value?.curve ?? NO_CURVE);
export const bestToml = computed(() => record.value?.soFar ?? null);

/** The best tree with the goal that it lies on. */
export const best = computed(() => {
  const now = record.value;
  return now?.best ? { ...now.best, goal: now.goal, width: now.width, height: now.height } : null;
});

/** Which of the trees that were found is shown and saved: the goal's own, or one of its kind. */
type Found = "own" | "kind";
export const which = signal<Found>("own");

/** Another tree of the kind. */
interface Other {
  readonly seed: number;
  readonly toml: string;
  /** The species file of the kind. */
  readonly kind: string;
}
const picked = signal<Other | null>(null);

/** The other tree that was picked of this kind, in the place of the trees that were found. */
export const other = computed(() => (picked.value?.kind === result.value?.toml ? picked.value : null));

export function pick(next: Found | Other): void {
  batch(() => {
    picked.value = typeof next === "string" ? null : next;
    if (typeof next === "string") which.value = next;
  });
}

/** The tree that is shown, of those that there are. */
export const shownWhich = computed<Found | "other">(() => {
  if (other.value) return "other";
  return record.value?.best?.ownInk ? which.value : "kind";
});

export const shownInk = computed(() => {
  const now = record.value?.best;
  return now && ((shownWhich.value === "own" && now.ownInk) || now.ink);
});

/** The species file of the tree that is shown, and its scores; another tree of the kind has those of the first. */
export const shownTree = computed<{ name: string; toml: string; card: Card } | null>(() => {
  const fit = result.value;
  if (!fit) return null;
  const { report, toml, own_toml: own } = fit;
  const name = report.species;
  if (shownWhich.value === "own" && own !== null && report.individual) {
    return { name, toml: own, card: report.individual };
  }
  const another = other.value;
  if (another) return { name: `${name}-${another.seed}`, toml: another.toml, card: report };
  return { name, toml, card: report };
});

/** Whether the mask is otherwise than the one that was fitted. */
export const outdated = computed(() => {
  const goal = record.value?.goal;
  const { ink } = masks.value;
  if (!goal || goal === ink) return false;
  return goal.length !== ink.length || goal.some((pixel, at) => pixel !== ink[at]);
});

/** The goal before this one, and its fit: a picture that was dropped by mistake costs nothing. */
export const before = signal<{ goal: WholeGoal; fit: Fitted } | null>(null);

export function goBack(): void {
  const back = before.peek();
  if (!back) return;
  // From there one can come back to the present one.
  before.value = null;
  chooseGoal();
  putGoal(back.goal);
  record.value = back.fit;
}

let last: WholeGoal | null = null;

// The record goes with its goal, whatever the way in which another one came.
effect(() => {
  const shown = picture.value;
  masks.value;
  treeHeight.value;
  const held = record.peek();
  if (held && held.id !== shown?.id) {
    const fit = finished(held);
    // A goal without a tree takes nobody's place.
    if (last && fit) before.value = { goal: last, fit };
    record.value = null;
  }
  last = wholeGoal();
});
