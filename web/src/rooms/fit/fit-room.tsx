// A picture in, a species out.
import type { JSX } from "preact";
import { Alert } from "../../ui/controls";
import { Later } from "../../ui/later";
import { Welcome } from "./chooser";
import { Controls } from "./controls";
import { goalError, picture, reading } from "./goal-state";
import { KeptFits } from "./kept-list";
import { Others } from "./others";
import { Determined } from "./outcome";
import { result } from "./record";
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
        <Later>
          <Others />
        </Later>
        {result.value && (
          <Later>
            <div class="cardsrow">
              <ScoreCard />
              <Determined />
            </div>
          </Later>
        )}
        <Later>
          <KeptFits />
        </Later>
      </div>
      <aside class="panel" aria-label="Fit">
        <Later>
          <Controls />
        </Later>
      </aside>
    </>
  );
}
