// Large pictures made smaller, in a worker.

export interface Side {
  readonly width: number;
  readonly height: number;
}

/** The same proportions with a longer side of at most `longest`. */
export function within({ width, height }: Side, longest: number): Side {
  const factor = Math.min(1, longest / Math.max(width, height));
  return {
    width: Math.max(1, Math.round(width * factor)),
    height: Math.max(1, Math.round(height * factor)),
  };
}

/** Calls `use` for each place of the smaller picture with the columns and rows that it stands for. */
function fields(
  from: Side,
  to: Side,
  use: (at: number, left: number, right: number, top: number, bottom: number) => void,
): void {
  for (let y = 0; y < to.height; y++) {
    const top = Math.floor((y * from.height) / to.height);
    const bottom = Math.max(top + 1, Math.floor(((y + 1) * from.height) / to.height));
    for (let x = 0; x < to.width; x++) {
      const left = Math.floor((x * from.width) / to.width);
      const right = Math.max(left + 1, Math.floor(((x + 1) * from.width) / to.width));
      use(y * to.width + x, left, right, top, bottom);
    }
  }
}

/** Ink where at least half of what a pixel stands for is ink. */
export function smallerInk(ink: Uint8Array, from: Side, to: Side): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(to.width * to.height);
  fields(from, to, (at, left, right, top, bottom) => {
    let sum = 0;
    for (let row = top; row < bottom; row++) {
      for (let column = left; column < right; column++) sum += ink[row * from.width + column] ?? 0;
    }
    if (2 * sum >= (right - left) * (bottom - top)) out[at] = 1;
  });
  return out;
}

/** The middle of what a pixel stands for: enough for a backdrop and for its colours. */
export function smallerPhoto(rgba: Uint8Array, from: Side, to: Side): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(4 * to.width * to.height);
  fields(from, to, (at, left, right, top, bottom) => {
    const middle = 4 * (((top + bottom) >> 1) * from.width + ((left + right) >> 1));
    out.set(rgba.subarray(middle, middle + 4), 4 * at);
  });
  return out;
}

/** The colours of a picture's file, decoded by the browser; null if it cannot, or sees another size in it. */
export async function decoded(
  bytes: Uint8Array,
  full: Side,
  to: Side,
): Promise<Uint8Array<ArrayBuffer> | null> {
  try {
    const whole = await createImageBitmap(new Blob([bytes.slice()]));
    const same = whole.width === full.width && whole.height === full.height;
    const context = new OffscreenCanvas(to.width, to.height).getContext("2d");
    if (same && context) {
      context.imageSmoothingQuality = "high";
      context.drawImage(whole, 0, 0, to.width, to.height);
    }
    whole.close();
    if (!same || !context) return null;
    return new Uint8Array(context.getImageData(0, 0, to.width, to.height).data.buffer);
  } catch {
    return null;
  }
}
