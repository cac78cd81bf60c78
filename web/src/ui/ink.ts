// Silhouettes on canvases.

export type Rgb = readonly [number, number, number];

/** Every kind of colour vision tells blue from orange; what both have is dark. */
export const GOAL_ONLY: Rgb = [46, 110, 212];
export const TREE_ONLY: Rgb = [232, 126, 28];
export const BOTH: Rgb = [30, 38, 42];
/** Wood and leaves of a goal: apart for every kind of colour vision too. */
export const WOOD: Rgb = [198, 84, 0];
export const LEAVES: Rgb = [0, 158, 115];

/** Ink in one colour on nothing. */
export function inkImage(ink: Uint8Array, width: number, height: number, color: Rgb): ImageData {
  const image = new ImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const paint = word(color);
  for (let at = 0; at < ink.length; at++) if (ink[at]) pixels[at] = paint;
  return image;
}

/** Goal and tree over each other. */
export function overlayImage(goal: Uint8Array, tree: Uint8Array, width: number, height: number): ImageData {
  const image = new ImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const words = [0, word(GOAL_ONLY), word(TREE_ONLY), word(BOTH)];
  for (let at = 0; at < goal.length; at++) {
    const both = (goal[at] ? 1 : 0) | (tree[at] ? 2 : 0);
    if (both) pixels[at] = words[both] ?? 0;
  }
  return image;
}

/** RGBA bytes as the little-endian word that ImageData holds. */
function word([red, green, blue]: Rgb): number {
  return (0xff000000 | (blue << 16) | (green << 8) | red) >>> 0;
}

/** The colour of a style variable such as `--ink`, as `#rrggbb`. */
export function styleColor(name: string): Rgb {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const value = Number.parseInt(text.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

/** Puts an image on a canvas of the image's size. */
export function show(canvas: HTMLCanvasElement, image: ImageData): void {
  if (canvas.width !== image.width) canvas.width = image.width;
  if (canvas.height !== image.height) canvas.height = image.height;
  canvas.getContext("2d")?.putImageData(image, 0, 0);
}
