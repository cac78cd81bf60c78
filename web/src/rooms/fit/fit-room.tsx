// A picture in, a species out.
import type { JSX } from "preact";
import { Alert } from "../../ui/controls";
import { Welcome } from "./chooser";
import { Controls } from "./controls";
import { Curve } from "./curve";
import { goalError, picture, reading } from "./goal-state";
import { KeptFits } from "./kept-list";
import { Determined, Outcome } from "./outcome";
import { curve, result } from "./record";
import { ScoreCard } from "./score-card";
import { Tiles } from "./tiles";

export function FitRoom(): JSX.Element {
  if (!picture.value) {
    return (
      <div class="sheet">
        {goalError.value && <Alert text={goalError.value} />}
        {reading.value && (
          <p class="reading" role="status">
            Reading {reading.value} …
          </p>
        )}
        <Welcome />
        <KeptFits />
      </div>
    );
  }
  return (
    <>
      <div class="canvas scroll">
        <Tiles />
        {!result.value && curve.value.length > 1 && <Curve />}
        <Outcome />
        <div class="cardsrow">
          <ScoreCard />
          <Determined />
        </div>
        <KeptFits />
      </div>
      <aside class="panel" aria-label="Fit">
        <Controls />
      </aside>
    </>
  );
}
