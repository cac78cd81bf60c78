// A sky over the meadow, by day and at dusk.
import { Color } from "three";
import { Sky, type SkyColors } from "./sky";
import type { Lights } from "./tree-scene";

const colors = (zenith: number, horizon: number, haze: number, glow: number): SkyColors => ({
  zenith: new Color(zenith),
  horizon: new Color(horizon),
  haze: new Color(haze),
  glow: new Color(glow),
});
const DAY = colors(0x6f9fce, 0xdde8ee, 0xb9c2a4, 0x3a3424);
const DUSK = colors(0x2a3d60, 0xa8949a, 0x39412f, 0x6a4426);

export class Outdoors {
  private readonly sky: Sky;

  constructor(private readonly lights: Lights) {
    this.sky = new Sky(lights.sun.position);
    lights.scene.add(this.sky.dome);
  }

  setTheme(dark: boolean): void {
    const { sun, hemisphereLight, ground } = this.lights;
    this.sky.setColors(dark ? DUSK : DAY);
    ground.paint(new Color(dark ? 0x39412f : 0x9aa878), dark ? 0.5 : 0.42);
    sun.color.set(dark ? 0xffc890 : 0xfff1da);
    sun.intensity = dark ? 2.4 : 2.9;
    hemisphereLight.color.set(dark ? 0x9fb0d0 : 0xdfeaf5);
    hemisphereLight.groundColor.set(dark ? 0x5a5348 : 0x7d7a58);
    hemisphereLight.intensity = dark ? 2.2 : 2.1;
  }

  dispose(): void {
    this.sky.dispose();
  }
}
