// A round meadow that fades into the page, and the shadow on it.
import {
  CircleGeometry,
  type Color,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshBasicMaterial,
  ShadowMaterial,
} from "three";

const RINGS = [0, 0.35, 1];

export class Ground {
  readonly group = new Group();
  private readonly shadow = new ShadowMaterial({ opacity: 0.32, color: 0x0a140c });
  private readonly fade = new MeshBasicMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
    toneMapped: false,
    dithering: true,
  });
  private readonly disc = new CircleGeometry(1, 72);
  private readonly meadow: Mesh;

  constructor() {
    this.disc.rotateX(-Math.PI / 2);
    this.meadow = new Mesh(this.disc, this.fade);
    this.meadow.position.y = -0.002;
    this.meadow.renderOrder = -1;
    const catcher = new Mesh(this.disc, this.shadow);
    catcher.receiveShadow = true;
    this.group.add(this.meadow, catcher);
  }

  /** Strong in the middle, nothing at the rim. */
  paint(color: Color, shadowOpacity: number): void {
    const places = this.disc.getAttribute("position");
    const colors: number[] = [];
    for (let at = 0; at < places.count; at++) {
      const from = Math.hypot(places.getX(at), places.getZ(at));
      colors.push(color.r, color.g, color.b, from < (RINGS[1] ?? 0) ? 1 : 0);
    }
    this.disc.setAttribute("color", new Float32BufferAttribute(colors, 4));
    this.shadow.opacity = shadowOpacity;
  }

  resize(radius: number): void {
    this.group.scale.set(radius, 1, radius);
  }

  dispose(): void {
    this.disc.dispose();
    this.shadow.dispose();
    this.fade.dispose();
  }
}
