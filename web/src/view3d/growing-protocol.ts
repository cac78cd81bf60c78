// What the page and the worker that draws the trees of a search say to each other.
import type { PicturedMesh } from "../engine/protocol";

/** A tree of a search, and a GLB file with the pictures that it shows. */
export interface Growing {
  readonly tree: PicturedMesh;
  readonly pictures: Uint8Array<ArrayBuffer>;
}

export type ToGrowing =
  | { readonly canvas: OffscreenCanvas }
  | { readonly width: number; readonly height: number; readonly ratio: number }
  | { readonly dark: boolean }
  /** Without `pictures`, those of the tree before. */
  | { readonly tree: PicturedMesh; readonly pictures: Growing["pictures"] | null }
  | { readonly orbit: readonly [around: number, up: number, factor: number] };

export type FromGrowing =
  /** A tree is on the screen, after so many milliseconds. */
  | { readonly took: number; readonly programs: number }
  /** Nothing can be drawn in three dimensions. */
  | { readonly failed: string };
