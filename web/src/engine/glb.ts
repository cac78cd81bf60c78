// What a GLB file of the library says of itself.

const HEADER = 20;
const LENGTH_AT = 12;
/** Between the JSON and the bytes are the length and the kind of those. */
const CHUNK_HEADER = 8;

interface View {
  byteOffset?: number;
  byteLength: number;
  byteStride?: number;
}
interface Accessor {
  count: number;
  bufferView?: number;
  byteOffset?: number;
  componentType: number;
}
interface Material {
  name?: string;
  pbrMetallicRoughness?: { baseColorTexture?: { index: number } };
}
export interface Primitive {
  indices?: number;
  material?: number;
  attributes: Record<string, number>;
}
interface Contents {
  accessors?: Accessor[];
  bufferViews?: View[];
  images?: { bufferView?: number }[];
  materials?: Material[];
  meshes?: { primitives: Primitive[] }[];
  textures?: { source: number }[];
}

const FLOATS = 5126;

export class Glb {
  readonly contents: Contents;
  private readonly bytes: Uint8Array<ArrayBuffer>;

  constructor(file: Uint8Array<ArrayBuffer>) {
    const length = new DataView(file.buffer, file.byteOffset).getUint32(LENGTH_AT, true);
    this.contents = JSON.parse(new TextDecoder().decode(file.subarray(HEADER, HEADER + length))) as Contents;
    this.bytes = file.subarray(HEADER + length + CHUNK_HEADER);
  }

  get primitives(): readonly Primitive[] {
    return (this.contents.meshes ?? []).flatMap(({ primitives }) => primitives);
  }

  /** Of all meshes: each has indices in files of the library. */
  get triangles(): number {
    const indices = this.primitives.map((part) => part.indices ?? -1);
    return indices.reduce((sum, at) => sum + (this.contents.accessors?.[at]?.count ?? 0) / 3, 0);
  }

  material(primitive: Primitive): Material | null {
    return this.contents.materials?.[primitive.material ?? -1] ?? null;
  }

  /** The picture of a material's colours as a PNG file; null without one. */
  picture(material: Material): Uint8Array<ArrayBuffer> | null {
    const { textures, images, bufferViews } = this.contents;
    const texture = textures?.[material.pbrMetallicRoughness?.baseColorTexture?.index ?? -1];
    const view = bufferViews?.[images?.[texture?.source ?? -1]?.bufferView ?? -1];
    if (!view) return null;
    const start = view.byteOffset ?? 0;
    return this.bytes.slice(start, start + view.byteLength);
  }

  /** The first pairs of an attribute, at most `most`; null if it is not one of pairs of floats. */
  pairs(at: number | undefined, most: number): Float32Array<ArrayBuffer> | null {
    const accessor = this.contents.accessors?.[at ?? -1];
    const view = this.contents.bufferViews?.[accessor?.bufferView ?? -1];
    if (!accessor || !view || accessor.componentType !== FLOATS) return null;
    const data = new DataView(this.bytes.buffer, this.bytes.byteOffset);
    const start = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    const stride = view.byteStride ?? 8;
    const count = Math.min(accessor.count, most);
    const out = new Float32Array(2 * count);
    for (let pair = 0; pair < count; pair++) {
      out[2 * pair] = data.getFloat32(start + pair * stride, true);
      out[2 * pair + 1] = data.getFloat32(start + pair * stride + 4, true);
    }
    return out;
  }
}
