// The score card in words.
import type { ComponentChildren, JSX } from "preact";
import type { Card, FitReport, Reference } from "../../engine/protocol";
import { Meter } from "../../ui/controls";
import { result, shownTree, shownWhich } from "./record";

/** Medians over fifteen species, from the library's documents: two seeds of a species, two species. */
const SAME_SPECIES = 0.77;
const OTHER_SPECIES = 0.44;

/** For where the library has no verdict. */
export function meaning(likeness: number): string {
  if (likeness >= 0.9) return "Very like the goal: closer than two trees of one species usually are";
  if (likeness >= SAME_SPECIES) return "Like the goal as two trees of one species are";
  if (likeness >= 0.6) return "A relative: the habit is right, some of the parts are not";
  if (likeness >= OTHER_SPECIES) return "Only as like as trees of two species are";
  return "Unlike the goal: check its mask, its ground and its height, or search longer";
}

const percent = (share: number) => `${(100 * share).toFixed(1)} %`;

const PARTS: readonly { key: keyof Card["likeness_parts"]; label: string; what: string }[] = [
  { key: "mass", label: "Mass", what: "how much ink stands where" },
  { key: "rim", label: "Rim", what: "how ragged the outline is" },
  { key: "strokes", label: "Strokes", what: "how thick stems and tufts are" },
  { key: "gaps", label: "Gaps", what: "how large the holes are" },
];

function Row({
  name,
  value,
  children,
}: {
  name: string;
  value: string;
  children: ComponentChildren;
}): JSX.Element {
  return (
    <div class="scorerow">
      <dt>{name}</dt>
      <dd>
        <strong>{value}</strong>
        <span>{children}</span>
      </dd>
    </div>
  );
}

function Fresh({ fresh }: { fresh: FitReport["fresh_seeds"] }): JSX.Element | null {
  if (!fresh) return null;
  return (
    <Row name="Other seeds" value={`${fresh.likeness.mean.toFixed(2)} ± ${fresh.likeness.sd.toFixed(2)}`}>
      likeness of {fresh.count} more trees of this species: what you get when you grow it.
    </Row>
  );
}

function References({ references }: { references: FitReport["references"] }): JSX.Element | null {
  if (!references) return null;
  const rows: readonly (readonly [string, Reference | null])[] = [
    [
      `two trees of ${references.species?.replaceAll("_", " ") ?? "the species that it looks like"}`,
      references.same_species,
    ],
    ["a tree of another species", references.other_species],
    ["the best ellipse", references.best_ellipse],
  ];
  return (
    <>
      <h4>For this goal, about</h4>
      <table class="references">
        <thead>
          <tr>
            <th scope="col">Picture</th>
            <th scope="col">Likeness</th>
            <th scope="col">IoU</th>
          </tr>
        </thead>
        <tbody>
          {rows.map(
            ([what, each]) =>
              each && (
                <tr key={what}>
                  <th scope="row">{what}</th>
                  <td>{each.likeness.toFixed(2)}</td>
                  <td>{each.iou.toFixed(2)}</td>
                </tr>
              ),
          )}
        </tbody>
      </table>
    </>
  );
}

export function ScoreCard(): JSX.Element | null {
  const fit = result.value;
  const tree = shownTree.value;
  if (!fit || !tree) return null;
  const { card } = tree;
  const own = shownWhich.value === "own";
  return (
    <section class="card score" aria-label="Score card" data-testid="score">
      <header>
        <p class="big">{card.likeness.toFixed(2)}</p>
        <div>
          <h3>Likeness</h3>
          <p>
            {own ? "How far this very tree lies on the goal." : "How like the goal a tree of its kind is."}
          </p>
        </div>
      </header>
      <p class="hint">
        1 is the same picture. Two trees of one species have about {SAME_SPECIES}, trees of two species about{" "}
        {OTHER_SPECIES}.
      </p>
      <dl class="parts">
        {PARTS.map(({ key, label, what }) => (
          <div key={key}>
            <dt>
              {label} <span>{what}</span>
            </dt>
            <dd>
              <Meter label={`${label}, ${what}`} value={card.likeness_parts[key]} />
              {card.likeness_parts[key].toFixed(2)}
            </dd>
          </div>
        ))}
      </dl>
      <dl class="scores">
        <Row name="IoU" value={card.iou.toFixed(2)}>
          the ink that both have over the ink that either has. The best ellipse has{" "}
          {card.best_ellipse_iou.toFixed(2)}.
        </Row>
        <Row name="Pixels right" value={percent(card.pixel_accuracy)}>
          an empty picture has {percent(card.empty_accuracy)}.
        </Row>
        <Row name="Outline" value={card.boundary_f.toFixed(2)}>
          how well the outlines meet, 1 is best.
        </Row>
        <Fresh fresh={fit.report.fresh_seeds} />
      </dl>
      <References references={fit.report.references} />
    </section>
  );
}
