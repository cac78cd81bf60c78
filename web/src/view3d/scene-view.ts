// A canvas with a tree on a meadow, in the sun: camera, light, size. What the tree is made of is up to those who extend
// it. Draws only when something changed.
import {
  type Box3,
  Color,
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
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Ground } from "./ground";

const FIELD_OF_VIEW = 32;
/** Of shadows, in metres. */
const NORMAL_BIAS = 0.03;

export class SceneView {
  protected readonly renderer: WebGLRenderer;
  protected readonly scene = new Scene();
  protected readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 2000);
  protected readonly controls: OrbitControls;
  protected readonly sun = new DirectionalLight(0xfff4e0, 2.6);
  protected readonly hemisphereLight = new HemisphereLight(0xe6eef5, 0x8a8770, 2.9);
  protected readonly ground = new Ground();
  private readonly watcher: ResizeObserver;
  private frame = 0;
  private size = 0;

  /**
   * `lost` is called when the graphics context is gone for good or back again. A view that `fills` its canvas has the
   * page nowhere behind it, and must not: leaves that are cut out at their edges would let it shine through.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    lost: (gone: boolean) => void,
    fills = false,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: !fills });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    // The shaders are the page's own: asking for their errors would hold up the page until they are compiled.
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.normalBias = NORMAL_BIAS;
    this.scene.add(this.sun, this.sun.target, this.hemisphereLight, this.ground.group);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = Math.PI * 0.52;
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
    this.watcher.observe(canvas);
    this.resize();
  }

  setTheme(dark: boolean): void {
    this.ground.paint(new Color(dark ? 0x262c27 : 0xdcdfcf), dark ? 0.5 : 0.3);
    this.hemisphereLight.intensity = dark ? 2.3 : 2.9;
    this.draw();
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
      const from = this.camera.position.clone().sub(this.controls.target);
      from.multiplyScalar(size / this.size);
      this.camera.position.copy(target).add(from);
    } else {
      this.camera.position.add(target.clone().sub(this.controls.target));
    }
    this.size = size;
    this.camera.near = size / 200;
    this.camera.far = size * 40;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.controls.minDistance = size * 0.05;
    this.controls.maxDistance = size * 8;
    this.controls.update();
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
    const from = this.camera.position.clone().sub(this.controls.target);
    const radius = from.length() * factor;
    const polar = Math.min(Math.max(Math.acos(from.y / from.length()) - up, 0.05), Math.PI * 0.52);
    const angle = Math.atan2(from.x, from.z) + around;
    from.set(Math.sin(polar) * Math.sin(angle), Math.cos(polar), Math.sin(polar) * Math.cos(angle));
    this.camera.position.copy(this.controls.target).addScaledVector(from, radius);
    this.controls.update();
    this.draw();
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

  /** What the graphics card holds once the present tree is drawn: for the test that nothing leaks. */
  memory(): { geometries: number; textures: number; programs: number } {
    this.render(performance.now());
    return { ...this.renderer.info.memory, programs: this.renderer.info.programs?.length ?? 0 };
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.watcher.disconnect();
    this.controls.dispose();
    this.ground.dispose();
    this.sun.dispose();
    this.renderer.dispose();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  protected draw(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame((time) => this.render(time));
  }

  /** The next picture is drawn without being asked for, if this says so: what moves is moved here. */
  protected moved(_time: number): boolean {
    return false;
  }

  private render(time: number): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    const goesOn = this.moved(time);
    this.renderer.render(this.scene, this.camera);
    if (goesOn) this.draw();
  }
}
