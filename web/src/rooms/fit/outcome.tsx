// What a fit leaves: where to take its tree, and what the picture says of the parameters.
import type { JSX } from "preact";
import { fileClient } from "../../engine/clients";
import type { FitReport, FittedParameter, Seen, Spec } from "../../engine/protocol";
import { keepSpecies } from "../../state/library";
import { say, sayError } from "../../state/notes";
import { go } from "../../state/route";
import { openSource, start } from "../../state/species";
import { linkTo } from "../../state/species-link";
import { copyText } from "../../ui/clipboard";
import { Button } from "../../ui/controls";
import { cost } from "../../ui/cost";
import { canvasPng, download, fileName } from "../../ui/files";
import { show } from "../../ui/ink";
import { BUDGETS, optionsFor, saveMesh, sizeOf } from "../species/exports";
import { Turntable } from "../species/turntable";
import { keepFit } from "./kept-fits";
import { isOf, model, modelOf, season, wanted } from "./model-state";
import { result, shownTree } from "./record";

interface Found {
  readonly name: string;
  readonly toml: string;
}

const specOf = ({ toml, name }: Found): Spec => ({ source: { toml, name }, values: null });

const PICTURE = 1024;

/** The file that is shown: it is written once. */
async function exportGlb(): Promise<void> {
  const of = wanted.peek();
  if (!of) return;
  const { name, bytes, note } = await modelOf(of);
  if (note) say(note);
  download(name, bytes, "model/gltf-binary");
}

async function exportObj(fit: Found): Promise<void> {
  const spec = specOf(fit);
  const { info } = await openSource(spec.source);
  const options = optionsFor("obj", BUDGETS[0], { season: season.peek() || null });
  const name = fileName(fit.name, "obj");
  const files = await saveMesh(name, { spec, seed: info.tree_seed ?? 1, format: "obj", options });
  say(`${name} is written: ${sizeOf(files)}.`);
}

async function copyTree(fit: Found): Promise<void> {
  const hash = await linkTo(specOf(fit).source, season.peek());
  await copyText(
    new URL(hash, location.href).href,
    "The link to this tree is copied. It does not have your picture.",
  );
}

async function exportPicture(fit: Found): Promise<void> {
  const spec = specOf(fit);
  const { info } = await openSource(spec.source);
  const input = {
    spec,
    seed: info.tree_seed ?? 1,
    season: season.peek(),
    size: PICTURE,
    azimuth: 0,
    elevation: 0,
  };
  const picture = await fileClient.call("picture", input);
  const canvas = document.createElement("canvas");
  show(canvas, new ImageData(new Uint8ClampedArray(picture.rgba.buffer), picture.size, picture.size));
  download(fileName(fit.name, "png"), await canvasPng(canvas));
}

/** Where the tree that is shown can be taken. */
export function TakeAway(): JSX.Element | null {
  const fit = shownTree.value;
  if (!fit) return null;
  const of = wanted.value;
  const file = of && isOf(model.value, of) ? model.value : null;
  const edit = () =>
    start(specOf(fit).source, { season: season.peek() })
      .then(() => go("species"))
      .catch(sayError);
  return (
    <div class="takeaway">
      <Button
        icon="keep"
        label="Keep as species"
        kind="primary"
        onPress={() => keepSpecies(fit.name, fit.toml)}
      />
      <Button
        icon="keep"
        label="Keep this fit"
        title="With its goal, in your fits below: to go on with it or to compare it."
        testid="keep-fit"
        onPress={() => void keepFit().catch(sayError)}
      />
      <Button
        icon="link"
        label="Copy its link"
        title="A link that opens this tree in the species room. It has the species, and not your picture."
        testid="fit-link"
        onPress={() => void copyTree(fit).catch(sayError)}
      />
      <Button icon="edit" label="Edit" onPress={() => void edit()} testid="edit-fit" />
      <Button
        icon="download"
        label="TOML"
        testid="fit-toml"
        onPress={() => download(fileName(fit.name, "toml"), fit.toml, "application/toml")}
      />
      <Button
        icon="download"
        label={file ? `GLB, ${cost(file.triangles, file.bytes.length)}` : "GLB"}
        testid="fit-glb"
        onPress={() => void exportGlb().catch(sayError)}
      />
      <Button icon="download" label="OBJ" onPress={() => void exportObj(fit).catch(sayError)} />
      <Button icon="download" label="PNG" onPress={() => void exportPicture(fit).catch(sayError)} />
      <Turntable name={fit.name} />
    </div>
  );
}

const SEEN: readonly { seen: Seen; title: string; what: string }[] = [
  { seen: "determined", title: "Determined", what: "The picture tells most about these." },
  { seen: "loosely", title: "Loosely", what: "The picture allows a wide range." },
  { seen: "not-seen", title: "Not seen", what: "The picture says little or nothing of these." },
  { seen: "not-tried", title: "Not tried", what: "There was no time for these." },
];

/** A number with the interval in which nine in ten trees have it that look so. */
function told({ value, interval }: FittedParameter): string {
  const short = (number: number): string => String(Number(number.toPrecision(3)));
  const range = interval ? ` (${short(interval.low)} to ${short(interval.high)})` : "";
  return Number(value.toPrecision(4)) + range;
}

/** What the intervals are true for, or why there are none. */
function Trust({ of }: { of: FitReport["intervals"] }): JSX.Element | null {
  if (!of) return null;
  const trees = `trees around ${of.species.replaceAll("_", " ")}`;
  return (
    <p class="hint">
      {of.is_familiar
        ? `In brackets: where nine in ten ${trees} that look so have the number.`
        : `The picture is unlike those of ${trees}, so there are no intervals.`}
    </p>
  );
}

export function Determined(): JSX.Element | null {
  const parameters = result.value?.report.parameters ?? [];
  if (parameters.length === 0) return null;
  return (
    <section class="card determined" aria-label="What the picture determines">
      <h3>What the picture determines</h3>
      <Trust of={result.value?.report.intervals ?? null} />
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
              {slots.map((each) => (
                <li key={each.slot}>
                  <code>{each.slot}</code> {told(each)}
                </li>
              ))}
            </ul>
          </details>
        );
      })}
    </section>
  );
}
