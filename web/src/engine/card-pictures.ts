// What cards show: the library draws leaves for its files alone, so the pictures are taken out of a small one.
import { Glb } from "./glb";
import type { CardPicture } from "./protocol";

/** Vertices of a leaf: two crossed cards. A blossom has one card, and so half as many. */
const CARD_VERTICES = 8;
/** Enough leaves that no pattern is seen when they repeat. */
const MAX_LEAVES = 256;

export function cardPictures(file: Uint8Array<ArrayBuffer>): CardPicture[] {
  const glb = new Glb(file);
  return glb.primitives.flatMap((primitive) => {
    const material = glb.material(primitive);
    if (!material?.name || material.name === "bark") return [];
    const png = glb.picture(material);
    const uv = glb.pairs(primitive.attributes.TEXCOORD_0, MAX_LEAVES * CARD_VERTICES);
    if (!png || !uv) return [];
    const whole = uv.length - (uv.length % (2 * CARD_VERTICES));
    return whole === 0 ? [] : [{ material: material.name, png, uv: uv.slice(0, whole) }];
  });
}
