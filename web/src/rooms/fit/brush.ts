// Strokes on a mask, and the mask on a canvas: only the part that has changed is drawn again.
import { GOAL_ONLY, LEAVES, type Rgb, WOOD } from "../../ui/ink";
import type { GoalPicture } from "./goal-state";

export interface Point {
  x: number;
  y: number;
}

/** First column and row, and the column and row behind the last. */
export interface Area {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export const joined = (one: Area, other: Area): Area => ({
  left: Math.min(one.left, other.left),
  top: Math.min(one.top, other.top),
  right: Math.max(one.right, other.right),
  bottom: Math.max(one.bottom, other.bottom),
});

/** The picture has so much of the colour over it, inside of the mask and outside. */
const INSIDE = 0.45;
const OUTSIDE = 0.25;
const WHITE: Rgb = [255, 255, 255];
/** The mask of a silhouette, as a word of [ImageData]. */
const DARK = 0xff2a261e;

/** Red, green and blue take so many numbers. */
const VALUES = 256;

/**
 * What a pixel of a photograph becomes, as it lies in a word of [ImageData]: by its kind, its channel and its value. Kinds
 * are outside of the mask, and inside by the number of the layer: blue where that is not known.
 */
const MIXED = new Uint32Array(
  [[WHITE, OUTSIDE] as const, ...[GOAL_ONLY, WOOD, LEAVES].map((over) => [over, INSIDE] as const)].flatMap(
    ([over, share]) =>
      over.flatMap((tint, channel) =>
        Array.from({ length: VALUES }, (_, value) => {
          const mixed = Math.round(value * (1 - share) + tint * share);
          return (mixed << (8 * channel)) >>> 0;
        }),
      ),
  ),
);

interface Painted {
  ink: Uint8Array;
  /** One byte per pixel, 1 for wood and 2 for leaves. */
  layers: Uint8Array | null;
}

/** The photograph, pale, under its mask in colours; or the mask alone, dark. A million pixels take some milliseconds. */
export function paint(
  canvas: HTMLCanvasElement,
  shown: GoalPicture,
  { ink, layers }: Painted,
  area?: Area,
): void {
  const { width, height, photo } = shown;
  if (ink.length !== width * height) return;
  const kinds = layers?.length === ink.length ? layers : null;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const { left, top, right, bottom } = area ?? { left: 0, top: 0, right: width, bottom: height };
  if (right <= left || bottom <= top) return;
  const image = new ImageData(right - left, bottom - top);
  const words = new Uint32Array(image.data.buffer);
  for (let row = top; row < bottom; row++) {
    const from = row * width + left;
    const to = (row - top) * (right - left);
    if (photo) mixRow(words, to, photo, ink, kinds, from, right - left);
    else for (let at = 0; at < right - left; at++) if (ink[from + at]) words[to + at] = DARK;
  }
  canvas.getContext("2d")?.putImageData(image, left, top);
}

/** A row on its own is compiled by the browser before the first picture is done. */
function mixRow(
  words: Uint32Array,
  to: number,
  photo: Uint8Array,
  ink: Uint8Array,
  kinds: Uint8Array | null,
  from: number,
  count: number,
): void {
  const layers = kinds ?? ink;
  const isLayered = kinds ? 1 : 0;
  for (let at = 0; at < count; at++) {
    const pixel = from + at;
    const kind = ink[pixel] === 0 ? 0 : 1 + isLayered * (layers[pixel] ?? 0);
    const table = 3 * VALUES * kind;
    // What is clear has a colour too, which nobody is meant to see: it is paper.
    const paper = (photo[4 * pixel + 3] ?? 0) < 128 ? 255 : 0;
    const red = MIXED[table + ((photo[4 * pixel] ?? 0) | paper)] ?? 0;
    const green = MIXED[table + VALUES + ((photo[4 * pixel + 1] ?? 0) | paper)] ?? 0;
    const blue = MIXED[table + 2 * VALUES + ((photo[4 * pixel + 2] ?? 0) | paper)] ?? 0;
    words[to + at] = red | green | blue | 0xff000000;
  }
}

/** A round brush from one point to another, of this radius in pixels. The area that it has touched. */
export function stroke(
  ink: Uint8Array,
  { width, height }: { width: number; height: number },
  [from, to]: readonly [Point, Point],
  radius: number,
  value: number,
): Area {
  const steps = Math.max(1, Math.ceil(Math.hypot(to.x - from.x, to.y - from.y) / Math.max(1, radius / 2)));
  for (let step = 0; step <= steps; step++) {
    const x = from.x + ((to.x - from.x) * step) / steps;
    const y = from.y + ((to.y - from.y) * step) / steps;
    for (let row = Math.max(0, Math.floor(y - radius)); row <= Math.min(height - 1, y + radius); row++) {
      const half = Math.sqrt(Math.max(0, radius * radius - (row - y) * (row - y)));
      const first = Math.max(0, Math.round(x - half));
      const last = Math.min(width - 1, Math.round(x + half));
      if (last >= first) ink.fill(value, row * width + first, row * width + last + 1);
    }
  }
  const clamp = (at: number, side: number) => Math.min(side, Math.max(0, at));
  return {
    left: clamp(Math.floor(Math.min(from.x, to.x) - radius), width),
    top: clamp(Math.floor(Math.min(from.y, to.y) - radius), height),
    right: clamp(Math.ceil(Math.max(from.x, to.x) + radius) + 1, width),
    bottom: clamp(Math.ceil(Math.max(from.y, to.y) + radius) + 1, height),
  };
}
