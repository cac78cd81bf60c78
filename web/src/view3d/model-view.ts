// A GLB file of the library, shown with its own materials, under a sky.
import {
  Box3,
  Color,
  type Material,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  Texture,
  type Vector3,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { prepare } from "./foliage";
import { SceneView } from "./scene-view";
import { Sky, type SkyColors } from "./sky";
import { canSway, stillAir, swayingDepth, swayMaterial } from "./sway";
import { releaseTexture, texturesFromBytes } from "./textures";

/** Samples of a picture that is seen from the side. */
const SHARP = 8;

const colors = (zenith: number, horizon: number, haze: number, glow: number): SkyColors => ({
  zenith: new Color(zenith),
  horizon: new Color(horizon),
  haze: new Color(haze),
  glow: new Color(glow),
});
const DAY = colors(0x6f9fce, 0xdde8ee, 0xb9c2a4, 0x3a3424);
const DUSK = colors(0x2a3d60, 0xa8949a, 0x39412f, 0x6a4426);

/** Materials and pictures are not released with the scene that uses them. */
function release(root: Object3D): void {
  root.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    node.geometry.dispose();
    for (const material of [node.material].flat()) {
      for (const value of Object.values(material)) {
        if (value instanceof Texture) releaseTexture(value);
      }
      material.dispose();
    }
    node.customDepthMaterial?.dispose();
  });
}

export class ModelView extends SceneView {
  private readonly skyDome = new Sky(this.sun.position);
  private readonly air = stillAir();
  private blowing = false;
  private model: Object3D | null = null;
  private asked = 0;

  constructor(canvas: HTMLCanvasElement, lost: (gone: boolean) => void) {
    super(canvas, lost, true);
    this.scene.add(this.skyDome.dome);
    // A finger that goes up or down moves the page; one that goes sideways turns the tree.
    canvas.style.touchAction = "pan-y";
  }

  override setTheme(dark: boolean): void {
    const sky = dark ? DUSK : DAY;
    this.skyDome.setColors(sky);
    this.ground.paint(new Color(dark ? 0x39412f : 0x9aa878), dark ? 0.5 : 0.42);
    this.sun.color.set(dark ? 0xffc890 : 0xfff1da);
    this.sun.intensity = dark ? 2.4 : 2.9;
    this.hemisphereLight.color.set(dark ? 0x9fb0d0 : 0xdfeaf5);
    this.hemisphereLight.groundColor.set(dark ? 0x5a5348 : 0x7d7a58);
    this.hemisphereLight.intensity = dark ? 2.2 : 2.1;
    this.draw();
  }

  /** True once the tree is on the screen; false if another was asked for meanwhile. */
  async show(glb: ArrayBuffer): Promise<boolean> {
    const mine = ++this.asked;
    const { scene } = await new GLTFLoader().register(texturesFromBytes).parseAsync(glb, "");
    const sharp = Math.min(SHARP, this.renderer.capabilities.getMaxAnisotropy());
    const swaying = new Set<Material>();
    scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      node.castShadow = true;
      node.receiveShadow = true;
      for (const material of [node.material].flat()) prepare(material, sharp);
      this.letSway(node, swaying);
    });
    // The shaders are made while the tree before is still to be seen.
    await this.renderer.compileAsync(scene, this.camera, this.scene);
    if (mine !== this.asked) {
      release(scene);
      return false;
    }
    this.drop();
    this.model = scene;
    this.scene.add(scene);
    const box = new Box3().setFromObject(scene);
    this.air.treeHeight.value = Math.max(box.max.y, 0.1);
    this.frameTree(box);
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
    return true;
  }

  setWind(on: boolean): void {
    this.blowing = on;
    this.air.wind.value.set(on ? 1 : 0, 0, on ? 0.3 : 0);
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  protected override moved(time: number): boolean {
    if (!this.blowing) return false;
    this.air.windTime.value = time / 1000;
    this.renderer.shadowMap.needsUpdate = true;
    return true;
  }

  /** The tree and its shadow. */
  private letSway(node: Mesh, swaying: Set<Material>): void {
    const { geometry, material } = node;
    if (!canSway(geometry) || !(material instanceof MeshStandardMaterial)) return;
    // Meshes may share a material.
    if (!swaying.has(material)) swayMaterial(material, this.air);
    swaying.add(material);
    node.customDepthMaterial = swayingDepth(material, this.air);
  }

  override dispose(): void {
    this.asked++;
    this.drop();
    this.skyDome.dispose();
    super.dispose();
  }

  /** From the front, as the goal is. */
  protected override firstDirection(): { x: number; y: number; z: number } {
    return { x: 0, y: 0.05, z: 1 };
  }

  /** As wide and high as it is from the front; what comes nearer than the trunk looks larger. */
  protected override distanceFor(extent: Vector3): number {
    return Math.max(extent.y * 0.56, (extent.x * 0.58) / this.camera.aspect) + extent.z * 0.08;
  }

  private drop(): void {
    if (!this.model) return;
    this.scene.remove(this.model);
    release(this.model);
    this.model = null;
  }
}
