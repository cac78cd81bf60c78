// Strokes of the brush as hints for the library, which takes points of the picture's file.
import type { Stroke } from "./mask-history";

/** The library takes a point for a disc with this part of the picture's longer side as its radius. */
const RADIUS = 1 / 200;

interface Sides {
  width: number;
  height: number;
  full: { width: number; height: number };
}

/** Points along the strokes with this value, close enough for their discs to meet. */
export function places(
  strokes: readonly Stroke[],
  value: 0 | 1,
  { width, height, full }: Sides,
): [number, number][] {
  const larger = full.width / width;
  const apart = RADIUS * Math.max(width, height);
  const clamp = (at: number, side: number) => Math.min(side - 1, Math.max(0, Math.round(at)));
  const all = new Map<string, [number, number]>();
  for (const { points } of strokes.filter((stroke) => stroke.value === value)) {
    points.forEach((to, at) => {
      const from = points[Math.max(0, at - 1)] ?? to;
      const steps = Math.max(1, Math.ceil(Math.hypot(to.x - from.x, to.y - from.y) / apart));
      for (let step = at === 0 ? steps : 1; step <= steps; step++) {
        const x = clamp((from.x + ((to.x - from.x) * step) / steps) * larger, full.width);
        const y = clamp((from.y + ((to.y - from.y) * step) / steps) * larger, full.height);
        all.set(`${x} ${y}`, [x, y]);
      }
    });
  }
  return [...all.values()];
}
