// The goal: its mask, the two lines, what is said of it, undo, and where it came from.
import { batch, computed, signal } from "@preact/signals";
import { goalClient } from "../../engine/clients";
import { thumbnails } from "../../engine/pool";
import type { Corrections, GoalInfo, GoalPixels, MaskHints, MaskWay } from "../../engine/protocol";
import { announce, sayError, sentence } from "../../state/notes";
import { baseName } from "../../ui/files";
import { isColored } from "./colored";
import { type Mask, MaskHistory } from "./mask-history";
import { places } from "./strokes";
import { isSvg, paintSvg } from "./svg-picture";

export interface GoalPicture {
  /** The same for as long as it is the same file, however it is read. */
  id: number;
  name: string;
  width: number;
  height: number;
  /** Pixels of the file: more than the above if it is large. */
  full: { width: number; height: number };
  /** RGBA; null if there is only the mask. */
  photo: Uint8Array<ArrayBuffer> | null;
  /** The file in `targets/` that it is. */
  target: string | null;
  /** Whether a tree was found in a photograph, and how surely. */
  masked: boolean;
  confidence: number | null;
}

export const picture = signal<GoalPicture | null>(null);
export const masks = new MaskHistory();
export const info = signal<GoalInfo | null>(null);
export const reading = signal<string | null>(null);
export const goalError = signal<string | null>(null);
/** What the user says is otherwise in the picture than it is read. */
export const corrections = computed(() => masks.value.corrections);

/** That of the library, which says after a fit that another one could be told. */
const USUAL_HEIGHT = 10;
export const treeHeight = signal(USUAL_HEIGHT);
/** Larger files are not read: the picture would not fit into a worker's memory. */
const MAX_FILE = 150_000_000;

/** What is kept of a picture's file, and never stored. */
interface Source {
  name: string;
  bytes: Uint8Array;
  target: string | null;
  /** The picture in colour, RGBA, whether it is shown or not; null where it is not known. */
  colored: Uint8Array<ArrayBuffer> | null;
  /** What was said of the mask before anything was painted, and the reading that it was of. */
  asRead: { reading: number; info: GoalInfo };
  /** What it was found by. */
  hints: MaskHints;
}
let source: Source | null = null;

/** A goal with all that belongs to it, to come back to it. */
export interface WholeGoal {
  picture: GoalPicture;
  mask: Mask;
  info: GoalInfo | null;
  treeHeight: number;
  source: Source | null;
}

export function wholeGoal(): WholeGoal | null {
  const shown = picture.peek();
  if (!shown) return null;
  return {
    picture: shown,
    mask: masks.peek(),
    info: info.peek(),
    treeHeight: treeHeight.peek(),
    source,
  };
}

/** The goal becomes this one, at once: another one, or the same with another mask, which is a step to be undone. */
export function putGoal(goal: WholeGoal, isStep = false): void {
  batch(() => {
    source = goal.source;
    treeHeight.value = goal.treeHeight;
    if (isStep) masks.push(goal.mask);
    else masks.begin(goal.mask, goal.picture.width);
    info.value = goal.info;
    // What is still asked about the mask before is not about this one.
    checks++;
    picture.value = goal.picture;
    goalError.value = null;
  });
  if (!goal.info) checkGoal();
}

let nextId = 1;
let reads = 0;

/** Another goal is chosen: what is still being read or opened is dropped. Tells whether this is still the last choice. */
export function chooseGoal(): () => boolean {
  const mine = ++reads;
  reading.value = null;
  return () => mine === reads;
}

type Opened = Pick<Source, "name" | "bytes" | "target">;

interface Asked {
  mask: MaskWay;
  hints: MaskHints;
  /** Of the picture whose file it is; null for a new one, which has its own. */
  id: number | null;
  /** Of the tree, in metres; null for a usual one. */
  height: Promise<number> | number | null;
}

/** A picture that nothing was said about yet. */
const NEW: Asked = { mask: "auto", hints: {}, id: null, height: null };

/** Makes a file the goal. The last choice wins, however long each of them takes to load. */
async function read(
  name: string,
  open: () => Promise<Opened> | Opened,
  { mask, hints, id, height: asked }: Asked,
): Promise<void> {
  const mine = ++reads;
  reading.value = name;
  goalError.value = null;
  announce(`Reading ${name}`);
  try {
    const file = await open();
    // Another picture was given meanwhile.
    if (mine !== reads) return;
    const goal = await goalClient.call("goalRead", { name, bytes: file.bytes, mask, hints });
    const tall = await asked;
    if (mine !== reads) return;
    const { width, height, masked, confidence } = goal.info;
    const colored = goal.photo.length === width * height * 4 ? goal.photo : null;
    const shown: GoalPicture = {
      id: id ?? nextId++,
      name: baseName(goal.info.name || name),
      width,
      height,
      full: goal.full,
      // A silhouette is its own mask: there is nothing to see beneath it, unless it was cut out of a photograph.
      photo: colored && (masked || mask === "off" || isColored(colored, goal.ink)) ? colored : null,
      target: file.target,
      masked,
      confidence,
    };
    const before = picture.peek();
    const isStep = id !== null && before?.id === id && before.width === width && before.height === height;
    const whole = {
      picture: shown,
      // What was said of the tree is true of it however it is masked.
      mask: {
        ink: goal.ink,
        ground: null,
        axis: null,
        painted: false,
        strokes: [],
        reading: mine,
        corrections: id === null ? {} : corrections.peek(),
      },
      info: goal.info,
      // What was said of another tree does not hold for this one.
      treeHeight: tall ?? (id === null ? USUAL_HEIGHT : treeHeight.peek()),
      source: { ...file, colored, asRead: { reading: mine, info: goal.info }, hints },
    };
    putGoal(whole, isStep);
    announce(`${name} is the goal`);
  } catch (error) {
    // The goal before stays as it is.
    if (mine === reads) goalError.value = sentence(error);
  } finally {
    if (mine === reads) reading.value = null;
  }
}

