// The map of species: its plane, and the species and trees at its points.
import { BlendMap } from "../wasm/pleach_web.js";
import { Cache } from "./cache";
import type { Layout, Plane, PointAbout } from "./protocol";
import type { Handlers } from "./worker";

const maps = new Cache<BlendMap>(2, (map) => map.free());
const plane = (layout: Layout) => maps.get(layout, () => new BlendMap(layout));

// The blend under the pointer is asked for more than once: coarse, fine, weights.
const trees = new Cache<ReturnType<typeof growAt>>(4, (tree) => tree.free());

/** The seed of every tree on the map, and of `pleach blend` followed by `pleach grow`. */
const SEED = 1;

function growAt(layout: Layout, x: number, y: number, leafy: boolean) {
  const species = plane(layout).at(x, y, "blend");
  const tree = species.grow(SEED, leafy);
  species.free();
  return tree;
}

export const mapHandlers: Handlers<"mapPlane" | "mapTree" | "mapAbout" | "mapToml"> = {
  mapPlane: (layout) => JSON.parse(plane(layout).plane()) as Plane,

  mapTree({ layout, x, y, size, detail }) {
    const leafy = detail !== "bare";
    const tree = trees.get(`${layout} ${x} ${y} ${leafy}`, () => growAt(layout, x, y, leafy));
    const ink = detail === "full" ? tree.silhouette(size, 0, 0) : tree.coarse_silhouette(size);
    return { width: size, height: size, ink: ink.slice() };
  },

  mapAbout: ({ layout, x, y }) => JSON.parse(plane(layout).about(x, y)) as PointAbout,

  mapToml: ({ layout, x, y, name }) => plane(layout).toml(x, y, name),
};
