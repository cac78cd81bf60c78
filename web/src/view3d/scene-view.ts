// A canvas of the page with a tree on a meadow, which the pointer turns.
import { Color, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { LOWEST, TreeScene } from "./tree-scene";

const UP = new Vector3(0, 1, 0);
/** Pixels of a turntable from top to bottom. */
const TURN_HEIGHT = 720;

export class SceneView extends TreeScene {
  protected readonly controls: OrbitControls;
  private readonly watcher: ResizeObserver;
  /** While it turns by itself: from the tree to where it was seen from. */
  private turning: Vector3 | null = null;

  /** `lost` is called when the graphics context is gone for good or back again. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    lost: (gone: boolean) => void,
    fills = false,
  ) {
    super(canvas, fills);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target = this.target;
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = LOWEST;
    this.controls.addEventListener("change", () => this.draw());
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      lost(true);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.renderer.shadowMap.needsUpdate = true;
      lost(false);
      this.draw();
    });
    this.watcher = new ResizeObserver(() => this.resize());
    // Tells the first size too.
    this.watcher.observe(canvas);
  }

  setTheme(dark: boolean): void {
    this.ground.paint(new Color(dark ? 0x262c27 : 0xdcdfcf), dark ? 0.5 : 0.3);
    this.hemisphereLight.intensity = dark ? 2.3 : 2.9;
    this.draw();
  }

  protected override framed(size: number): void {
    this.controls.minDistance = size * 0.05;
    this.controls.maxDistance = size * 8;
    this.controls.update();
  }

  /** The view as a picture. */
  snapshot(): Promise<Blob> {
    this.render(performance.now());
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) =>
        blob ? resolve(blob) : reject(new Error("The view could not be written.")),
      );
    });
  }

  /** Until the call of what it returns, the view is turned by [turnTo] alone. */
  beginTurn(): () => void {
    const from = this.camera.position.clone();
    this.turning = from.clone().sub(this.target);
    this.controls.enabled = false;
    // Videos need even numbers of pixels.
    const even = (side: number) => Math.max(2, 2 * Math.round(side / 2));
    this.sizeTo(even(TURN_HEIGHT * this.camera.aspect), even(TURN_HEIGHT), 1);
    return () => {
      this.turning = null;
      this.controls.enabled = true;
      this.camera.position.copy(from);
      this.camera.lookAt(this.target);
      this.resize();
    };
  }

  /** Turns the view by an angle from where it was, and draws it there and on `canvas`. */
  turnTo(angle: number, canvas: HTMLCanvasElement): void {
    if (!this.turning) return;
    const way = this.turning.clone().applyAxisAngle(UP, angle);
    this.camera.position.copy(this.target).add(way);
    this.camera.lookAt(this.target);
    this.render(performance.now());
    const { width, height } = this.canvas;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    const pen = canvas.getContext("2d");
    // Where nothing is drawn, the page shows through; a video has no page behind it.
    const { backgroundColor } = getComputedStyle(document.body);
    if (pen) pen.fillStyle = backgroundColor;
    pen?.fillRect(0, 0, width, height);
    pen?.drawImage(this.canvas, 0, 0);
  }

  /** What the graphics card holds once the present tree is drawn: for the test that nothing leaks. */
  memory(): { geometries: number; textures: number; programs: number } {
    this.render(performance.now());
    return { ...this.renderer.info.memory, programs: this.renderer.info.programs?.length ?? 0 };
  }

  override dispose(): void {
    this.watcher.disconnect();
    this.controls.dispose();
    super.dispose();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0 || this.turning) return;
    this.sizeTo(clientWidth, clientHeight, Math.min(devicePixelRatio, 2));
    this.draw();
  }
}
