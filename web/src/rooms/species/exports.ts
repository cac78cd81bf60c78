// Downloads of the species room. Every file is written by the library.
import { fileClient } from "../../engine/clients";
import { Glb } from "../../engine/glb";
import type { ExportOptions, MeshFormat, NamedFile, Ops } from "../../engine/protocol";
import { announce, say } from "../../state/notes";
import { recipes, spec, speciesName, toToml } from "../../state/species";
import { cost } from "../../ui/cost";
import { baseName, download, fileName } from "../../ui/files";
import { view } from "../../view3d/handle";
import { leaves, leavesAt, level, mesh } from "./tree-state";

export const FORMATS = [
  { format: "glb", label: "GLB", what: "glTF, for engines and Blender" },
  { format: "obj", label: "OBJ", what: "Wavefront" },
  { format: "ply", label: "PLY", what: "one mesh with colours" },
  { format: "stl", label: "STL", what: "shape alone" },
  { format: "usda", label: "USDA", what: "USD as text" },
] as const;

/** Of what the rooms ask for, what a format can hold: data for shaders, pictures, several meshes for levels and collision. */
const HOLDS: Record<MeshFormat, { data: boolean; pictures: boolean; meshes: boolean }> = {
  glb: { data: true, pictures: true, meshes: true },
  obj: { data: false, pictures: true, meshes: false },
  ply: { data: true, pictures: false, meshes: false },
  stl: { data: false, pictures: false, meshes: false },
  usda: { data: false, pictures: true, meshes: false },
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
  { id: "view", label: "As the view shows it: its level and leaves", triangles: [], billboard: 0 },
  { id: "whole", label: "Every leaf and twig: may be large", triangles: [], billboard: 0 },
] as const;
export type Budget = (typeof BUDGETS)[number];

/** Pixels per side of the pictures of bark and leaves, 0 for none; the usual ones first. */
export const TEXTURES = [1024, 512, 2048, 0] as const;
export type Textures = (typeof TEXTURES)[number];

/** What shaders are to do with a tree, by the numbers at its vertices. */
export const SHADERS = [
  { id: "wind", label: "Wind" },
  { id: "growth", label: "Growth" },
  { id: "none", label: "None" },
] as const;
export type Shaders = (typeof SHADERS)[number]["id"];

/** What is chosen for files, besides what the view shows. */
export interface Asked {
  readonly budget: Budget;
  readonly textures: Textures;
  readonly shaders: Shaders;
  readonly collision: boolean;
}

/** One of the levels of fixed coarseness, of which a view shows one. */
const atLevel = (level: number) => ({ lod: level + 1, level });

/** The options of a file of this format; what it cannot hold is left out. `shown` is the level of the view. */
export function optionsFor(
  format: MeshFormat,
  budget: Budget,
  asked: ExportOptions,
  shown = 0,
): ExportOptions {
  const held = HOLDS[format];
  const options: ExportOptions = {
    ...asked,
    wind: Boolean(asked.wind) && held.data,
    growth: Boolean(asked.growth) && held.data,
    collision: Boolean(asked.collision) && held.meshes,
  };
  if (!held.pictures) {
    // Cards without their picture would be plain squares.
    if (asked.leaves === "cards") options.leaves = "simple";
    delete options.textures;
    return { ...options, ...atLevel(shown) };
  }
  const { id, triangles, billboard } = budget;
  options.textures = asked.textures ?? TEXTURES[0];
  if (id === "view") return { ...options, ...atLevel(shown) };
  if (id === "whole") return { ...options, finest: true };
  // How leaves are drawn follows from the budget.
  if (options.leaves !== "none") delete options.leaves;
  // The library's own choice for a GLB, which also takes trees that do not fit into it.
  if (id === "near" && format === "glb") return options;
  options.triangles = held.meshes ? triangles : triangles.slice(0, 1);
  if (held.meshes) options.billboard = billboard;
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

/** What the species room asks of a file. */
export function optionsNow(
  format: MeshFormat,
  { budget, shaders, textures, collision }: Asked,
): ExportOptions {
  // The view may show a coarser level than it was asked for.
  const shown = Math.max(level.value, mesh.value?.data.level ?? 0);
  const asked = {
    leaves: leavesAt(leaves.value, shown),
    season: recipes.value.season || null,
    wind: shaders === "wind",
    growth: shaders === "growth",
    textures,
    collision,
  };
  return optionsFor(format, budget, asked, shown);
}

export async function exportMesh(format: MeshFormat, asked: Asked): Promise<void> {
  const { seed } = recipes.peek();
  announce(`Writing ${format.toUpperCase()}`);
  const options = optionsNow(format, asked);
  const name = fileName(`${speciesName.peek()}-${seed}`, format);
  const files = await saveMesh(name, { spec: spec.peek(), seed, format, options });
  say(`${name} is written: ${sizeOf(files)}.`);
}

/** Saves a mesh as `name`, and the files that it names. */
export async function saveMesh(
  name: string,
  input: Omit<Ops["export"]["in"], "stem">,
): Promise<readonly NamedFile[]> {
  const { files, note } = await fileClient.call("export", { ...input, stem: baseName(name) });
  if (note) say(note);
  for (const file of files) download(file.name, file.bytes, TYPES[file.name.split(".").at(-1) ?? ""]);
  return files;
}

/** What a mesh costs those who use it: triangles, where that is a look into the file, and megabytes of all files. */
export function sizeOf(files: readonly NamedFile[]): string {
  const bytes = files.reduce((sum, file) => sum + file.bytes.length, 0);
  const [mesh] = files;
  return cost(mesh?.name.endsWith(".glb") ? new Glb(mesh.bytes).triangles : null, bytes);
}

export async function exportView(): Promise<void> {
  const picture = await view()?.snapshot();
  if (!picture) throw new Error("The view is not ready yet.");
  download(fileName(`${speciesName.peek()}-${recipes.peek().seed}-level-${level.peek()}`, "png"), picture);
}
