// The recipe in the link: the species by name with what was changed, or its whole file.
import type { SpeciesSource } from "../engine/protocol";
import { packText, unpackText } from "./codec";
import type { Linked } from "./route";
import { FIRST, opened, openSource, type Recipe, recipes } from "./species";

/** `length[1]` as `length.1`, which needs no escape in a link. */
const short = (slot: string) => slot.replace("[", ".").replace("]", "");

/** The file that was packed last: a link is written again with each step of a slider. */
let packed: { toml: string; text: Promise<string> } | null = null;

function pack(toml: string): Promise<string> {
  if (packed?.toml !== toml) packed = { toml, text: packText(toml) };
  return packed.text;
}

function changes(recipe: Recipe): string {
  const known = opened.value;
  if (!known || !recipe.values) return "";
  return known.declared
    .flatMap((parameter) => parameter.slots)
    .filter((slot) => recipe.values?.[slot.index] !== known.values[slot.index])
    .map((slot) => `${short(slot.slot)}:${recipe.values?.[slot.index]}`)
    .join(",");
}

async function applied(source: SpeciesSource, text: string): Promise<readonly number[] | null> {
  if (!text) return null;
  const known = await openSource(source);
  const slots = new Map(
    known.declared.flatMap((each) => each.slots).map((slot) => [short(slot.slot), slot.index]),
  );
  const values = [...known.values];
  for (const each of text.split(",")) {
    const at = each.lastIndexOf(":");
    const index = slots.get(each.slice(0, at));
    const value = Number(each.slice(at + 1));
    if (index === undefined || !Number.isFinite(value)) {
      throw new Error(
        `The link changes ${each.slice(0, 60)}, which this species does not have: the rest was opened.`,
      );
    }
    values[index] = value;
  }
  return values;
}

/** The hash that opens a species in the species room, in this season; "" is its own. */
export async function linkTo(source: SpeciesSource, season: string): Promise<string> {
  const fields = new URLSearchParams();
  await writeSource(fields, source);
  const { info } = await openSource(source);
  if (info.tree_seed !== null && info.tree_seed !== 1) fields.set("seed", String(info.tree_seed));
  if (season) fields.set("season", season);
  return `#species?${fields}`;
}

async function writeSource(fields: URLSearchParams, source: SpeciesSource): Promise<void> {
  if ("builtin" in source) {
    fields.set("s", source.builtin);
    return;
  }
  fields.set("n", source.name);
  fields.set("t", await pack(source.toml));
}

export const speciesLink: Linked = {
  async write(fields) {
    const recipe = recipes.value;
    const changed = changes(recipe);
    if (recipe === FIRST) return;
    if ("builtin" in recipe.source) fields.set("s", recipe.source.builtin);
    else fields.set("n", recipe.source.name);
    if (changed) fields.set("v", changed);
    if (recipe.seed !== 1) fields.set("seed", String(recipe.seed));
    if (recipe.season) fields.set("season", recipe.season);
    if ("toml" in recipe.source) fields.set("t", await pack(recipe.source.toml));
  },

  async read(fields) {
    const builtin = fields.get("s");
    const toml = fields.get("t");
    if (builtin === null && toml === null) return;
    const source: SpeciesSource =
      toml === null
        ? { builtin: builtin ?? "acer" }
        : { toml: await unpackText(toml), name: fields.get("n") ?? "species" };
    const seed = Number(fields.get("seed") ?? 1);
    const recipe: Recipe = {
      source,
      values: null,
      seed: Number.isSafeInteger(seed) && seed >= 0 ? seed : 1,
      season: fields.get("season") ?? "",
    };
    await openSource(source);
    const same =
      JSON.stringify(recipes.peek()) === JSON.stringify({ ...recipe, values: recipes.peek().values });
    try {
      recipe.values = await applied(source, fields.get("v") ?? "");
    } finally {
      const before = recipes.peek();
      const unchanged = same && JSON.stringify(before.values) === JSON.stringify(recipe.values);
      if (!unchanged) {
        if (before === FIRST) recipes.reset(recipe);
        else recipes.push(recipe);
      }
    }
  },
};
