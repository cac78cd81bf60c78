// The mask on a canvas: only the part that has changed is drawn again, and never so much at once that the page stalls.
import { GOAL_ONLY, LEAVES, type Rgb, WOOD } from "../../ui/ink";
import { type Area, joined, NOTHING } from "./brush";
import type { GoalPicture } from "./goal-state";

/** The picture has so much of the colour over it, inside of the mask and outside. */
const INSIDE = 0.45;
const OUTSIDE = 0.25;
const WHITE: Rgb = [255, 255, 255];
/** The mask of a silhouette, as a word of [ImageData]. */
const DARK = 0xff2a261e;

/** In a word of [ImageData]: two channels with a gap between them, so that one multiplication does for both, and the third. */
const RED_AND_BLUE = 0x00ff00ff;
const GREEN = 0x0000ff00;

/** A colour that is mixed with those of a photograph. Shares are in 256ths, `over` is times 256, with a half to round by. */
const mix = ([red, green, blue]: Rgb, share: number) => {
  const part = Math.round(256 * share);
  return {
    own: 256 - part,
    overRedAndBlue: part * (red | (blue << 16)) + 0x00800080,
    overGreen: part * green + 0x80,
  };
};

const OUTSIDE_MIX = mix(WHITE, OUTSIDE);
/** By the number of the layer: blue where that is not known. */
const INSIDE_MIXES = [GOAL_ONLY, WOOD, LEAVES].map((over) => mix(over, INSIDE));

interface Painted {
  ink: Uint8Array;
  /** One byte per pixel, 1 for wood and 2 for leaves. */
  layers: Uint8Array | null;
}

/** Milliseconds of painting between two pictures of the screen, and rows between two looks at the clock. */
const SLICE = 10;
const ROWS = 16;

/** The photograph, pale, under its mask in colours; or the mask alone, dark. */
export class MaskCanvas {
  private latest: { canvas: HTMLCanvasElement; shown: GoalPicture; painted: Painted } | null = null;
  /** What does not show the latest yet. */
  private stale: Area = NOTHING;
  private frame = 0;

  /** Paints an area, or all. What takes longer than a slice follows with the next pictures of the screen. */
  paint(canvas: HTMLCanvasElement, shown: GoalPicture, painted: Painted, area?: Area): void {
    const { width, height } = shown;
    if (painted.ink.length !== width * height) return;
    const isOther = this.latest?.canvas !== canvas || this.latest.shown !== shown;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    const all = { left: 0, top: 0, right: width, bottom: height };
    this.latest = { canvas, shown, painted };
    this.stale = isOther || !area ? all : joined(this.stale, area);
    cancelAnimationFrame(this.frame);
    this.slice();
  }

  private readonly slice = (): void => {
    const { left, right, bottom } = this.stale;
    if (!this.latest || right <= left) return;
    const { canvas, shown, painted } = this.latest;
    const until = performance.now() + SLICE;
    let { top } = this.stale;
    while (top < bottom && performance.now() < until) {
      const end = Math.min(bottom, top + ROWS);
      paint(canvas, shown, painted, { left, top, right, bottom: end });
      top = end;
    }
    this.stale = top < bottom ? { left, top, right, bottom } : NOTHING;
    if (top < bottom) this.frame = requestAnimationFrame(this.slice);
  };
}

/** An area that is not empty. */
function paint(
  canvas: HTMLCanvasElement,
  { width, photo }: GoalPicture,
  { ink, layers }: Painted,
  { left, top, right, bottom }: Area,
): void {
  const kinds = layers?.length === ink.length ? layers : null;
  const image = new ImageData(right - left, bottom - top);
  const words = new Uint32Array(image.data.buffer);
  const photoWords = photo && new Uint32Array(photo.buffer, photo.byteOffset, photo.length >> 2);
  for (let row = top; row < bottom; row++) {
    const from = row * width + left;
    const to = (row - top) * (right - left);
    if (photoWords) mixRow(words, to, photoWords, ink, kinds, from, right - left);
    else for (let at = 0; at < right - left; at++) if (ink[from + at]) words[to + at] = DARK;
  }
  canvas.getContext("2d")?.putImageData(image, left, top);
}

/** A row on its own is compiled by the browser before the first picture is done. */
function mixRow(
  words: Uint32Array,
  to: number,
  photo: Uint32Array,
  ink: Uint8Array,
  kinds: Uint8Array | null,
  from: number,
  count: number,
): void {
  for (let at = 0; at < count; at++) {
    const pixel = from + at;
    const inside = INSIDE_MIXES[kinds?.[pixel] ?? 0] ?? OUTSIDE_MIX;
    const { own, overRedAndBlue, overGreen } = ink[pixel] ? inside : OUTSIDE_MIX;
    let word = photo[pixel] ?? 0;
    // What is clear has a colour too, which nobody is meant to see: it is paper.
    if (word >>> 31 === 0) word = 0xffffffff;
    const redAndBlue = (Math.imul(word & RED_AND_BLUE, own) + overRedAndBlue) >>> 8;
    const green = Math.imul((word & GREEN) >>> 8, own) + overGreen;
    words[to + at] = (redAndBlue & RED_AND_BLUE) | (green & GREEN) | 0xff000000;
  }
}
