// The best tree of a search that runs: one shape takes the place of another, with the same materials, so that no shader is
// made again. Bark and leaves are those of a GLB file of such a tree.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  type Material,
  Mesh,
  MeshStandardMaterial,
  Sphere,
  SRGBColorSpace,
  Vector3,
} from "three";
import type { MeshPart, PicturedMesh } from "../engine/protocol";

/** What a part of a tree has that is not in the file. */
function plain({ color, double_sided, material: name }: MeshPart): Material {
  const material = new MeshStandardMaterial({ roughness: 0.8, name });
  material.color.setRGB(...color, SRGBColorSpace);
  if (double_sided) material.side = DoubleSide;
  return material;
}

export class GrowingTree {
  readonly mesh = new Mesh<BufferGeometry, Material[]>(new BufferGeometry(), []);

  constructor(private readonly materials: Map<string, Material>) {
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
  }

  put(data: PicturedMesh): Box3 {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(data.positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(data.normals, 3));
    geometry.setAttribute("uv", new BufferAttribute(data.uv, 2));
    geometry.setIndex(new BufferAttribute(data.indices, 1));
    const box = new Box3(new Vector3(...data.low), new Vector3(...data.high));
    geometry.boundingBox = box;
    geometry.boundingSphere = box.getBoundingSphere(new Sphere());
    data.parts.forEach((part, at) => {
      geometry.addGroup(part.first, part.count, at);
    });
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
    this.mesh.material = data.parts.map((part) => this.material(part));
    return box;
  }

  /** All materials are released with the mesh: those that it does not show now as well. */
  get all(): readonly Material[] {
    return [...this.materials.values()];
  }

  private material(part: MeshPart): Material {
    const known = this.materials.get(part.material) ?? plain(part);
    this.materials.set(part.material, known);
    return known;
  }
}
