// What a fit leaves: trees of other seeds, what the picture says of the parameters, and where to take it.
import type { JSX } from "preact";
import { treeClient } from "../../engine/clients";
import type { Seen, Spec } from "../../engine/protocol";
import { keepSpecies } from "../../state/library";
import { sayError } from "../../state/notes";
import { go } from "../../state/route";
import { openSource, start } from "../../state/species";
import { Button } from "../../ui/controls";
import { canvasPng, download, fileName } from "../../ui/files";
import { show } from "../../ui/ink";
import { Thumb } from "../../ui/thumb";
import { BUDGETS, optionsFor, saveMesh } from "../species/exports";
import { result, shownTree } from "./fit-state";

interface Found {
  readonly name: string;
  readonly toml: string;
}

const specOf = ({ toml, name }: Found): Spec => ({ source: { toml, name }, values: null });

const PICTURE = 1024;

async function exportMesh(fit: Found, format: "glb" | "obj"): Promise<void> {
  const spec = specOf(fit);
  const { info } = await openSource(spec.source);
  const options = optionsFor(format, BUDGETS[0], { wind: true });
  await saveMesh(fileName(fit.name, format), { spec, seed: info.tree_seed ?? 1, format, options });
}

async function exportPicture(fit: Found): Promise<void> {
  const spec = specOf(fit);
  const { info } = await openSource(spec.source);
  const input = { spec, seed: info.tree_seed ?? 1, season: "", size: PICTURE, azimuth: 0, elevation: 0 };
  const picture = await treeClient.call("picture", input);
  const canvas = document.createElement("canvas");
  show(canvas, new ImageData(new Uint8ClampedArray(picture.rgba.buffer), picture.size, picture.size));
  download(fileName(fit.name, "png"), await canvasPng(canvas));
}

export function Outcome(): JSX.Element | null {
  const fit = shownTree.value;
  const found = result.value;
  if (!fit || !found) return null;
  const kind = specOf({ name: fit.name, toml: found.toml });
  const edit = () =>
    start(specOf(fit).source)
      .then(() => go("species"))
      .catch(sayError);
  return (
    <section class="outcome" aria-label="Outcome">
      <div class="takeaway">
        <Button
          icon="keep"
          label="Keep as species"
          kind="primary"
          onPress={() => keepSpecies(fit.name, fit.toml)}
        />
        <Button icon="edit" label="Edit" onPress={() => void edit()} testid="edit-fit" />
        <Button
          icon="download"
          label="TOML"
          testid="fit-toml"
          onPress={() => download(fileName(fit.name, "toml"), fit.toml, "application/toml")}
        />
        <Button icon="download" label="GLB" onPress={() => void exportMesh(fit, "glb").catch(sayError)} />
        <Button icon="download" label="OBJ" onPress={() => void exportMesh(fit, "obj").catch(sayError)} />
        <Button icon="download" label="PNG" onPress={() => void exportPicture(fit).catch(sayError)} />
      </div>
      <h3>Eight more of the kind</h3>
      <ul class="strip eight">
        {Array.from({ length: 8 }, (_, at) => at + 2).map((seed) => (
          <li key={seed}>
            <button
              type="button"
              title="Open this tree in the species room"
              onClick={() =>
                void start(kind.source, { seed })
                  .then(() => go("species"))
                  .catch(sayError)
              }
            >
              <Thumb spec={kind} seed={seed} season="" size={144} name={`Seed ${seed}`} />
              <span>Seed {seed}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

const SEEN: readonly { seen: Seen; title: string; what: string }[] = [
  { seen: "determined", title: "Determined", what: "The picture fixes these." },
  { seen: "loosely", title: "Loosely", what: "The picture allows a wide range." },
  { seen: "not-seen", title: "Not seen", what: "The picture says nothing of these." },
  { seen: "not-tried", title: "Not searched", what: "These stayed as they were." },
];

export function Determined(): JSX.Element | null {
  const parameters = result.value?.report.parameters ?? [];
  if (parameters.length === 0) return null;
  return (
    <section class="card determined" aria-label="What the picture determines">
      <h3>What the picture determines</h3>
      {SEEN.map(({ seen, title, what }, at) => {
        const slots = parameters.filter((each) => each.seen === seen);
        if (slots.length === 0) return null;
        return (
          <details key={seen} open={at === 0}>
            <summary>
              <span class={`mark-${seen}`} aria-hidden="true" />
              {title} <span class="count">{slots.length}</span>
            </summary>
            <p class="hint">{what}</p>
            <ul class="slots">
              {slots.map(({ slot, value }) => (
                <li key={slot}>
                  <code>{slot}</code> {Number(value.toPrecision(4))}
                </li>
              ))}
            </ul>
          </details>
        );
      })}
    </section>
  );
}
