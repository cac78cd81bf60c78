// Species and trees: opening, changing, growing, drawing, exporting.
import { type MeshBuffers, Species, type Tree } from "../wasm/pleach_web.js";
import { Cache } from "./cache";
import { cardPictures } from "./card-pictures";
import { picturesOnly } from "./pictures-only";
import type {
  EditedGrammar,
  ExportOptions,
  MeshData,
  MeshFormat,
  MeshPart,
  OpenedSpecies,
  Parameter,
  Spec,
  SpeciesInfo,
  SpeciesSource,
  TreeStats,
} from "./protocol";
import type { Handlers } from "./worker";

// Handles on wasm memory: freed when they leave the cache.
const sources = new Cache<Species>(12, (species) => species.free());
const variants = new Cache<Species>(12, (species) => species.free());
const trees = new Cache<Tree>(3, (tree) => tree.free());

function sourceKey(source: SpeciesSource): string {
  return "builtin" in source ? source.builtin : `\n${source.name}\n${source.toml}`;
}

function specKey(spec: Spec): string {
  return spec.values ? `${sourceKey(spec.source)}\n${spec.values.join()}` : sourceKey(spec.source);
}

function openSource(source: SpeciesSource): Species {
  return sources.get(sourceKey(source), () =>
    "builtin" in source ? Species.named(source.builtin) : Species.read(source.toml, source.name),
  );
}

function species(spec: Spec): Species {
  const { values } = spec;
  if (!values) return openSource(spec.source);
  return variants.get(specKey(spec), () => openSource(spec.source).with_values(Float64Array.from(values)));
}

function grow(spec: Spec, seed: number): Tree {
  return trees.get(`${seed}\n${specKey(spec)}`, () => species(spec).grow(seed));
}

const stats = (tree: Tree) => JSON.parse(tree.stats()) as TreeStats;

const flags = (list: Uint8Array) => Array.from(list, (flag) => flag !== 0);

/** Millions of vertices: measured here, so that the page does not stall. */
function bounds(positions: Float32Array): Pick<MeshData, "low" | "high"> {
  const low: MeshData["low"] = [0, 0, 0];
  const high: MeshData["high"] = [0, 0, 0];
  for (let at = 0; at < positions.length; at += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const value = positions[at + axis] ?? 0;
      if (value < (low[axis] ?? 0)) low[axis] = value;
      if (value > (high[axis] ?? 0)) high[axis] = value;
    }
  }
  return { low, high };
}

function meshData(mesh: MeshBuffers, tree: Tree): MeshData {
  const positions = mesh.positions().slice();
  return {
    parts: JSON.parse(mesh.parts()) as MeshPart[],
    positions,
    ...bounds(positions),
    normals: mesh.normals().slice(),
    wind: mesh.wind().slice(),
    colors: mesh.colors().slice(),
    indices: mesh.indices().slice(),
    level: mesh.level(),
    wanted: mesh.wanted_triangles(),
    stats: stats(tree),
  };
}

const infoOf = (of: Species) => JSON.parse(of.info()) as SpeciesInfo;

/** Of the tree that a species file means. */
const ownSeed = (of: Species) => infoOf(of).tree_seed ?? 1;

/** The files with their names, and what the user is to be told. */
export function write(
  spec: Spec,
  seed: number,
  format: MeshFormat,
  stem: string,
  options: ExportOptions,
): [[string, Uint8Array<ArrayBuffer>][], string] {
  const written: unknown = grow(spec, seed).export(format, stem, JSON.stringify(options));
  return written as [[string, Uint8Array<ArrayBuffer>][], string];
}

export const speciesHandlers: Handlers<
  | "open"
  | "active"
  | "grammar"
  | "blend"
  | "dice"
  | "toml"
  | "silhouette"
  | "mesh"
  | "picturedMesh"
  | "cardPictures"
  | "picture"
  | "export"
> = {
  open(spec): OpenedSpecies {
    const opened = species(spec);
    return {
      info: infoOf(opened),
      declared: JSON.parse(opened.declared()) as Parameter[],
      values: Array.from(opened.values()),
      active: flags(opened.active()),
      grammar: opened.grammar() ?? null,
    };
  },

  grammar: ({ spec, text }) => JSON.parse(species(spec).with_grammar(text)) as EditedGrammar,

  active: (spec) => flags(species(spec).active()),

  blend({ from, to, at, name }) {
    const blended = species(from).blended(species(to), at, name);
    const text = blended.to_toml();
    blended.free();
    return text;
  },

  dice({ spec, seed, locked, strength }) {
    const thrown = species(spec).dice(seed, locked, strength);
    const values = Array.from(thrown.values());
    thrown.free();
    return values;
  },

  toml({ spec, name, treeSeed }) {
    let written = species(spec);
    const made: Species[] = [];
    if (treeSeed !== null) {
      written = written.with_tree_seed(treeSeed);
      made.push(written);
    }
    if (name !== null) {
      written = written.named_as(name);
      made.push(written);
    }
    const text = written.to_toml();
    for (const each of made) each.free();
    return text;
  },

  silhouette({ spec, seed, size, coarse }) {
    const tree = grow(spec, seed);
    const ink = coarse ? tree.coarse_silhouette(size) : tree.silhouette(size, 0, 0);
    return { width: size, height: size, ink: ink.slice(), stats: stats(tree) };
  },

  mesh({ spec, seed, season, leaves, level, most }) {
    const tree = grow(spec, seed);
    const mesh = tree.mesh(season, leaves, level, most);
    const out = meshData(mesh, tree);
    mesh.free();
    return out;
  },

  picturedMesh({ source, level, most }) {
    const spec = { source, values: null };
    const tree = grow(spec, ownSeed(species(spec)));
    const mesh = tree.mesh("", "pictured", level, most);
    const out = { ...meshData(mesh, tree), uv: mesh.uv().slice(), looks: tree.looks() };
    mesh.free();
    return out;
  },

  picture({ spec, seed, season, size, azimuth, elevation }) {
    const tree = grow(spec, seed);
    return { size, rgba: tree.picture(size, season, azimuth, elevation).slice(), stats: stats(tree) };
  },

  cardPictures({ spec, seed, season }) {
    const [[file]] = write(spec, seed, "glb", "cards", picturesOnly(season));
    return file ? cardPictures(file[1]) : [];
  },

  export({ spec, seed, format, stem, options }) {
    const [files, note] = write(spec, seed, format, stem, options);
    return { files: files.map(([name, bytes]) => ({ name, bytes })), note };
  },
};
