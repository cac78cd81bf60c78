// The options of a small GLB file, of which only the pictures of bark and leaves are wanted.
import type { ExportOptions } from "./protocol";

/** The coarsest level has the fewest cards. Leaves of all forms have one sheet of this side, in pixels. */
const SMALL: ExportOptions = { leaves: "cards", textures: 512, lod: 6, level: 5 };

export const picturesOnly = (season: string): ExportOptions => ({ ...SMALL, season: season || null });
