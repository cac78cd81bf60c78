// What the families of generators are called, and what they are.

const FAMILIES: Record<string, { title: string; about: string }> = {
  "weber-penn": { title: "Weber and Penn", about: "Trees by levels of stems. The map is of these." },
  lsystem: {
    title: "Grammars",
    about: "L-systems after Hewitt, Steen and The Algorithmic Beauty of Plants.",
  },
  fractal: { title: "Fractal trees", about: "Recursive trees after Coffey." },
  stylised: { title: "Stylised trees", about: "Low-poly trees of blobs, cones and fronds." },
  "space-colonization": {
    title: "Space colonisation",
    about: "Trees that fill a volume, after Runions, Lane and Prusinkiewicz.",
  },
  "least-cost-path": {
    title: "Least-cost paths",
    about: "Trees whose branches share paths, after Xu and Mould.",
  },
};

export const familyTitle = (family: string): string => FAMILIES[family]?.title ?? family;
export const familyAbout = (family: string): string => FAMILIES[family]?.about ?? "";
