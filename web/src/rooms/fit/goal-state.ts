// The goal: its mask, the two lines, undo, and where it came from.
import { signal } from "@preact/signals";
import { goalClient } from "../../engine/clients";
import { thumbnails } from "../../engine/pool";
import type { Corrections, GoalInfo, GoalPixels, MaskHints, MaskWay } from "../../engine/protocol";
import { History } from "../../state/history";
import { announce, sayError, sentence } from "../../state/notes";
import { baseName } from "../../ui/files";

/** What undo goes back to: the mask and the lines. */
export interface Mask {
  ink: Uint8Array<ArrayBuffer>;
  /** Null where the library finds the line. */
  ground: number | null;
  axis: number | null;
}

export interface GoalPicture {
  name: string;
  width: number;
  height: number;
  /** RGBA; null if there is only the mask. */
  photo: Uint8Array<ArrayBuffer> | null;
  /** The file in `targets/` that it is. */
  target: string | null;
}

export const picture = signal<GoalPicture | null>(null);
export const masks = new History<Mask>({ ink: new Uint8Array(0), ground: null, axis: null });
export const info = signal<GoalInfo | null>(null);
export const reading = signal<string | null>(null);
export const goalError = signal<string | null>(null);
/** What the user says is otherwise in the picture than it is read. */
export const corrections = signal<Corrections>({});
export const treeHeight = signal(12);

const USUAL_HEIGHT = 12;
/** Larger files are not read: the picture would not fit into a worker's memory. */
const MAX_FILE = 150_000_000;

/** The picture in colour, RGBA, whether it is shown or not; null where it is not known. */
let colored: Uint8Array<ArrayBuffer> | null = null;

/** The bytes of the picture, to read it once more in another way. */
let lastBytes: { name: string; bytes: Uint8Array; target: string | null } | null = null;

async function read(
  name: string,
  bytes: Uint8Array,
  mask: MaskWay,
  target: string | null,
  hints: MaskHints = {},
): Promise<void> {
  reading.value = name;
  goalError.value = null;
  announce(`Reading ${name}`);
  try {
    const goal = await goalClient.call("goalRead", { name, bytes, mask, hints });
    const { width, height } = goal.info;
    // A silhouette is its own mask: there is nothing to see beneath it.
    const shows = goal.info.masked || mask === "off";
    const photo = shows && goal.photo.length === width * height * 4 ? goal.photo : null;
    lastBytes = { name, bytes, target };
    colored = goal.photo.length === width * height * 4 ? goal.photo : null;
    corrections.value = {};
    masks.reset({ ink: goal.ink, ground: null, axis: null });
    info.value = goal.info;
    picture.value = { name: baseName(goal.info.name || name), width, height, photo, target };
    announce(`${name} is the goal`);
  } catch (error) {
    // The goal before stays as it is.
    goalError.value = sentence(error);
  } finally {
    reading.value = null;
  }
}

export async function takePicture(file: File): Promise<void> {
  if (file.size > MAX_FILE) {
    goalError.value = `${file.name} has ${Math.round(file.size / 1e6)} MB: a picture of at most 150 MB is needed.`;
    return;
  }
  await read(file.name, new Uint8Array(await file.arrayBuffer()), "auto", null);
}

/** Reads the same picture again, as a photograph or as a drawing, with what is shown of the tree in it. */
export async function readAgain(mask: MaskWay, hints: MaskHints = {}): Promise<void> {
  if (lastBytes) await read(lastBytes.name, lastBytes.bytes, mask, lastBytes.target, hints);
}

export const canReadAgain = () => lastBytes !== null;

export async function takeTarget(file: string): Promise<void> {
  const response = await fetch(new URL(`targets/${file}`, document.baseURI));
  if (!response.ok)
    throw new Error(`${file} could not be loaded: ${response.status} ${response.statusText}.`);
  await read(file, new Uint8Array(await response.arrayBuffer()), "auto", file);
  treeHeight.value = await usualHeight(baseName(file));
}

/** The height of the grown species of this name, or a usual one. */
async function usualHeight(name: string): Promise<number> {
  try {
    const spec = { source: { builtin: name }, values: null };
    const { stats } = await thumbnails.call("silhouette", { spec, seed: 1, size: 16, coarse: true });
    return Number(stats.height.toFixed(2));
  } catch {
    return USUAL_HEIGHT;
  }
}

/** The goal as workers take it; null without one. */
export function goalPixels(): GoalPixels | null {
  const shown = picture.peek();
  if (!shown) return null;
  const { ink, ground, axis } = masks.peek();
  return { name: shown.name, width: shown.width, height: shown.height, ink, ground, axis, colors: null };
}

/** A copy of the picture in colour, as workers take it. */
export const photoPixels = () => colored?.slice() ?? null;

/** A changed mask: the library reads it at once. */
export function setMask(part: Partial<Mask>, key = ""): void {
  masks.push({ ...masks.peek(), ...part }, key);
  checkGoal();
}

export function undoMask(): void {
  masks.undo();
  checkGoal();
}

export function redoMask(): void {
  masks.redo();
  checkGoal();
}

let checks = 0;

function checkGoal(): void {
  const pixels = goalPixels();
  if (!pixels) return;
  const mine = ++checks;
  goalClient
    .call("goalCheck", { ...pixels, ink: pixels.ink.slice() })
    .then((found) => {
      if (mine !== checks) return;
      info.value = found;
      goalError.value = null;
    })
    .catch((error: unknown) => {
      if (mine === checks) goalError.value = sentence(error);
    });
}

export function restoreGoal(shown: GoalPicture, mask: Mask): void {
  colored = null;
  picture.value = shown;
  masks.reset(mask);
  checkGoal();
}

let list: Promise<readonly string[]> | undefined;

/** The pictures that the page offers. */
export function targets(): Promise<readonly string[]> {
  list ??= fetch(new URL("targets/list.json", document.baseURI))
    .then((response) => (response.ok ? (response.json() as Promise<string[]>) : []))
    .catch((error: unknown) => {
      sayError(error);
      return [];
    });
  return list;
}
