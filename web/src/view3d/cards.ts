// Cards of the species room: each shows a leaf of the library's sheet, cut out by its alpha.
import { SRGBColorSpace, type Texture } from "three";
import type { CardPicture, MeshData, MeshPart } from "../engine/protocol";
import { releaseTexture, textureFrom } from "./textures";

/** Below it nothing is drawn: what the library's files say. */
export const ALPHA_CUT = 0.4;

/** Places in the sheets for all vertices of a mesh; those of other parts have none. */
export function cardUv(data: MeshData, cards: readonly CardPicture[]): Float32Array<ArrayBuffer> {
  const all = new Float32Array((data.positions.length / 3) * 2);
  const starts = data.parts.map((part) => data.indices[part.first] ?? 0);
  data.parts.forEach((part, at) => {
    const uv = cards.find((card) => card.material === part.material)?.uv;
    if (!uv) return;
    // The vertices of a part follow each other, leaf by leaf.
    const end = 2 * (starts[at + 1] ?? all.length / 2);
    for (let to = 2 * (starts[at] ?? 0); to < end; to += uv.length) {
      all.set(uv.subarray(0, Math.min(uv.length, end - to)), to);
    }
  });
  return all;
}

/** The sheets of one species, decoded once. */
export class CardTextures {
  private of: readonly CardPicture[] = [];
  private readonly textures = new Map<string, Texture>();
  /** The load under way, or the last one if it failed. */
  private loading: { cards: readonly CardPicture[]; done: Promise<void> } | null = null;
  private loads = 0;

  /** Takes the place of those before, and of those that are still loading. Null if these are there already. */
  load(cards: readonly CardPicture[]): Promise<void> | null {
    if (this.of === cards) {
      this.stopLoading();
      return null;
    }
    if (this.loading?.cards !== cards) this.loading = { cards, done: this.decode(cards) };
    return this.loading.done;
  }

  private async decode(cards: readonly CardPicture[]): Promise<void> {
    const mine = ++this.loads;
    const loaded = await Promise.all(cards.map(({ png }) => textureFrom(png, "image/png")));
    if (mine !== this.loads) {
      // Others were asked for meanwhile, or the view is gone.
      loaded.forEach(releaseTexture);
      return;
    }
    this.dispose();
    this.of = cards;
    for (const [at, texture] of loaded.entries()) {
      texture.colorSpace = SRGBColorSpace;
      this.textures.set(cards[at]?.material ?? "", texture);
    }
  }

  get({ material }: MeshPart): Texture | null {
    return this.textures.get(material) ?? null;
  }

  private stopLoading(): void {
    this.loads++;
    this.loading = null;
  }

  dispose(): void {
    this.stopLoading();
    for (const texture of this.textures.values()) releaseTexture(texture);
    this.textures.clear();
    this.of = [];
  }
}
