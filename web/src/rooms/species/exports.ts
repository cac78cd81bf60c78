// Downloads of the species room. Every file is written by the library.
import { treeClient } from "../../engine/clients";
import { announce } from "../../state/notes";
import { recipes, spec, speciesName, toToml } from "../../state/species";
import { download, fileName } from "../../ui/files";
import { leaves, level } from "./tree-state";
import { view } from "./view-handle";

export const FORMATS = [
  { format: "glb", label: "GLB", what: "glTF, for engines and Blender" },
  { format: "obj", label: "OBJ", what: "Wavefront" },
  { format: "ply", label: "PLY", what: "one mesh with colours" },
  { format: "stl", label: "STL", what: "shape alone" },
  { format: "usda", label: "USDA", what: "USD as text" },
] as const;

const TYPES: Record<string, string> = {
  glb: "model/gltf-binary",
  obj: "model/obj",
  stl: "model/stl",
  usda: "text/plain",
};

export async function exportToml(): Promise<void> {
  download(fileName(speciesName.peek(), "toml"), await toToml(), "application/toml");
}

/** Levels above 1 put levels of detail into a GLB. */
export async function exportMesh(format: string, levels: number, wind: boolean): Promise<void> {
  const { seed, season } = recipes.peek();
  announce(`Writing ${format.toUpperCase()}`);
  const input = { spec: spec.peek(), seed, format, season, leaves: leaves.peek(), levels, wind };
  const bytes = await treeClient.call("export", input);
  download(fileName(`${speciesName.peek()}-${seed}`, format), bytes, TYPES[format]);
  announce(`${format.toUpperCase()} is written: ${Math.ceil(bytes.length / 1024)} KiB`);
}

export async function exportView(): Promise<void> {
  const picture = await view()?.snapshot();
  if (!picture) throw new Error("The view is not ready yet.");
  download(fileName(`${speciesName.peek()}-${recipes.peek().seed}-level-${level.peek()}`, "png"), picture);
}
