// What the page and its workers say to each other: one named operation, its input and its output.

export type SpeciesSource = { readonly builtin: string } | { readonly toml: string; readonly name: string };

/** A species: a source, and the whole list of values where they were changed. */
export interface Spec {
  readonly source: SpeciesSource;
  readonly values: readonly number[] | null;
}

export interface SpeciesEntry {
  name: string;
  description: string;
  season_names?: string[];
}
export interface Family {
  family: string;
  species: SpeciesEntry[];
}
export interface SpeciesInfo {
  name: string;
  description: string;
  generator: string;
  tree_seed: number | null;
  own_draws: number;
  seasons: string[];
}
/** What is declared about one number of a parameter. */
export interface Slot {
  slot: string;
  index: number;
  default: number;
  search: [number, number];
  plausible: [number, number];
  scale: "linear" | "log" | "fine_near_zero" | "count";
  effect: "plain" | "size" | "size_jitter" | "layout";
  /** What people call it, for the few numbers that are shown first, in this order. */
  handle: { name: string; order: number } | null;
}
/** What is declared about a parameter, with the keys of `pleach params --json`. */
export interface Parameter {
  name: string;
  values: number;
  kind: "real" | "integer" | "choice" | "flagged" | "flagged integer";
  min: number | null;
  max: number | null;
  unit: string;
  default: number[];
  search: [number, number][];
  opt_in: boolean;
  group: string;
  first: number | null;
  choices: string[] | null;
  negative: string | null;
  neutral: number | null;
  breakpoints: number[];
  doc: string;
  source: string;
  slots: Slot[];
}
export interface OpenedSpecies {
  info: SpeciesInfo;
  declared: Parameter[];
  values: number[];
  active: boolean[];
  /** Its text, with comments; null for species of other families. */
  grammar: string | null;
}
/**
 * What there is to say about a place of a grammar's text. Lines and columns are from 1; columns count characters, and the
 * end is behind the last.
 */
export interface Remark {
  line: number;
  column: number;
  end_line: number;
  end_column: number;
  warning: boolean;
  message: string;
  help: string | null;
}
export interface EditedGrammar {
  /** The species file, or null where the grammar is wrong. */
  toml: string | null;
  /** The first at the top. */
  remarks: Remark[];
}
export interface TreeStats {
  height: number;
  width: number;
  stems: number;
  leaves: number;
  [more: string]: number;
}
export interface Ink {
  width: number;
  height: number;
  ink: Uint8Array<ArrayBuffer>;
}
export interface MeshPart {
  material: string;
  color: [number, number, number];
  double_sided: boolean;
  first: number;
  count: number;
}
export interface MeshData {
  parts: MeshPart[];
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  wind: Float32Array<ArrayBuffer>;
  colors: Float32Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
  /** Of detail: a coarser one than was asked for, where that has too many vertices. */
  level: number;
  /** Triangles of the level that was asked for. */
  wanted: number;
  /** Lowest and highest x, y, z. */
  low: [number, number, number];
  high: [number, number, number];
  stats: TreeStats;
}
/** A tree for the pictures of its GLB file. */
export interface PicturedMesh extends MeshData {
  uv: Float32Array<ArrayBuffer>;
  /** Trees with the same text have the same pictures. */
  looks: string;
}
/** What the cards of a material show. */
export interface CardPicture {
  material: string;
  png: Uint8Array<ArrayBuffer>;
  /** Places in it for the vertices of cards, in their order, to be repeated from the start. */
  uv: Float32Array<ArrayBuffer>;
}
export interface Picture {
  size: number;
  rgba: Uint8Array<ArrayBuffer>;
  stats: TreeStats;
}
export interface GoalInfo {
  name: string;
  width: number;
  height: number;
  ink: number;
  masked: boolean;
  confidence: number | null;
  ground_row: number;
  axis_column: number;
  height_in_pixels: number;
  warnings: GoalWarning[];
}
/** What is odd about a goal: a word for it, and a sentence without a full stop. */
export interface GoalWarning {
  kind: string;
  message: string;
}
/** How a picture becomes a mask: as it looks, as a photograph, or by brightness. */
export type MaskWay = "auto" | "photo" | "off";

