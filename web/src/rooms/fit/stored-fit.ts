// A goal and its fit as the browser stores them: masks are packed, photographs are left out.
import type { Card, Corrections, FitReport, FitResult } from "../../engine/protocol";
import { pack, packBits, unpack, unpackBits } from "../../state/codec";
import {
  fields,
  flag,
  list,
  number,
  oneOf,
  orMissing,
  orNull,
  type Shape,
  some,
  text,
  whole,
} from "../../state/shape";
import { chooseGoal, type GoalPicture, picture, restoreGoal, type WholeGoal } from "./goal-state";
import { type CurvePoint, type Fitted, record } from "./record";

export interface StoredGoal extends Omit<GoalPicture, "id" | "photo"> {
  ink: string;
  ground: number | null;
  axis: number | null;
  painted: boolean;
  corrections: Corrections | undefined;
}
export interface StoredFit {
  result: FitResult;
  curve: readonly CurvePoint[];
  width: number;
  height: number;
  ink: string;
  ownInk: string | null;
  goal: string;
}

const isCorrections: Shape<Corrections> = some({
  trunks: whole,
  trunk_width: number,
  lean_deg: number,
  bare_height: number,
  first_fork: number,
  colors: some({ leaf: text, bark: text }),
});

const goalFields = {
  name: text,
  width: whole,
  height: whole,
  full: fields({ width: whole, height: whole }),
  target: orNull(text),
  masked: flag,
  confidence: orNull(number),
  ink: text,
  ground: orNull(number),
  axis: orNull(number),
  painted: flag,
  corrections: orMissing(isCorrections),
};
export const isStoredGoal: Shape<StoredGoal> = fields(goalFields);

const cardFields = {
  likeness: number,
  likeness_parts: fields({ mass: number, rim: number, strokes: number, gaps: number }),
  iou: number,
  best_ellipse_iou: number,
  pixel_accuracy: number,
  empty_accuracy: number,
  dice: number,
  boundary_f: number,
} satisfies Record<keyof Card, Shape<unknown>>;

const spread = fields({ mean: number, sd: number });
const reference = fields({ likeness: number, iou: number });

const isReport: Shape<FitReport> = fields({
  ...cardFields,
  species: text,
  next: orMissing(list(text)),
  fresh_seeds: orNull(fields({ count: number, likeness: spread, iou: spread })),
  individual: orNull(fields({ ...cardFields, stems: number })),
  references: orNull(
    fields({
      species: orNull(text),
      same_species: orNull(reference),
      other_species: orNull(reference),
      best_ellipse: reference,
    }),
  ),
  readings: fields({ differences: list(fields({ measure: text, size: number, words: text })) }),
  parameters: list(
    fields({
      slot: text,
      value: number,
      seen: oneOf("determined", "loosely", "not-seen", "not-tried"),
      interval: orNull(fields({ low: number, high: number })),
    }),
  ),
  intervals: orNull(fields({ species: text, is_familiar: flag })),
});

const isResult: Shape<FitResult> = fields({
  report: isReport,
  verdict: orNull(text),
  toml: text,
  own_toml: orNull(text),
});

export const isStoredFit: Shape<StoredFit> = fields({
  result: isResult,
  curve: list(fields({ seconds: number, likeness: number, iou: number })),
  width: whole,
  height: whole,
  ink: text,
  ownInk: orNull(text),
  goal: text,
});

const packInk = (ink: Uint8Array) => pack(packBits(ink));

/** Throws if it is not a mask of so many pixels. */
export async function unpackInk(packed: string, pixels: number): Promise<Uint8Array<ArrayBuffer>> {
  const bits = await unpack(packed);
  if (!(pixels > 0) || bits.length !== Math.ceil(pixels / 8)) throw new Error("A stored mask is incomplete.");
  return unpackBits(bits, pixels);
}

export async function packGoal({ picture: shown, mask }: WholeGoal): Promise<StoredGoal> {
  const { id: _id, photo: _photo, ...told } = shown;
  const { ink, ground, axis, painted, corrections } = mask;
  return { ...told, ground, axis, painted, corrections, ink: await packInk(ink) };
}

/** Null for a fit without a result. */
export async function packFit(held: Fitted | null): Promise<StoredFit | null> {
  if (!held?.result || !held.best) return null;
  const { result, curve, width, height, best, goal } = held;
  return {
    result,
    curve,
    width,
    height,
    ink: await packInk(best.ink),
    ownInk: best.ownInk && (await packInk(best.ownInk)),
    goal: await packInk(goal),
  };
}

/** The pictures of a fit: its goal, the tree of the kind, and this very tree where it was found. */
export async function unpackInks({ width, height, ink, ownInk, goal }: StoredFit) {
  const pixels = width * height;
  return {
    goal: await unpackInk(goal, pixels),
    ink: await unpackInk(ink, pixels),
    ownInk: ownInk === null ? null : await unpackInk(ownInk, pixels),
  };
}

/**
 * Makes a stored goal the goal, and its fit the fit, unless another goal is chosen meanwhile. Throws if a mask is damaged,
 * and the goal stays as it is.
 */
export async function openStored(stored: {
  goal: StoredGoal;
  fit: StoredFit | null;
  treeHeight: number;
}): Promise<void> {
  const isLast = chooseGoal();
  const { ink, ground, axis, painted, corrections = {}, ...told } = stored.goal;
  const mask = await unpackInk(ink, told.width * told.height);
  const { fit } = stored;
  const inks = fit && (await unpackInks(fit));
  if (!isLast()) return;
  restoreGoal(
    told,
    { ink: mask, ground, axis, painted, strokes: [], reading: 0, corrections },
    stored.treeHeight,
  );
  const id = picture.peek()?.id;
  if (!fit || !inks || id === undefined) return;
  const { result, curve, width, height } = fit;
  const best = { ink: inks.ink, ownInk: inks.ownInk };
  const shape = { id, width, height, goal: inks.goal };
  record.value = { ...shape, guess: null, curve, best, soFar: null, result, earlier: null };
}
