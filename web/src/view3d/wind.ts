// Wind in the vertex shader, from four weights per vertex: sway, phase of the branch, flutter, level.
import type { WebGLProgramParametersWithUniforms } from "three";

export interface WindUniforms {
  time: { value: number };
  /** 0 is still air. */
  strength: { value: number };
  /** Height of the tree in metres: large trees move farther. */
  height: { value: number };
}

const DECLARED = /* glsl */ `
attribute vec4 wind;
uniform float windTime;
uniform float windStrength;
uniform float windHeight;
vec3 blown(vec3 at) {
  float turn = wind.y * 6.2831853;
  float gust = sin(windTime * 0.9) + 0.5 * sin(windTime * 2.1 + 1.3);
  float branch = sin(windTime * 2.3 + turn) + 0.4 * sin(windTime * 4.7 + turn * 3.0);
  vec2 bend = vec2(0.9, 0.4) * gust * wind.x * wind.x * 0.012 * windHeight;
  vec2 sway = vec2(0.5, 0.8) * branch * wind.x * 0.004 * windHeight;
  float shiver = sin(windTime * 8.0 + turn * 5.0 + at.x * 4.0 + at.z * 3.0) * wind.z;
  return at + windStrength * vec3(bend.x + sway.x + shiver, shiver * 0.5, bend.y + sway.y - shiver);
}
`;

/** Makes what a shader draws move. Shadows need the same in the shader of their depth. */
export function blow(shader: WebGLProgramParametersWithUniforms, uniforms: WindUniforms): void {
  shader.uniforms.windTime = uniforms.time;
  shader.uniforms.windStrength = uniforms.strength;
  shader.uniforms.windHeight = uniforms.height;
  shader.vertexShader = shader.vertexShader
    .replace("#include <common>", `#include <common>\n${DECLARED}`)
    .replace("#include <begin_vertex>", "vec3 transformed = blown(position);");
}