/** What is shown of the tree in a photograph, in its pixels: as in the options of a fit. */
export interface MaskHints {
  /** First column, first row, columns, rows. */
  box?: [number, number, number, number];
  /** Columns and rows of points that are of the tree, and of points that are not. */
  include?: [number, number][];
  exclude?: [number, number][];
}

export interface GoalData {
  info: GoalInfo;
  /** Pixels of the file; the goal has fewer if there are very many. */
  full: { width: number; height: number };
  ink: Uint8Array<ArrayBuffer>;
  photo: Uint8Array<ArrayBuffer>;
}
/** A goal as pixels and the two lines: all that a worker needs to make it again. */
export interface GoalPixels extends Ink {
  name: string;
  ground: number | null;
  axis: number | null;
  /** Colours of the tree, where they were seen. */
  colors: SeenColors | null;
}
/** Colours as JSON; and one byte per pixel, 1 for wood and 2 for foliage. */
export interface SeenColors {
  json: string;
  layers: Uint8Array<ArrayBuffer>;
}

/** Measures of a tree that a person can say: lengths are in heights of the tree. */
export type Told = "trunks" | "trunk_width" | "lean_deg" | "bare_height" | "first_fork";
/** Colours of it, such as "#5c8336". */
export type Tint = "leaf" | "bark";
/** What is otherwise in a picture than it is read: keys of `reading.json`, and short ones. */
export interface Corrections extends Partial<Record<Told, number>> {
  colors?: Partial<Record<Tint, string>>;
}

