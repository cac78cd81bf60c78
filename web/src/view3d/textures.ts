// Textures decoded from bytes. The loader of GLB files would fetch them from an address of their own, which the page's
// policy forbids: it lets the page fetch from its host alone.
import { Texture } from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/addons/loaders/GLTFLoader.js";

interface Image {
  bufferView?: number;
  mimeType?: string;
}

/** A texture as GLB files have it: with its first row at the top. */
export async function textureFrom(bytes: BlobPart, type: string): Promise<Texture> {
  // As they are: colours are for the graphics card, and normals are no colours at all.
  const image = await createImageBitmap(new Blob([bytes], { type }), {
    colorSpaceConversion: "none",
    premultiplyAlpha: "none",
  });
  const texture = new Texture(image);
  texture.flipY = false;
  texture.needsUpdate = true;
  return texture;
}

/** Textures and their pictures are not released with what shows them. */
export function releaseTexture(texture: Texture): void {
  texture.dispose();
  if (texture.image instanceof ImageBitmap) texture.image.close();
}

async function load(parser: GLTFParser, at: number): Promise<Texture> {
  const { bufferView, mimeType = "image/png" } = (parser.json.images as Image[])[at] ?? {};
  if (bufferView === undefined) throw new Error("A picture of the tree is not in its file.");
  const bytes: ArrayBuffer = await parser.getDependency("bufferView", bufferView);
  return textureFrom(bytes, mimeType);
}

/** A plugin of the loader. */
export function texturesFromBytes(parser: GLTFParser): GLTFLoaderPlugin {
  parser.loadImageSource = (at) => load(parser, at);
  return { name: "textures from bytes" };
}
