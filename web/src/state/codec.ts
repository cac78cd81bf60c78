// Text and bytes as short strings for links and localStorage: deflate, then base64url.

export function toBase64Url(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 4096) {
    text += String.fromCharCode(...bytes.subarray(at, at + 4096));
  }
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(binary, (char) => char.charCodeAt(0));
}

async function through(bytes: Uint8Array, stream: GenericTransformStream): Promise<Uint8Array<ArrayBuffer>> {
  const body = new Blob([bytes.slice()])
    .stream()
    .pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array>);
  return new Uint8Array(await new Response(body as ReadableStream).arrayBuffer());
}

export async function pack(bytes: Uint8Array): Promise<string> {
  return toBase64Url(await through(bytes, new CompressionStream("deflate-raw")));
}

export function unpack(text: string): Promise<Uint8Array<ArrayBuffer>> {
  return through(fromBase64Url(text), new DecompressionStream("deflate-raw"));
}

export const packText = (text: string) => pack(new TextEncoder().encode(text));

export const unpackText = async (text: string) => new TextDecoder().decode(await unpack(text));

/** Eight pixels per byte: a mask of 0 and 1 shrinks before it is deflated. */
export function packBits(ink: Uint8Array): Uint8Array {
  const bits = new Uint8Array(Math.ceil(ink.length / 8));
  // A plain loop: masks have more than a million pixels, and are packed while one paints.
  for (let at = 0; at < ink.length; at++) if (ink[at]) bits[at >> 3] = (bits[at >> 3] ?? 0) | (1 << (at & 7));
  return bits;
}

export function unpackBits(bits: Uint8Array, length: number): Uint8Array<ArrayBuffer> {
  const ink = new Uint8Array(length);
  for (let at = 0; at < length; at++) ink[at] = ((bits[at >> 3] ?? 0) >> (at & 7)) & 1;
  return ink;
}
