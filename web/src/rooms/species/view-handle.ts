// The one view in three dimensions, for those who need its picture.
import type { TreeView } from "../../view3d/tree-view";

let current: TreeView | null = null;

export const view = () => current;

/** Null when the room closes: what the graphics card holds is released. */
export function setView(next: TreeView | null): void {
  current?.dispose();
  current = next;
}
