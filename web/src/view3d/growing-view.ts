// The trees of a search that runs, one after the other, under the sky of the fitted tree.
import type { Box3, Vector3 } from "three";
import { FROM_THE_FRONT, frontDistance } from "./front";
import { loadGlb, materialsOf, releaseMaterial } from "./glb-file";
import type { Growing } from "./growing-protocol";
import { GrowingTree } from "./growing-tree";
import { Outdoors } from "./outdoors";
import { TreeScene } from "./tree-scene";

function release(tree: GrowingTree): void {
  tree.mesh.geometry.dispose();
  for (const material of tree.all) releaseMaterial(material);
}

export class GrowingView extends TreeScene {
  private readonly outdoors = new Outdoors(this.lights());
  /** What is shown, and whose pictures it has. */
  private shown: { of: Growing["pictures"]; tree: GrowingTree } | null = null;
  private made = 0;

  constructor(canvas: OffscreenCanvas) {
    super(canvas, true);
  }

  resize(width: number, height: number, ratio: number): void {
    this.sizeTo(width, height, ratio);
    this.draw();
  }

  setTheme(dark: boolean): void {
    this.outdoors.setTheme(dark);
    this.draw();
  }

  /** Ends once the graphics card has drawn the tree in the place of the one before. */
  async grow({ tree: data, pictures }: Growing): Promise<void> {
    if (this.shown?.of === pictures) this.stand(this.shown.tree.put(data));
    else {
      const tree = new GrowingTree(materialsOf(await loadGlb(pictures.slice().buffer, this.renderer)));
      const box = tree.put(data);
      // The shaders are made while the tree before is still to be seen.
      await this.renderer.compileAsync(tree.mesh, this.camera, this.scene);
      const before = this.shown?.tree;
      if (before) this.scene.remove(before.mesh);
      this.shown = { of: pictures, tree };
      this.scene.add(tree.mesh);
      this.stand(box);
      await this.drawn();
      // Not sooner: shaders that nothing uses for a moment would be made again, those of shadows too.
      if (before) release(before);
      return;
    }
    await this.drawn();
  }

  /** How many programs for the graphics card were made so far: for the test that trees share theirs. */
  programs(): number {
    // Those that were released are not listed any more, and their numbers are not given again.
    this.made = Math.max(this.made, ...(this.renderer.info.programs ?? []).map(({ id }) => id + 1));
    return this.made;
  }

  /** Moves camera, sun and ground to a tree that has come into the scene. */
  private stand(box: Box3): void {
    this.frameTree(box);
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  protected override firstDirection(): { x: number; y: number; z: number } {
    return FROM_THE_FRONT;
  }

  protected override distanceFor(extent: Vector3): number {
    return frontDistance(extent, this.camera.aspect);
  }
}
