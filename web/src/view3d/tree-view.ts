// The tree of the species room: the library's plain mesh, quick to make, and wind in it.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  FrontSide,
  Material,
  Mesh,
  MeshDepthMaterial,
  MeshLambertMaterial,
  RGBADepthPacking,
  Sphere,
  SRGBColorSpace,
  type Texture,
  Vector3,
} from "three";
import type { CardPicture, MeshData, MeshPart } from "../engine/protocol";
import { ALPHA_CUT, CardTextures, cardUv } from "./cards";
import { LEAF_TRANSMISSION, letThrough } from "./foliage";
import { SceneView } from "./scene-view";
import { blow, type WindUniforms } from "./wind";

/** One part of a mesh. */
interface Piece {
  readonly mesh: Mesh<BufferGeometry, Material[]>;
  readonly material: MeshLambertMaterial;
  readonly depth: MeshDepthMaterial;
}

export class TreeView extends SceneView {
  private readonly wind: WindUniforms = { time: { value: 0 }, strength: { value: 0 }, height: { value: 10 } };
  private geometry: BufferGeometry | null = null;
  /** By what they need of a shader, and kept from tree to tree: new ones would have theirs compiled again. */
  private readonly pieces = new Map<string, Piece>();
  /** Of the parts of a geometry that are drawn by another mesh. */
  private readonly hidden = new Material();
  private readonly textures = new CardTextures();
  private asked = 0;
  private isFirst = true;
  private blowing = false;

  /** `took` is told of each tree how many vertices it has, and the milliseconds until it was drawn. */
  constructor(
    canvas: HTMLCanvasElement,
    lost: (gone: boolean) => void,
    private readonly took: (vertices: number, milliseconds: number) => void,
  ) {
    super(canvas, lost);
    this.hidden.visible = false;
  }

  /** `cards` are what cards of this tree show: without them they are as the library's mesh has them. */
  setMesh(data: MeshData, cards: readonly CardPicture[]): void {
    const mine = ++this.asked;
    const loading = cards.length > 0 ? this.textures.load(cards) : null;
    if (!loading) {
      this.put(data, cards);
      return;
    }
    const put = (these: readonly CardPicture[]) => {
      if (mine === this.asked) this.put(data, these);
    };
    // A tree with plain cards is better than the tree before it, or none.
    void loading.then(
      () => put(cards),
      () => put([]),
    );
  }

  private put(data: MeshData, cards: readonly CardPicture[]): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(data.positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(data.normals, 3));
    geometry.setAttribute("wind", new BufferAttribute(data.wind, 4));
    if (cards.length > 0) geometry.setAttribute("uv", new BufferAttribute(cardUv(data, cards), 2));
    geometry.setIndex(new BufferAttribute(data.indices, 1));
    const box = new Box3(new Vector3(...data.low), new Vector3(...data.high));
    geometry.boundingBox = box;
    geometry.boundingSphere = box.getBoundingSphere(new Sphere());
    for (const { mesh } of this.pieces.values()) mesh.visible = false;
    data.parts.forEach((part, at) => {
      geometry.addGroup(part.first, part.count, at);
      const piece = this.piece(part, cards.length > 0 ? this.textures.get(part) : null);
      piece.mesh.geometry = geometry;
      piece.mesh.material = data.parts.map((other) => (other === part ? piece.material : this.hidden));
      piece.mesh.visible = true;
    });
    this.geometry?.dispose();
    this.geometry = geometry;
    this.frameTree(box);
    this.wind.height.value = data.high[1] - data.low[1];
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
    void this.measure(data.positions.length / 3);
  }

  private async measure(vertices: number): Promise<void> {
    const mine = this.asked;
    if (this.isFirst) {
      // Its shaders take longer than itself.
      this.isFirst = false;
      await this.drawn();
      this.renderer.shadowMap.needsUpdate = true;
      this.draw();
    }
    const begun = performance.now();
    await this.drawn();
    if (mine === this.asked) this.took(vertices, performance.now() - begun);
  }

  private piece(part: MeshPart, texture: Texture | null): Piece {
    const key = `${part.material} ${part.double_sided} ${texture !== null}`;
    const piece = this.pieces.get(key) ?? this.newPiece(part, texture !== null);
    this.pieces.set(key, piece);
    const { material, depth } = piece;
    material.map = texture;
    depth.map = texture;
    if (texture) material.color.setScalar(1);
    else material.color.setRGB(...part.color, SRGBColorSpace);
    return piece;
  }

  private newPiece({ material: name, double_sided }: MeshPart, pictured: boolean): Piece {
    const lit = name !== "bark";
    const cut = pictured ? { alphaTest: ALPHA_CUT } : {};
    const side = double_sided ? DoubleSide : FrontSide;
    // Without coverage by alpha: the page behind the canvas would shine through the edges of leaves.
    const material = new MeshLambertMaterial({
      shadowSide: DoubleSide,
      side,
      ...cut,
    });
    material.onBeforeCompile = (shader) => {
      blow(shader, this.wind);
      if (lit) letThrough(shader, LEAF_TRANSMISSION);
    };
    material.customProgramCacheKey = () => (lit ? "wind, through" : "wind");
    const depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking, side: DoubleSide, ...cut });
    depth.onBeforeCompile = (shader) => blow(shader, this.wind);
    depth.customProgramCacheKey = () => "wind";
    const mesh = new Mesh<BufferGeometry, Material[]>(undefined, []);
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    mesh.customDepthMaterial = depth;
    this.scene.add(mesh);
    return { mesh, material, depth };
  }

  setWind(on: boolean): void {
    this.blowing = on;
    this.wind.strength.value = on ? 1 : 0;
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  protected override moved(time: number): boolean {
    if (!this.blowing) return false;
    this.wind.time.value = time / 1000;
    this.renderer.shadowMap.needsUpdate = true;
    return true;
  }

  override dispose(): void {
    this.asked++;
    this.geometry?.dispose();
    for (const { material, depth } of this.pieces.values()) {
      material.dispose();
      depth.dispose();
    }
    this.textures.dispose();
    super.dispose();
  }
}
