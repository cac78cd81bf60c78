// The sky: a dome that is hazy at the horizon, with a glow where the sun is.
import { BackSide, Color, Mesh, ShaderMaterial, SphereGeometry, type Vector3 } from "three";

export interface SkyColors {
  zenith: Color;
  horizon: Color;
  /** What the dome has below the horizon, into which the meadow fades. */
  haze: Color;
  glow: Color;
}

export class Sky {
  private readonly shape = new SphereGeometry(1, 32, 24);
  private readonly paint = new ShaderMaterial({
    side: BackSide,
    depthWrite: false,
    depthTest: false,
    uniforms: {
      zenith: { value: new Color() },
      horizon: { value: new Color() },
      haze: { value: new Color() },
      glow: { value: new Color() },
      sun: { value: null },
    },
    vertexShader: /* glsl */ `
varying vec3 toward;
void main() {
  toward = position;
  // Only turned with the camera: the sky is the same from everywhere.
  vec4 at = projectionMatrix * vec4(mat3(viewMatrix) * position, 1.0);
  gl_Position = at.xyww;
}`,
    fragmentShader: /* glsl */ `
uniform vec3 zenith, horizon, haze, glow, sun;
varying vec3 toward;
void main() {
  vec3 way = normalize(toward);
  float up = max(way.y, 0.0);
  vec3 color = mix(horizon, zenith, 1.0 - pow(1.0 - up, 4.0));
  color += glow * pow(max(dot(way, normalize(sun)), 0.0), 24.0);
  color = mix(color, haze, smoothstep(0.02, -0.06, way.y));
  gl_FragColor = vec4(color, 1.0);
  #include <colorspace_fragment>
}`,
  });
  readonly dome = new Mesh(this.shape, this.paint);

  constructor(sun: Vector3) {
    this.dome.frustumCulled = false;
    this.dome.renderOrder = -2;
    this.set("sun", sun);
  }

  setColors(colors: SkyColors): void {
    for (const [name, color] of Object.entries(colors)) this.set(name, color);
  }

  dispose(): void {
    this.shape.dispose();
    this.paint.dispose();
  }

  private set(name: string, value: Color | Vector3): void {
    const uniform = this.paint.uniforms[name];
    if (uniform) uniform.value = value;
  }
}
