// Wind in a model of the library, from the numbers that its GLB files have: the formula of docs/wind.md.
import {
  BackSide,
  type BufferGeometry,
  DoubleSide,
  FrontSide,
  type Material,
  MeshDepthMaterial,
  type MeshStandardMaterial,
  RGBADepthPacking,
  Vector3,
  type WebGLProgramParametersWithUniforms,
} from "three";

export interface SwayUniforms {
  /** Where it blows to, of length 1 in a fresh breeze; 0 is still air. */
  wind: { value: Vector3 };
  /** In seconds. */
  windTime: { value: number };
  /** In metres. */
  treeHeight: { value: number };
}

export const stillAir = (): SwayUniforms => ({
  wind: { value: new Vector3() },
  windTime: { value: 0 },
  treeHeight: { value: 10 },
});

/** As three's loader calls the sets of texture coordinates from 1 to 7. */
const SETS = ["uv1", "uv2", "uv3", "texcoord_4", "texcoord_5", "texcoord_6", "texcoord_7"];

/** Whether a mesh has the numbers. */
export const canSway = (geometry: BufferGeometry) => SETS.every((name) => geometry.hasAttribute(name));

const DECLARED = /* glsl */ `
attribute vec2 ${SETS.join(", ")};
uniform vec3 wind;
uniform float windTime, treeHeight;

float sinTurns(float turns) { return sin(6.2831853 * fract(turns)); }

vec3 turned(vec3 at, vec3 pivot, vec3 bend, float phase) {
  float stiff = length(bend);
  vec3 arm = at - pivot;
  float turns = (0.25 + 1.5 * sqrt(stiff)) * windTime + phase;
  vec3 force = wind * (0.4 + 0.6 * sinTurns(turns));
  force.y += 0.25 * length(wind) * sinTurns(1.37 * turns + 0.3);
  vec3 turn = cross(bend, force) * length(arm);
  float angle = length(turn);
  if (angle == 0.0) return at;
  vec3 axis = turn / angle;
  angle /= 1.0 + 4.0 * angle;
  float c = cos(angle);
  return pivot + c * arm + sin(angle) * cross(axis, arm) + (1.0 - c) * dot(axis, arm) * axis;
}

vec3 swayed(vec3 at, vec3 toward) {
  vec2 own = texcoord_7;
  float shiver = sinTurns(3.0 * windTime + fract(own.x) + dot(at, vec3(1.3, 0.9, -1.7)));
  at += toward * (0.001 * floor(own.y) * length(wind) * shiver);
  at = turned(at, vec3(uv1, uv2.x), vec3(uv2.y, uv3), fract(own.x));
  at = turned(at, vec3(texcoord_4, texcoord_5.x), vec3(texcoord_5.y, texcoord_6), fract(own.y));
  float up = max(at.y, 0.0);
  vec3 bow = wind * 0.03 * (0.5 + 0.5 * sinTurns(0.21 * windTime)) / treeHeight;
  at += bow * up * up;
  at.y -= dot(bow, bow) * up * up * up * 2.0 / 3.0;
  return at;
}
`;

/** The sides of a surface that have a shadow, by those that are seen. */
const SHADOW_SIDES = { [FrontSide]: BackSide, [BackSide]: FrontSide, [DoubleSide]: DoubleSide };

type Shader = WebGLProgramParametersWithUniforms;

function sway(shader: Shader, uniforms: SwayUniforms): void {
  Object.assign(shader.uniforms, uniforms);
  const begun = "vec3 transformed = swayed(position, normal);";
  shader.vertexShader = DECLARED + shader.vertexShader.replace("#include <begin_vertex>", begun);
}

/** Makes a material sway, beside what else was made of its shader. */
export function swayMaterial(material: Material, uniforms: SwayUniforms): void {
  const before = material.onBeforeCompile.bind(material);
  const key = material.customProgramCacheKey();
  material.onBeforeCompile = (shader, renderer) => {
    before(shader, renderer);
    sway(shader, uniforms);
  };
  material.customProgramCacheKey = () => `${key}, sway`;
}

/** The same for its shadow. */
export function swayingDepth(of: MeshStandardMaterial, uniforms: SwayUniforms): MeshDepthMaterial {
  const { map, alphaTest, shadowSide, side } = of;
  // As three sets them when it draws the shadow: shaders that are made before are then the same.
  const ofShadow = { map, alphaTest, side: shadowSide ?? SHADOW_SIDES[side] };
  const depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking, ...ofShadow });
  depth.onBeforeCompile = (shader) => sway(shader, uniforms);
  depth.customProgramCacheKey = () => "sway";
  return depth;
}