/** What is in a picture of a tree; lengths are in heights of the tree. */
export interface Look {
  found: {
    feet: { x: number; width: number }[];
    /** Points of the trunk's axis: x, y, width. */
    trunk: [number, number, number][];
    lean_deg: number | null;
    first_fork: number | null;
    fork_x: number | null;
    fork_arms_deg: number[];
    bare_height: number | null;
    crown: { left: number[]; right: number[] };
    colors: (Record<Tint, string | null> & { leaves: boolean | null }) | null;
  };
  /** Names, values in words, confidences. */
  table: [string, string, number][];
  /** Where the tree stands in pixels: the column of x = 0, the row of y = 0, and rows of one height. */
  anchor: { origin: number; ground: number; height: number } | null;
  /** One byte per pixel, 1 for wood and 2 for foliage; empty of a picture without colours. */
  layers: Uint8Array<ArrayBuffer>;
}
/** Scores of a tree against the goal: keys of the library's score card. */
export interface Card {
  likeness: number;
  likeness_parts: { mass: number; rim: number; strokes: number; gaps: number };
  iou: number;
  best_ellipse_iou: number;
  pixel_accuracy: number;
  empty_accuracy: number;
  dice: number;
  boundary_f: number;
}
/** Options of a fit: keys and words of the library's `FitOptions`. What is left out has its default. */
export interface FitOptions {
  height?: number;
  /** One family, "trees" for those of natural trees, or "auto" for all; without it the library chooses by the picture. */
  generator?: string;
  /** Seconds for the whole fit. */
  timeout?: number;
  evaluations?: number;
  seed?: number;
  leaves?: "auto" | "on" | "off";
  /** Trees of different seeds that each kind is scored by. */
  robust?: number;
  /** How long this very tree is looked for, after its kind. */
  individual?: "share" | "off";
  reading?: Corrections;
}
export interface LooksLike {
  species: string;
  confidence: number;
}
export interface Guess {
  looks_like: LooksLike[];
  leaves: boolean;
  species: string;
}
/** A short search of one generator: several of them, of one family or of more, race for a goal. */
export interface Leg {
  recipe: Uint8Array<ArrayBuffer>;
  /** Of the generator. */
  family: string;
  /** The known species that its trees are nearest to. */
  species: string;
  /** Its number in its round, from 1. */
  number: number;
  count: number;
}
export interface FitProgress {
  evaluations: number;
  generation: number;
  /** Null until the first trees are scored. */
  cost: number | null;
  iou: number | null;
  likeness: number | null;
  used: number | null;
  ended: string | null;
}
/** A tree over the goal, one byte per pixel, and its species file. */
export interface DrawnTree {
  ink: Uint8Array<ArrayBuffer>;
  toml: string;
}
export interface FitStep {
  pieces: Uint8Array<ArrayBuffer>[];
  progress: FitProgress;
  /** The best so far, when it was asked for and is another than before. */
  best: DrawnTree | null;
}
export type Seen = "determined" | "loosely" | "not-seen" | "not-tried";
interface Spread {
  mean: number;
  sd: number;
}
export interface Reference {
  likeness: number;
  iou: number;
}
export interface References {
  species: string | null;
  same_species: Reference | null;
  other_species: Reference | null;
  best_ellipse: Reference;
}
/** What the page shows of the library's `FitReport`: the same keys as the program's `summary.json`. */
export interface FitReport extends Card {
  species: string;
  /** Words for what to do next, the most promising first; fits of earlier versions have none. */
  next?: string[] | undefined;
  fresh_seeds: { count: number; likeness: Spread; iou: Spread } | null;
  individual: (Card & { stems: number }) | null;
  references: References | null;
  /** In what the tree differs from the goal, the largest difference first. */
  readings: { differences: { measure: string; size: number; words: string }[] };
  parameters: FittedParameter[];
  /** The trees that the intervals of the parameters are learnt from; null where nothing is known of such trees. */
  intervals: { species: string; is_familiar: boolean } | null;
}
/** A number of a fitted species, and what its picture says of it. */
export interface FittedParameter {
  slot: string;
  value: number;
  seen: Seen;
  /** Nine in ten trees whose pictures look like the goal have the number in it. */
  interval: { low: number; high: number } | null;
}
export interface FitResult {
  report: FitReport;
  verdict: string | null;
  /** The species file of the kind. */
  toml: string;
  /** That of this very tree. */
  own_toml: string | null;
}
export interface FoundTrees {
  ink: Uint8Array<ArrayBuffer>;
  /** This very tree, where it was looked for. */
  ownInk: Uint8Array<ArrayBuffer> | null;
}
export type Layout = "numbers" | "looks";
export interface Plane {
  dots: { name: string; x: number; y: number }[];
  hull: [number, number][];
  box: [number, number, number, number];
  explained: number[];
  axes: string[][];
  /** Pieces of lines, and how many choices switch there. */
  switches: [[number, number], [number, number], number][];
}
export interface PointAbout {
  weights: [string, number][];
  outside: number;
  toml_comments: string[];
}
interface At {
  layout: Layout;
  x: number;
  y: number;
}

