// Light through leaves: what three does not read of a GLB file's materials.
import {
  type Color,
  type Material,
  MeshStandardMaterial,
  Color as ThreeColor,
  type WebGLProgramParametersWithUniforms,
} from "three";

export interface Transmission {
  share: number;
  tint: Color;
}

/** Of the library's leaves, for meshes that do not say so themselves. */
export const LEAF_TRANSMISSION: Transmission = { share: 0.4, tint: new ThreeColor(1, 1, 0.45) };

/** `KHR_materials_diffuse_transmission` of a material, if it has it. */
function transmissionOf(material: Material): Transmission | null {
  const found: unknown = material.userData.gltfExtensions?.KHR_materials_diffuse_transmission;
  if (!found || typeof found !== "object") return null;
  const { diffuseTransmissionFactor: share = 0, diffuseTransmissionColorFactor: tint = [1, 1, 1] } =
    found as {
      diffuseTransmissionFactor?: number;
      diffuseTransmissionColorFactor?: [number, number, number];
    };
  return share > 0 ? { share, tint: new ThreeColor(...tint) } : null;
}

// There is one sun, and after the loop over the lights it is still in `directLight`, with the shadows on it.
const THROUGH = /* glsl */ `
#include <lights_fragment_begin>
#if NUM_DIR_LIGHTS > 0
{
  float behind = saturate(-dot(geometryNormal, directLight.direction));
  reflectedLight.directDiffuse *= 1.0 - throughShare;
  reflectedLight.directDiffuse += throughShare * behind * directLight.color * BRDF_Lambert(diffuseColor.rgb * throughTint);
}
#endif
`;

// Smaller copies of a picture blur its alpha, so that a tree would get thinner with the distance: each copy is made
// more opaque than the one before by this share.
const DENSER = /* glsl */ `
#include <map_fragment>
#ifdef USE_MAP
{
  vec2 pixels = vMapUv * vec2(textureSize(map, 0));
  vec2 across = dFdx(pixels), down = dFdy(pixels);
  float copy = max(0.0, 0.5 * log2(max(dot(across, across), dot(down, down))));
  diffuseColor.a *= 1.0 + 0.25 * copy;
}
#endif
`;

/** Lets the sun through what a shader draws. */
export function letThrough(shader: WebGLProgramParametersWithUniforms, { share, tint }: Transmission): void {
  shader.uniforms.throughShare = { value: share };
  shader.uniforms.throughTint = { value: tint };
  const source = shader.fragmentShader
    .replace("#include <map_fragment>", DENSER)
    .replace("#include <lights_fragment_begin>", THROUGH);
  shader.fragmentShader = `uniform float throughShare;\nuniform vec3 throughTint;\n${source}`;
}

/** Fits a loaded material to this view: `sharp` is how many samples a slanting picture may have. */
export function prepare(material: Material, sharp: number): void {
  if (!(material instanceof MeshStandardMaterial)) return;
  if (material.map) material.map.anisotropy = sharp;
  if (material.normalMap) material.normalMap.anisotropy = sharp;
  // Edges of leaves are as smooth as those of triangles.
  if (material.alphaTest > 0) material.alphaToCoverage = true;
  const transmission = transmissionOf(material);
  if (!transmission) return;
  material.onBeforeCompile = (shader) => letThrough(shader, transmission);
  material.customProgramCacheKey = () => "through";
}
