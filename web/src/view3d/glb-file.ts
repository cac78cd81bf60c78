// A GLB file of the library with its materials, and what is to be released of it.
import { type Group, type Material, Mesh, type Object3D, Texture, type WebGLRenderer } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { prepare } from "./foliage";
import { releaseTexture, texturesFromBytes } from "./textures";

/** Samples of a picture that is seen from the side. */
const SHARP = 8;

/** The materials of a loaded file, by name. */
export function materialsOf(root: Object3D): Map<string, Material> {
  const found = new Map<string, Material>();
  root.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    for (const material of [node.material].flat()) found.set(material.name, material);
  });
  return found;
}

export async function loadGlb(glb: ArrayBuffer, { capabilities }: WebGLRenderer): Promise<Group> {
  const { scene } = await new GLTFLoader().register(texturesFromBytes).parseAsync(glb, "");
  const sharp = Math.min(SHARP, capabilities.getMaxAnisotropy());
  for (const material of materialsOf(scene).values()) prepare(material, sharp);
  return scene;
}

/** Pictures are not released with the material that uses them. */
export function releaseMaterial(material: Material): void {
  for (const value of Object.values(material)) {
    if (value instanceof Texture) releaseTexture(value);
  }
  material.dispose();
}

/** Materials are not released with the scene that uses them. */
export function release(root: Object3D): void {
  root.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    node.geometry.dispose();
    for (const material of [node.material].flat()) releaseMaterial(material);
    node.customDepthMaterial?.dispose();
  });
}
