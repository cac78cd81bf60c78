// Eight trees of a fit in one zip: the one that is shown, and seven others of its kind.
import { useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import type { MeshFormat, ZipTree } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import { openSource } from "../../state/species";
import { BUDGETS, type Budget, optionsFor, TEXTURES, type Textures } from "../species/exports";
import { DetailChoice, FormatChoice, TexturesChoice } from "../species/file-choices";
import { ZipDetails, ZipPart } from "../species/zip-part";
import { MANY, otherSeeds } from "../species/zip-state";
import { season } from "./model-state";
import { result, shownTree } from "./record";

/** No view has levels of its own here. */
const DETAILS = BUDGETS.filter(({ id }) => id !== "view");

/** The tree that is shown, and others of its kind that have other seeds. */
async function treesNow(): Promise<readonly ZipTree[]> {
  const [found, shown] = [result.peek(), shownTree.peek()];
  if (!found || !shown) return [];
  const { toml, name } = shown;
  const seedOf = async (text: string) =>
    (await openSource({ toml: text, name: found.report.species })).info.tree_seed ?? 1;
  const spec = { source: { toml, name }, values: null };
  const first = { spec, seed: await seedOf(toml), stem: name };
  const kind = { source: { toml: found.toml, name: found.report.species }, values: null };
  const others = otherSeeds(first.seed, MANY - 1);
  return [first, ...others.map((seed) => ({ spec: kind, seed, stem: `${found.report.species}-${seed}` }))];
}

function Inside(): JSX.Element {
  const format = useSignal<MeshFormat>("glb");
  const budget = useSignal<Budget>(BUDGETS[0]);
  const textures = useSignal<Textures>(TEXTURES[0]);
  const trees = useSignal<readonly ZipTree[]>([]);
  useSignalEffect(() => {
    const of = shownTree.value;
    treesNow()
      .then((found) => {
        if (of === shownTree.peek()) trees.value = found;
      })
      .catch(sayError);
  });
  const asked = { wind: true, season: season.value || null, textures: textures.value };
  const options = optionsFor(format.value, budget.value, asked);
  const name = shownTree.value?.name ?? "trees";
  return (
    <>
      <FormatChoice
        value={format.value}
        onPick={(picked) => {
          format.value = picked;
        }}
      />
      <DetailChoice
        label="Detail of GLB, OBJ and USDA"
        budgets={DETAILS}
        value={budget.value}
        onPick={(picked) => {
          budget.value = picked;
        }}
      />
      <TexturesChoice
        value={textures.value}
        onPick={(picked) => {
          textures.value = picked;
        }}
      />
      {trees.value.length > 0 && (
        <ZipPart
          job={{ name, trees: trees.value, format: format.value, options }}
          what="The tree that is shown and seven others of its kind, in the season that is shown."
        />
      )}
    </>
  );
}

export function EightTrees(): JSX.Element | null {
  return result.value && <ZipDetails>{() => <Inside />}</ZipDetails>;
}
