// Undo and redo of a mask. A step holds which pixels of a rectangle it turned over, one bit for each, and not the whole
// mask: hundreds of strokes on a large picture fit into a few megabytes. What is said of the picture goes with it.
import type { Corrections } from "../../engine/protocol";
import { packBits, unpackBits } from "../../state/codec";
import { Steps } from "../../state/history";

/** What undo goes back to: the mask, the lines, and what was said of the picture. */
export interface Mask extends Said {
  readonly ink: Uint8Array<ArrayBuffer>;
}

interface Said {
  /** Null where the library finds the line. */
  readonly ground: number | null;
  readonly axis: number | null;
  /** Whether the ink is otherwise than it was read. */
  readonly painted: boolean;
  /** Since it was read. */
  readonly strokes: readonly Stroke[];
  /** The number of the reading that it comes from. */
  readonly reading: number;
  /** What is otherwise in the picture than it is read. */
  readonly corrections: Corrections;
}

/** The way of a brush, in pixels of the mask. */
export interface Stroke {
  readonly value: 0 | 1;
  readonly points: readonly { x: number; y: number }[];
}

interface Rectangle {
  left: number;
  top: number;
  width: number;
  height: number;
}

interface Step {
  /** Null if no pixel was. */
  turned: { where: Rectangle; bits: Uint8Array } | null;
  before: Said;
  after: Said;
}

const saidOf = ({ ground, axis, painted, strokes, reading, corrections }: Said): Said => ({
  ground,
  axis,
  painted,
  strokes,
  reading,
  corrections,
});

/** The smallest rectangle around all pixels that differ. */
function changed(before: Uint8Array, after: Uint8Array, width: number): Rectangle | null {
  const differs = (at: number) => before[at] !== after[at];
  const last = before.length;
  let first = 0;
  while (first < last && !differs(first)) first++;
  if (first === last) return null;
  let end = last - 1;
  while (!differs(end)) end--;
  const [top, bottom] = [Math.floor(first / width), Math.floor(end / width)];
  let [left, right] = [width - 1, 0];
  for (let row = top; row <= bottom; row++) {
    const start = row * width;
    for (let column = 0; column < left; column++) if (differs(start + column)) left = column;
    for (let column = width - 1; column > right; column--) if (differs(start + column)) right = column;
  }
  right = Math.max(left, right);
  return { left, top, width: right - left + 1, height: bottom - top + 1 };
}

/** `use` is called for each pixel of a rectangle: its place in the picture, and in the rectangle. */
function each(
  { left, top, width, height }: Rectangle,
  across: number,
  use: (at: number, inside: number) => void,
): void {
  for (let row = 0; row < height; row++) {
    const start = (top + row) * across + left;
    for (let column = 0; column < width; column++) use(start + column, row * width + column);
  }
}

const NOTHING: Mask = {
  ink: new Uint8Array(0),
  ground: null,
  axis: null,
  painted: false,
  strokes: [],
  reading: 0,
  corrections: {},
};

export class MaskHistory extends Steps<Mask, Step> {
  /** Pixels of a row. */
  private across = 1;

  constructor() {
    super(NOTHING);
  }

  /** A mask of a picture of this width, without a step back. The masks that follow have the same size. */
  begin(mask: Mask, width: number): void {
    this.across = width;
    this.reset(mask);
  }

  protected override between(before: Mask, after: Mask): Step {
    return { turned: this.difference(before, after), before: saidOf(before), after: saidOf(after) };
  }

  protected override back(now: Mask, step: Step): Mask {
    return { ...step.before, ink: this.turn(now, step) };
  }

  protected override forward(now: Mask, step: Step): Mask {
    return { ...step.after, ink: this.turn(now, step) };
  }

  /** A line or a measure that is dragged on. Each stroke is a step of its own. */
  protected override joined(one: Step, { turned, after }: Step): Step | null {
    return turned ? null : { ...one, after };
  }

  protected override size({ turned }: Step): number {
    return turned?.bits.length ?? 0;
  }

  private difference(before: Mask, after: Mask): Step["turned"] {
    if (before.ink === after.ink) return null;
    const where = changed(before.ink, after.ink, this.across);
    if (!where) return null;
    const differing = new Uint8Array(where.width * where.height);
    each(where, this.across, (at, inside) => {
      differing[inside] = before.ink[at] === after.ink[at] ? 0 : 1;
    });
    return { where, bits: packBits(differing) };
  }

  /** The same step leads there and back. */
  private turn({ ink }: Mask, { turned }: Step): Uint8Array<ArrayBuffer> {
    if (!turned) return ink;
    const { where, bits } = turned;
    const other = ink.slice();
    const turns = unpackBits(bits, where.width * where.height);
    each(where, this.across, (at, inside) => {
      if (turns[inside]) other[at] = ink[at] ? 0 : 1;
    });
    return other;
  }
}
