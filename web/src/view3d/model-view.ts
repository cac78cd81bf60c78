// A GLB file of the library, shown with its own materials, under a sky.
import { Box3, type Material, Mesh, MeshStandardMaterial, type Object3D, type Vector3 } from "three";
import { FROM_THE_FRONT, frontDistance } from "./front";
import { loadGlb, release } from "./glb-file";
import { Outdoors } from "./outdoors";
import { SceneView } from "./scene-view";
import { canSway, stillAir, swayingDepth, swayMaterial } from "./sway";
import { warmUp } from "./warm";

export class ModelView extends SceneView {
  private readonly outdoors = new Outdoors(this.lights());
  private readonly air = stillAir();
  private blowing = false;
  private model: Object3D | null = null;
  private asked = 0;

  constructor(canvas: HTMLCanvasElement, lost: (gone: boolean) => void) {
    super(canvas, lost, true);
    // A finger that goes up or down moves the page; one that goes sideways turns the tree.
    canvas.style.touchAction = "pan-y";
  }

  override setTheme(dark: boolean): void {
    this.outdoors.setTheme(dark);
    this.draw();
  }

  /** True once the tree is on the screen; false if another was asked for meanwhile. */
  async show(glb: ArrayBuffer): Promise<boolean> {
    const mine = ++this.asked;
    const scene = await loadGlb(glb, this.renderer);
    const swaying = new Set<Material>();
    scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      node.castShadow = true;
      node.receiveShadow = true;
      this.letSway(node, swaying);
    });
    // The tree before is still to be seen.
    await warmUp(this.renderer, scene, this.camera, this.scene);
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
    this.outdoors.dispose();
    super.dispose();
  }

  protected override firstDirection(): { x: number; y: number; z: number } {
    return FROM_THE_FRONT;
  }

  protected override distanceFor(extent: Vector3): number {
    return frontDistance(extent, this.camera.aspect);
  }

  /** An empty meadow is never seen. */
  protected override draw(): void {
    if (this.model) super.draw();
  }

  private drop(): void {
    if (!this.model) return;
    this.scene.remove(this.model);
    release(this.model);
    this.model = null;
  }
}
