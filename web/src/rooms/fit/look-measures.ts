// Where the measures of a tree lie in its picture.
import type { Look, Told } from "../../engine/protocol";
import { corrections } from "./goal-state";

export type Found = Look["found"];
export type Anchor = NonNullable<Look["anchor"]>;
/** In heights of the tree: to the right of the middle of its feet, and up. */
export type At = readonly [number, number];

/** The thickest foot is that of the main trunk. */
export function mainFoot({ feet }: Found): Found["feet"][number] | null {
  return feet.reduce<Found["feet"][number] | null>(
    (most, foot) => (most === null || foot.width > most.width ? foot : most),
    null,
  );
}

/** The value of a measure: as it is said, or as it was read. */
export function measure(key: Told, found: Found): number | null {
  const said = corrections.value[key];
  if (said !== undefined) return said;
  switch (key) {
    case "trunks":
      return found.feet.length;
    case "trunk_width":
      return mainFoot(found)?.width || null;
    default:
      return found[key];
  }
}

/** Where the main trunk is at a height, to the right of the middle of the feet. */
export function trunkAt(found: Found, height: number): number {
  const below = found.trunk.filter(([, y]) => y <= height).at(-1) ?? found.trunk[0];
  return below ? below[0] : (mainFoot(found)?.x ?? 0);
}

export const radians = (degrees: number): number => (degrees * Math.PI) / 180;
export const degrees = (angle: number): number => (angle * 180) / Math.PI;

/** Between heights of the tree and pixels of the picture. */
export class Places {
  constructor(
    private readonly anchor: Anchor,
    private readonly width: number,
    private readonly height: number,
  ) {}

  /** In pixels. */
  pixel([x, y]: At): [number, number] {
    const { origin, ground, height } = this.anchor;
    return [origin + x * height, ground - y * height];
  }

  /** In parts of the picture. */
  part(at: At): [number, number] {
    const [column, row] = this.pixel(at);
    return [column / this.width, row / this.height];
  }

  /** Heights of the tree from parts of the picture. */
  tree([column, row]: readonly [number, number]): At {
    const { origin, ground, height } = this.anchor;
    return [(column * this.width - origin) / height, (ground - row * this.height) / height];
  }

  /** The places of points, for a line. */
  line(points: readonly At[]): string {
    return points
      .map((at) => {
        const [column, row] = this.pixel(at);
        return `${column.toFixed(1)},${row.toFixed(1)}`;
      })
      .join(" ");
  }

  /** To the left and right edge of the picture, at a height. */
  edges(y: number): [At, At] {
    return [
      [this.tree([0, 0])[0], y],
      [this.tree([1, 0])[0], y],
    ];
  }
}
