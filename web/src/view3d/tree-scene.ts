// A drawing of a tree on a meadow, in the sun: camera, light, size. What the tree is made of is up to those who extend it.
// Draws only when something changed. Works on the page and in workers.
import {
  type Box3,
  DirectionalLight,
  HemisphereLight,
  NeutralToneMapping,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from "three";
import { Ground } from "./ground";

const FIELD_OF_VIEW = 32;
/** Milliseconds between looks at whether the graphics card is done. */
const LOOK_EVERY = 20;
/** Of shadows, in metres. */
const NORMAL_BIAS = 0.03;
/** Of the angle from straight above to where the view is seen from. */
export const LOWEST = Math.PI * 0.52;

export interface Lights {
  readonly scene: Scene;
  readonly sun: DirectionalLight;
  readonly hemisphereLight: HemisphereLight;
  readonly ground: Ground;
}

export class TreeScene {
  protected readonly renderer: WebGLRenderer;
  protected readonly scene = new Scene();
  protected readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 2000);
  /** What the camera looks at. */
  protected readonly target = new Vector3();
  protected readonly sun = new DirectionalLight(0xfff4e0, 2.6);
  protected readonly hemisphereLight = new HemisphereLight(0xe6eef5, 0x8a8770, 2.9);
  protected readonly ground = new Ground();
  private frame = 0;
  private size = 0;

  /**
   * A view that `fills` its canvas has the page nowhere behind it, and must not: leaves that are cut out at their edges
   * would let it shine through.
   */
  constructor(canvas: HTMLCanvasElement | OffscreenCanvas, fills: boolean) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: !fills });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    // The shaders are the page's own: asking for their errors would hold up the page until they are compiled.
    this.renderer.debug.checkShaderErrors = false;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.normalBias = NORMAL_BIAS;
    this.scene.add(this.sun, this.sun.target, this.hemisphereLight, this.ground.group);
  }

  /** What a sky changes with the time of the day. */
  protected lights(): Lights {
    const { scene, sun, hemisphereLight, ground } = this;
    return { scene, sun, hemisphereLight, ground };
  }

  /** In pixels of the page, of which each has `ratio` pixels of the drawing in both directions. */
  protected sizeTo(width: number, height: number, ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** Keeps the direction of view; the distance follows the tree's size. */
  protected frameTree(box: Box3): void {
    const extent = box.getSize(new Vector3());
    const center = box.getCenter(new Vector3());
    const size = Math.max(extent.y, Math.max(extent.x, extent.z) * 0.95, 0.1);
    const distance = this.distanceFor(extent, size) / Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const target = new Vector3(center.x, box.min.y + extent.y * 0.48, center.z);
    if (this.size === 0) {
      const { x, y, z } = this.firstDirection();
      this.camera.position.copy(target).add(new Vector3(x * distance, y * distance, z * distance));
    } else if (Math.abs(size / this.size - 1) > 0.02) {
      const from = this.camera.position.clone().sub(this.target);
      from.multiplyScalar(size / this.size);
      this.camera.position.copy(target).add(from);
    } else {
      this.camera.position.add(target.clone().sub(this.target));
    }
    this.size = size;
    this.camera.near = size / 200;
    this.camera.far = size * 40;
    this.camera.updateProjectionMatrix();
    this.target.copy(target);
    this.camera.lookAt(target);
    this.framed(size);
    const reach = Math.max(extent.x, extent.z, extent.y) * 1.1;
    this.sun.position.set(target.x - size * 0.9, box.max.y + size * 1.2, target.z + size * 0.9);
    this.sun.target.position.copy(target);
    const shadow = this.sun.shadow.camera;
    shadow.left = shadow.bottom = -reach;
    shadow.right = shadow.top = reach;
    shadow.near = size * 0.05;
    shadow.far = size * 5;
    // The normals of leaves that are lit from behind point away from the sun: along them, the bias puts each into its own
    // shadow. Twice as much towards the sun takes it out.
    this.sun.shadow.bias = (-2 * NORMAL_BIAS) / (shadow.far - shadow.near);
    shadow.updateProjectionMatrix();
    this.ground.resize(Math.max(size, extent.x, extent.z) * 1.6);
  }

  /** Called once a tree of this size is framed. */
  protected framed(_size: number): void {}

  /** How much of the world is to be seen from the middle of the view to its rim, in metres. */
  protected distanceFor(extent: Vector3, size: number): number {
    return (size * 0.62) / Math.min(1, this.camera.aspect) + extent.z * 0.06;
  }

  /** From where the first tree is seen, in parts of the distance. */
  protected firstDirection(): { x: number; y: number; z: number } {
    return { x: 0.35, y: 0.12, z: 0.93 };
  }

  /** Steps around the tree, for keyboards: radians around and up, and a factor of the distance. */
  orbit(around: number, up: number, factor: number): void {
    const from = this.camera.position.clone().sub(this.target);
    const radius = from.length() * factor;
    const polar = Math.min(Math.max(Math.acos(from.y / from.length()) - up, 0.05), LOWEST);
    const angle = Math.atan2(from.x, from.z) + around;
    from.set(Math.sin(polar) * Math.sin(angle), Math.cos(polar), Math.sin(polar) * Math.cos(angle));
    this.camera.position.copy(this.target).addScaledVector(from, radius);
    this.camera.lookAt(this.target);
    this.draw();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.ground.dispose();
    this.sun.dispose();
    this.renderer.dispose();
  }

  protected draw(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame((time) => this.render(time));
  }

  /** Ends once the graphics card has drawn the next picture of the screen. */
  protected async drawn(): Promise<void> {
    await new Promise(requestAnimationFrame);
    const card = this.renderer.getContext() as WebGL2RenderingContext;
    const done = card.fenceSync(card.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!done) return;
    card.flush();
    while (card.clientWaitSync(done, 0, 0) === card.TIMEOUT_EXPIRED) {
      await new Promise((go) => setTimeout(go, LOOK_EVERY));
    }
    card.deleteSync(done);
  }

  /** The next picture is drawn without being asked for, if this says so: what moves is moved here. */
  protected moved(_time: number): boolean {
    return false;
  }

  protected render(time: number): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    const goesOn = this.moved(time);
    this.renderer.render(this.scene, this.camera);
    if (goesOn) this.draw();
  }
}