export async function takePicture(file: File): Promise<void> {
  if (file.size > MAX_FILE) {
    goalError.value = `${file.name} has ${Math.round(file.size / 1e6)} MB: a picture of at most 150 MB is needed.`;
    return;
  }
  const { name } = file;
  const open = async () => {
    const bytes = isSvg(file) ? await paintSvg(file) : new Uint8Array(await file.arrayBuffer());
    return { name, bytes, target: null };
  };
  await read(name, open, NEW);
}

/** Reads the same picture again, as a photograph or as a drawing. */
export async function readAgain(mask: MaskWay, hints: MaskHints = {}): Promise<void> {
  const shown = picture.peek();
  const file = source;
  if (file && shown) await read(file.name, () => file, { mask, hints, id: shown.id, height: null });
}

/** Finds the tree in a box, in pixels of the goal. */
export async function readInBox([left, top, width, height]: [number, number, number, number]): Promise<void> {
  const shown = picture.peek();
  if (!shown) return;
  const larger = shown.full.width / shown.width;
  const scaled = (pixels: number) => Math.round(pixels * larger);
  await readAgain("photo", { box: [scaled(left), scaled(top), scaled(width), scaled(height)] });
}

/** Finds the tree by what was painted: strokes that add are on it, the others are not. */
export async function readByStrokes(): Promise<void> {
  const shown = picture.peek();
  if (!shown) return;
  const before = source?.hints ?? {};
  const shownBy = (value: 0 | 1) => places(masks.peek().strokes, value, shown);
  const include = [...(before.include ?? []), ...shownBy(1)];
  const exclude = [...(before.exclude ?? []), ...shownBy(0)];
  await readAgain("photo", { ...before, include, exclude });
}

export const canReadAgain = () => source !== null;

async function targetFile(file: string): Promise<Opened> {
  const response = await fetch(new URL(`targets/${file}`, document.baseURI));
  if (!response.ok)
    throw new Error(`${file} could not be loaded: ${response.status} ${response.statusText}.`);
  return { name: file, bytes: new Uint8Array(await response.arrayBuffer()), target: file };
}

/** A picture that the page brings, with the height of its tree if that is known. */
export async function takeTarget(file: string, height: number | null = null): Promise<void> {
  await read(file, () => targetFile(file), { ...NEW, height: height ?? usualHeight(baseName(file)) });
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

/** The picture in colour; a worker gets a copy of it. */
export const photoPixels = () => source?.colored ?? null;

/** A changed mask: the library reads it at once. */
export function setMask(part: Partial<Pick<Mask, "ink" | "strokes" | "ground" | "axis">>, key = ""): void {
  const before = masks.peek();
  masks.push({ ...before, ...part, painted: before.painted || part.ink !== undefined }, key);
  checkGoal();
}

/** What is otherwise in the picture than it is read; measures that are left out are as they are. */
export function correct(part: Corrections, key = ""): void {
  const before = masks.peek();
  const colors = { ...before.corrections.colors, ...part.colors };
  const said = Object.keys(colors).length > 0 ? { ...part, colors } : part;
  masks.push({ ...before, corrections: { ...before.corrections, ...said } }, key);
}

export function asRead(): void {
  masks.push({ ...masks.peek(), corrections: {} });
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
  const { painted, reading: of } = masks.peek();
  const first = source?.asRead;
  if (first?.reading === of && !painted && pixels.ground === null && pixels.axis === null) {
    info.value = first.info;
    goalError.value = null;
    return;
  }
  goalClient
    .call("goalCheck", pixels)
    .then((found) => {
      if (mine !== checks) return;
      info.value = found;
      goalError.value = null;
    })
    .catch((error: unknown) => {
      if (mine === checks) goalError.value = sentence(error);
    });
}

/** A goal that was stored: its file is not. */
export function restoreGoal(stored: Omit<GoalPicture, "id" | "photo">, mask: Mask, height: number): void {
  const shown = { ...stored, id: nextId++, photo: null };
  putGoal({ picture: shown, mask, info: null, treeHeight: height, source: null });
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
