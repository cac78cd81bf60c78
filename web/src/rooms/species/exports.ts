// Downloads of the species room. Every file is written by the library.
import { treeClient } from "../../engine/clients";
import type { Ops } from "../../engine/protocol";
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
  const input = { spec: spec.peek(), seed, season, leaves: leaves.peek(), levels, wind };
  const bytes = await saveMesh(fileName(`${speciesName.peek()}-${seed}`, format), format, input);
  announce(`${format.toUpperCase()} is written: ${Math.ceil(bytes / 1024)} KiB`);
}

/** The length of the file. */
export async function saveMesh(
  name: string,
  format: string,
  input: Omit<Ops["export"]["in"], "format">,
): Promise<number> {
  const bytes = await treeClient.call("export", { ...input, format });
  download(name, bytes, TYPES[format]);
  if (format !== "obj") return bytes.length;
  // The file of materials must have the name that the first lines of the mesh give it.
  const head = new TextDecoder().decode(bytes.subarray(0, 2000));
  const materials = /^mtllib (.+)$/m.exec(head)?.[1]?.trim();
  if (materials)
    download(materials, await treeClient.call("export", { ...input, format: "mtl" }), "model/mtl");
  return bytes.length;
}

export async function exportView(): Promise<void> {
  const picture = await view()?.snapshot();
  if (!picture) throw new Error("The view is not ready yet.");
  download(fileName(`${speciesName.peek()}-${recipes.peek().seed}-level-${level.peek()}`, "png"), picture);
}
