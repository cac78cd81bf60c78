// Strokes on a mask, and the mask on a canvas: only the part that has changed is drawn again.
import { GOAL_ONLY } from "../../ui/ink";
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
const WHITE = [255, 255, 255] as const;
/** The mask of a silhouette. */
const DARK = [30, 38, 42] as const;

/** The photograph, pale, under its mask in blue; or the mask alone, dark. */
export function paint(canvas: HTMLCanvasElement, shown: GoalPicture, ink: Uint8Array, area?: Area): void {
  const { width, height, photo } = shown;
  if (ink.length !== width * height) return;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const { left, top, right, bottom } = area ?? { left: 0, top: 0, right: width, bottom: height };
  if (right <= left || bottom <= top) return;
  const image = new ImageData(right - left, bottom - top);
  const { data } = image;
  let to = 0;
  for (let row = top; row < bottom; row++) {
    for (let at = row * width + left; at < row * width + right; at++, to += 4) {
      const inside = ink[at] === 1;
      if (photo) {
        const [share, over] = inside ? [INSIDE, GOAL_ONLY] : [OUTSIDE, WHITE];
        data[to] = (photo[4 * at] ?? 0) * (1 - share) + over[0] * share;
        data[to + 1] = (photo[4 * at + 1] ?? 0) * (1 - share) + over[1] * share;
        data[to + 2] = (photo[4 * at + 2] ?? 0) * (1 - share) + over[2] * share;
        data[to + 3] = 255;
      } else if (inside) {
        data[to] = DARK[0];
        data[to + 1] = DARK[1];
        data[to + 2] = DARK[2];
        data[to + 3] = 255;
      }
    }
  }
  canvas.getContext("2d")?.putImageData(image, left, top);
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
