// The tree in three dimensions. Loaded only when the species room opens; draws only when something changed.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  FrontSide,
  HemisphereLight,
  type Material,
  Mesh,
  MeshDepthMaterial,
  MeshLambertMaterial,
  NeutralToneMapping,
  PCFShadowMap,
  PerspectiveCamera,
  RGBADepthPacking,
  Scene,
  Sphere,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { MeshData } from "../engine/protocol";
import { Ground } from "./ground";
import { blow, type WindUniforms } from "./wind";

const FIELD_OF_VIEW = 32;

export class TreeView {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 2000);
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xfff4e0, 2.6);
  private readonly sky = new HemisphereLight(0xe6eef5, 0x8a8770, 2.9);
  private readonly ground = new Ground();
  private readonly wind: WindUniforms = { time: { value: 0 }, strength: { value: 0 }, height: { value: 10 } };
  private mesh: Mesh<BufferGeometry, Material[]> | null = null;
  private readonly depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking, side: DoubleSide });
  private readonly watcher: ResizeObserver;
  private frame = 0;
  private blowing = false;
  private size = 0;

  /** `lost` is called when the graphics context is gone for good or back again. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    lost: (gone: boolean) => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: false });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    blow(this.depth, this.wind);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.normalBias = 0.03;
    this.scene.add(this.sun, this.sun.target, this.sky, this.ground.group);
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
    this.sky.intensity = dark ? 2.3 : 2.9;
    this.draw();
  }

  setMesh(data: MeshData): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(data.positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(data.normals, 3));
    geometry.setAttribute("wind", new BufferAttribute(data.wind, 4));
    const colored = data.colors.length > 0;
    if (colored) geometry.setAttribute("color", new BufferAttribute(data.colors, 3));
    geometry.setIndex(new BufferAttribute(data.indices, 1));
    geometry.boundingBox = new Box3(new Vector3(...data.low), new Vector3(...data.high));
    geometry.boundingSphere = geometry.boundingBox.getBoundingSphere(new Sphere());
    const materials = data.parts.map((part, at) => {
      geometry.addGroup(part.first, part.count, at);
      const material = new MeshLambertMaterial({
        color: colored ? 0xffffff : new Color().setRGB(...part.color, SRGBColorSpace),
        vertexColors: colored,
        side: part.double_sided ? DoubleSide : FrontSide,
        shadowSide: DoubleSide,
      });
      blow(material, this.wind);
      return material;
    });
    this.removeMesh();
    this.mesh = new Mesh(geometry, materials);
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    this.mesh.customDepthMaterial = this.depth;
    this.scene.add(this.mesh);
    this.frameTree(geometry);
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  /** Keeps the direction of view; the distance follows the tree's size. */
  private frameTree(geometry: BufferGeometry): void {
    const box = geometry.boundingBox ?? new Box3();
    const extent = box.getSize(new Vector3());
    const center = box.getCenter(new Vector3());
    const size = Math.max(extent.y, Math.max(extent.x, extent.z) * 0.95, 0.1);
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (size * 0.62) / Math.tan((FIELD_OF_VIEW * Math.PI) / 360) / narrow + extent.z * 0.2;
    const target = new Vector3(center.x, box.min.y + extent.y * 0.48, center.z);
    if (this.size === 0) {
      this.camera.position.set(
        target.x + distance * 0.35,
        target.y + distance * 0.12,
        target.z + distance * 0.93,
      );
    } else if (Math.abs(size / this.size - 1) > 0.02) {
      const from = this.camera.position.clone().sub(this.controls.target);
      from.multiplyScalar(size / this.size);
      this.camera.position.copy(target).add(from);
    } else {
      this.camera.position.add(target.clone().sub(this.controls.target));
    }
    this.size = size;
    this.wind.height.value = extent.y;
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
    shadow.updateProjectionMatrix();
    this.ground.resize(Math.max(size, extent.x, extent.z) * 1.6);
  }

  setWind(on: boolean): void {
    this.blowing = on;
    this.wind.strength.value = on ? 1 : 0;
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
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

  /** The view as a picture, without a background. */
  snapshot(): Promise<Blob> {
    this.render(performance.now());
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) =>
        blob ? resolve(blob) : reject(new Error("The view could not be written.")),
      );
    });
  }

  /** What the graphics card holds: for the test that nothing leaks. */
  memory(): { geometries: number; textures: number } {
    return { ...this.renderer.info.memory };
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.watcher.disconnect();
    this.controls.dispose();
    this.removeMesh();
    this.ground.dispose();
    this.depth.dispose();
    this.sun.dispose();
    this.renderer.dispose();
  }

  private removeMesh(): void {
    if (!this.mesh) return;
    this.scene.remove(this.mesh);
    this.mesh.geometry.dispose();
    for (const material of this.mesh.material) material.dispose();
    this.mesh = null;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame((time) => this.render(time));
  }

  private render(time: number): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    if (this.blowing) {
      this.wind.time.value = time / 1000;
      this.renderer.shadowMap.needsUpdate = true;
    }
    this.renderer.render(this.scene, this.camera);
    if (this.blowing) this.draw();
  }
}
