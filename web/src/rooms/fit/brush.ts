// Strokes on a mask.

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

/** Joined with any area it is that one. */
export const NOTHING: Area = { left: Infinity, top: Infinity, right: 0, bottom: 0 };

export const joined = (one: Area, other: Area): Area => ({
  left: Math.min(one.left, other.left),
  top: Math.min(one.top, other.top),
  right: Math.max(one.right, other.right),
  bottom: Math.max(one.bottom, other.bottom),
});

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
