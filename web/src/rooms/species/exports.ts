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

/** Of what the room asks for, what a format can hold. */
const HOLDS: Record<MeshFormat, { wind: boolean; cards: boolean }> = {
  glb: { wind: true, cards: true },
  obj: { wind: false, cards: true },
  ply: { wind: true, cards: false },
  stl: { wind: false, cards: false },
  usda: { wind: false, cards: true },
};

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

/** Levels above 1 put levels of detail into a GLB. */
export async function exportMesh(format: MeshFormat, levels: number, wind: boolean): Promise<void> {
  const { seed, season } = recipes.peek();
  announce(`Writing ${format.toUpperCase()}`);
  const held = HOLDS[format];
  const options: ExportOptions = {
    lod: levels,
    // Cards without their picture would be plain squares.
    leaves: leaves.peek() === "cards" && !held.cards ? "simple" : leaves.peek(),
    season: season || null,
    wind: wind && held.wind,
  };
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
