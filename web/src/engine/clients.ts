// The workers of the rooms. Each starts with its first call.
import { Client } from "./client";

/** Opens species, changes their values, writes them. */
export const speciesClient = new Client("the species room");
/** Grows the tree of the species room, apart from the above: meshes take longer than values, and may be given up. */
export const treeClient = new Client("the tree");
/** Writes files, which must not be given up with a tree. */
export const fileClient = new Client("the file");
/** Writes several trees into one file. */
export const zipClient = new Client("the zip");
export const goalClient = new Client("the goal");
export const mapClient = new Client("the map");