export type MeshFormat = "glb" | "obj" | "ply" | "stl" | "usda";
/** Options of a mesh file: keys and words of the library's `Export`. What is left out has its default. */
export interface ExportOptions {
  finest?: boolean;
  /** So many levels of fixed coarseness. */
  lod?: number;
  /** Only this one, counted from 0. */
  level?: number;
  triangles?: readonly number[];
  billboard?: number;
  textures?: number;
  leaves?: string;
  season?: string | null;
  wind?: boolean;
  growth?: boolean;
  /** Convex pieces that things bump into. */
  collision?: boolean;
}
export interface NamedFile {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

/** A tree of a zip; `stem` is the name of its files without the suffix. */
export interface ZipTree {
  spec: Spec;
  seed: number;
  stem: string;
}
export interface Zipped {
  zip: Blob;
  /** Of all trees; null where that is no look into a file. */
  triangles: number | null;
  /** What the user is to be told, each once. */
  notes: string[];
}

/** Every operation: what goes in, what comes out. */
export interface Ops {
  open: { in: Spec; out: OpenedSpecies };
  active: { in: Spec; out: boolean[] };
  /** The species with another grammar. */
  grammar: { in: { spec: Spec; text: string }; out: EditedGrammar };
  /** The text of a species between two: at 0 the first, at 1 the second. */
  blend: { in: { from: Spec; to: Spec; at: number; name: string }; out: string };
  dice: { in: { spec: Spec; seed: number; locked: Uint8Array; strength: number }; out: number[] };
  toml: { in: { spec: Spec; name: string | null; treeSeed: number | null }; out: string };
  silhouette: {
    in: { spec: Spec; seed: number; size: number; coarse: boolean };
    out: Ink & { stats: TreeStats };
  };
  /** With at most `most` vertices: a coarser level where the one that is asked for has more. */
  mesh: {
    in: { spec: Spec; seed: number; season: string; leaves: string; level: number; most: number };
    out: MeshData;
  };
  /** The same for a species file, with leaves on cards that show the pictures of its GLB file. */
  picturedMesh: { in: { source: SpeciesSource; level: number; most: number }; out: PicturedMesh };
  cardPictures: { in: { spec: Spec; seed: number; season: string }; out: CardPicture[] };
  picture: {
    in: { spec: Spec; seed: number; season: string; size: number; azimuth: number; elevation: number };
    out: Picture;
  };
  /**
   * The mesh file first, then the files that it names, and what the user is to be told, if anything. `stem` is the
   * file's name without the suffix.
   */
  export: {
    in: { spec: Spec; seed: number; format: MeshFormat; stem: string; options: ExportOptions };
    out: { files: NamedFile[]; note: string };
  };
  zip: {
    in: { trees: readonly ZipTree[]; format: MeshFormat; options: ExportOptions };
    out: Zipped;
  };
  /** Files that are packed as they are. */
  pack: { in: readonly NamedFile[]; out: Blob };
  goalRead: {
    in: { name: string; bytes: Uint8Array; mask: MaskWay; hints: MaskHints };
    out: GoalData;
  };
  goalCheck: { in: GoalPixels; out: GoalInfo };
  goalLook: {
    in: { goal: GoalPixels; photo: Uint8Array | null; corrections: Corrections };
    out: Look;
  };
  mapPlane: { in: Layout; out: Plane };
  /** "bare" grows no leaves, "coarse" draws few of them. */
  mapTree: { in: At & { size: number; detail: "bare" | "coarse" | "full" }; out: Ink };
  mapAbout: { in: At; out: PointAbout };
  mapToml: { in: At & { name: string }; out: string };
  fitCompare: { in: { goal: GoalPixels; options: FitOptions; drawings: Uint8Array | null }; out: null };
  /** The next search of the race between generators; null once it is over, and where there is none. */
  fitLeg: { in: null; out: Leg | null };
  /** Ends the race. The recipe is that of the search. */
  fitBegin: { in: null; out: { guess: Guess; recipe: Uint8Array<ArrayBuffer> } };
  fitStep: {
    /** No trees are asked for with 0 workers. */
    in: { scores: Uint8Array[]; workers: number; elapsed: number; best: boolean };
    out: FitStep;
  };
  /** With the trees that were found, over the goal. */
  fitFinish: { in: null; out: FoundTrees & { result: FitResult } };
  evaluator: { in: Uint8Array; out: null };
  evaluate: { in: Uint8Array; out: Uint8Array<ArrayBuffer> };
}
export type Op = keyof Ops;

export type Progress = { stage: string; done?: number; all?: number; nearest?: DrawnTree };

export interface Request<K extends Op = Op> {
  id: number;
  op: K;
  input: Ops[K]["in"];
}
export type ToWorker = { module: WebAssembly.Module } | Request;
export type FromWorker =
  | { kind: "done"; id: number; value: unknown; ms: number }
  | { kind: "failed"; id: number; message: string; line: number | null; fatal: boolean }
  | { kind: "progress"; id: number; progress: Progress };
