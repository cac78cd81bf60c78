// Downloads of the species room. Every file is written by the library.
import { treeClient } from "../../engine/clients";
import type { ExportOptions, MeshFormat, Ops } from "../../engine/protocol";
import { announce } from "../../state/notes";
import { recipes, spec, speciesName, toToml } from "../../state/species";
import { baseName, download, fileName } from "../../ui/files";
import { leaves, level } from "./tree-state";
import { view } from "./view-handle";

export const FORMATS = [
  { format: "glb", label: "GLB", what: "glTF, for engines and Blender" },
  { format: "obj", label: "OBJ", what: "Wavefront" },
  { format: "ply", label: "PLY", what: "one mesh with colours" },
  { format: "stl", label: "STL", what: "shape alone" },
  { format: "usda", label: "USDA", what: "USD as text" },
] as const;

/** Of what the rooms ask for, what a format can hold: wind, pictures, several levels of detail. */
const HOLDS: Record<MeshFormat, { wind: boolean; pictures: boolean; levels: boolean }> = {
  glb: { wind: true, pictures: true, levels: true },
  obj: { wind: false, pictures: true, levels: false },
  ply: { wind: true, pictures: false, levels: false },
  stl: { wind: false, pictures: false, levels: false },
  usda: { wind: false, pictures: true, levels: false },
};

/** How many triangles a file may have, level by level. */
export const BUDGETS = [
  { id: "near", label: "At most 50,000 triangles", triangles: [50_000], billboard: 0 },
  { id: "far", label: "At most 8,000 triangles", triangles: [8_000], billboard: 0 },
  {
    id: "levels",
    label: "Levels of 50,000, 8,000 and 2,000 triangles, and cards",
    triangles: [50_000, 8_000, 2_000],
    billboard: 2,
  },
  { id: "whole", label: "Every leaf and twig: may be large", triangles: [], billboard: 0 },
] as const;
export type Budget = (typeof BUDGETS)[number];

/** Pixels of a side of the bark's picture. */
const BARK = 1024;

/** The options of a file of this format; what it cannot hold is left out. */
export function optionsFor(format: MeshFormat, budget: Budget, asked: ExportOptions): ExportOptions {
  const held = HOLDS[format];
  const options: ExportOptions = { ...asked, wind: Boolean(asked.wind) && held.wind };
  if (!held.pictures) {
    // Cards without their picture would be plain squares.
    if (asked.leaves === "cards") options.leaves = "simple";
    return options;
  }
  const { triangles, billboard } = budget;
  options.textures = BARK;
  if (!triangles.length) return options;
  options.triangles = held.levels ? triangles : triangles.slice(0, 1);
  if (held.levels) options.billboard = billboard;
  // How leaves are drawn follows from the budget.
  if (options.leaves !== "none") options.leaves = "outline";
  return options;
}

const TYPES: Record<string, string> = {
  glb: "model/gltf-binary",
  mtl: "model/mtl",
  obj: "model/obj",
  png: "image/png",
  stl: "model/stl",
  usda: "text/plain",
};

export async function exportToml(): Promise<void> {
  download(fileName(speciesName.peek(), "toml"), await toToml(), "application/toml");
}

export async function exportMesh(format: MeshFormat, budget: Budget, wind: boolean): Promise<void> {
  const { seed, season } = recipes.peek();
  announce(`Writing ${format.toUpperCase()}`);
  const options = optionsFor(format, budget, { leaves: leaves.peek(), season: season || null, wind });
  const name = fileName(`${speciesName.peek()}-${seed}`, format);
  const bytes = await saveMesh(name, { spec: spec.peek(), seed, format, options });
  announce(`${format.toUpperCase()} is written: ${Math.ceil(bytes / 1024)} KiB`);
}

/** Saves a mesh as `name`, and the files that it names. The length of all in bytes. */
export async function saveMesh(name: string, input: Omit<Ops["export"]["in"], "stem">): Promise<number> {
  const files = await treeClient.call("export", { ...input, stem: baseName(name) });
  for (const file of files) download(file.name, file.bytes, TYPES[file.name.split(".").at(-1) ?? ""]);
  return files.reduce((sum, { bytes }) => sum + bytes.length, 0);
}

export async function exportView(): Promise<void> {
  const picture = await view()?.snapshot();
  if (!picture) throw new Error("The view is not ready yet.");
  download(fileName(`${speciesName.peek()}-${recipes.peek().seed}-level-${level.peek()}`, "png"), picture);
}
