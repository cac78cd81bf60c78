// Two kept fits side by side.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Card } from "../../engine/protocol";
import { sentence } from "../../state/notes";
import { openSource } from "../../state/species";
import { Alert } from "../../ui/controls";
import { BOTH, inkImage, overlayImage, show } from "../../ui/ink";
import { Thumb } from "../../ui/thumb";
import { type Differences, differences } from "./difference";
import { type KeptFit, loadWhole } from "./kept-fits";
import { type StoredFit, unpackInks } from "./stored-fit";

/** What is shown of one fit. */
interface Side {
  fit: StoredFit;
  inks: Awaited<ReturnType<typeof unpackInks>>;
  /** The tree that is meant: this very tree, or the kind. */
  tree: { toml: string; card: Card; seed: number };
}

async function sideOf(entry: KeptFit): Promise<Side> {
  const { fit } = loadWhole(entry);
  const { report, toml: kind, own_toml: own } = fit.result;
  const isOwn = own !== null && report.individual !== null && fit.ownInk !== null;
  const toml = isOwn ? own : kind;
  const { info } = await openSource({ toml, name: report.species });
  const card = (isOwn && report.individual) || report;
  return { fit, inks: await unpackInks(fit), tree: { toml, card, seed: info.tree_seed ?? 1 } };
}

function Picture({ image, label }: { image: ImageData; label: string }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (canvas.current) show(canvas.current, image);
  }, [image]);
  return <canvas ref={canvas} role="img" aria-label={label} />;
}

function Column({ name, fit, inks, tree }: Side & { name: string }): JSX.Element {
  const { width, height, result } = fit;
  const spec = { source: { toml: tree.toml, name: result.report.species }, values: null };
  return (
    <div class="side">
      <h4>{name}</h4>
      <div class="pictures">
        <figure>
          <Picture image={inkImage(inks.goal, width, height, BOTH)} label={`Goal of ${name}`} />
          <figcaption>Goal</figcaption>
        </figure>
        <figure>
          <Picture
            image={overlayImage(inks.goal, inks.ownInk ?? inks.ink, width, height)}
            label={`Goal in blue and tree in orange, ${name}`}
          />
          <figcaption>Both</figcaption>
        </figure>
        <figure>
          <Thumb spec={spec} seed={tree.seed} season="" size={224} name={`Tree of ${name}`} />
          <figcaption>Tree</figcaption>
        </figure>
      </div>
      {result.verdict && <p class="verdict">{result.verdict}.</p>}
    </div>
  );
}

const SCORES: readonly { key: "likeness" | "iou" | "boundary_f"; label: string }[] = [
  { key: "likeness", label: "Likeness" },
  { key: "iou", label: "IoU" },
  { key: "boundary_f", label: "Outline" },
];

/** So many numbers are shown. */
const SHOWN = 8;

interface Compared {
  sides: [Side, Side];
  found: Differences;
}

function Numbers({ names, sides: [one, other], found }: Compared & { names: [string, string] }): JSX.Element {
  return (
    <table class="references">
      <thead>
        <tr>
          <th scope="col">Number</th>
          <th scope="col">{names[0]}</th>
          <th scope="col">{names[1]}</th>
        </tr>
      </thead>
      <tbody>
        {SCORES.map(({ key, label }) => (
          <tr key={key}>
            <th scope="row">{label}</th>
            <td>{one.tree.card[key].toFixed(2)}</td>
            <td>{other.tree.card[key].toFixed(2)}</td>
          </tr>
        ))}
        <tr>
          <th scope="row">Species</th>
          <td>{one.fit.result.report.species.replaceAll("_", " ")}</td>
          <td>{other.fit.result.report.species.replaceAll("_", " ")}</td>
        </tr>
        {found.list.slice(0, SHOWN).map(({ slot, values }) => (
          <tr key={slot}>
            <th scope="row">
              <code>{slot}</code>
            </th>
            <td>{values[0]}</td>
            <td>{values[1]}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** What the numbers below the scores are. */
function note({ families, list }: Differences): string {
  if (families) {
    return `The first is of the family ${families[0]}, the second of ${families[1]}: their numbers cannot be compared.`;
  }
  if (list.length === 0) return "Both have the same numbers.";
  return "The numbers that differ most, measured by what is natural for each.";
}

export function Comparison({ one, other }: { one: KeptFit; other: KeptFit }): JSX.Element {
  const section = useRef<HTMLElement>(null);
  const state = useSignal<Compared | null>(null);
  const failed = useSignal<string | null>(null);
  useEffect(() => {
    let gone = false;
    const read = async () => {
      const sides: [Side, Side] = [await sideOf(one), await sideOf(other)];
      const found = await differences(sides[0].fit, sides[1].fit);
      if (!gone) state.value = { sides, found };
    };
    failed.value = null;
    read().catch((error: unknown) => {
      if (!gone) failed.value = sentence(error);
    });
    return () => {
      gone = true;
    };
    // Entries are other objects after each change of the list, and a name changes nothing that is read.
  }, [one.id, other.id, state, failed]);
  const names: [string, string] = [one.name, other.name];
  const now = state.value;
  // It is below a list that may be long.
  useEffect(() => section.current?.scrollIntoView({ block: "nearest" }), [now]);
  return (
    <section ref={section} class="card comparison" aria-label="Comparison" data-testid="comparison">
      <h3>
        {one.name} and {other.name}
      </h3>
      {failed.value && <Alert text={failed.value} />}
      {!now && !failed.value && (
        <p class="hint" role="status">
          Reading both fits …
        </p>
      )}
      {now && (
        <>
          <div class="sides">
            <Column name={one.name} {...now.sides[0]} />
            <Column name={other.name} {...now.sides[1]} />
          </div>
          <p class="hint">{note(now.found)}</p>
          <Numbers names={names} {...now} />
        </>
      )}
    </section>
  );
}
