// What a GLB file costs, without the graphics card.
import { Glb } from "../engine/glb";

/** The triangles of all meshes in a file of the library: each has indices. */
export function trianglesIn(file: Uint8Array<ArrayBuffer>): number {
  const { contents, primitives } = new Glb(file);
  const indices = primitives.map((part) => part.indices ?? -1);
  return indices.reduce((sum, at) => sum + (contents.accessors?.[at]?.count ?? 0) / 3, 0);
}

const number = new Intl.NumberFormat("en");

export const megabytes = (bytes: number) => `${(bytes / 1e6).toFixed(1)} MB`;

/** "49,998 triangles, 8.4 MB". */
export const cost = (triangles: number, bytes: number) =>
  `${number.format(triangles)} triangles, ${megabytes(bytes)}`;
