// Whether a picture has colours, so that there is more to see in it than its silhouette.

/** Differences between the channels that a person sees, of 255. */
const SEEN = 24;
/** The part of the tree that has to be so. */
const PART = 0.05;
/** Pixels that are looked at, spread over the picture. */
const PLACES = 20_000;

/** `photo` has four bytes for each pixel of `ink`. */
export function isColored(photo: Uint8Array, ink: Uint8Array): boolean {
  // An odd step does not run along the columns of most pictures.
  const step = Math.max(1, Math.floor(ink.length / PLACES)) | 1;
  let looked = 0;
  let colored = 0;
  for (let pixel = 0; pixel < ink.length; pixel += step) {
    if (!ink[pixel]) continue;
    const [red = 0, green = 0, blue = 0] = photo.subarray(4 * pixel, 4 * pixel + 3);
    looked++;
    if (Math.max(red, green, blue) - Math.min(red, green, blue) >= SEEN) colored++;
  }
  return colored > PART * looked;
}
