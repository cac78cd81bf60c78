// The panel of the fit room: goal, brush, and what the search does.
import type { JSX } from "preact";
import { keepSpecies } from "../../state/library";
import { Alert, Bar, Button, Field, Segmented } from "../../ui/controls";
import { ChooseButton, TargetSelect } from "./chooser";
import {
  bestToml,
  elapsed,
  failure,
  guess,
  pauseFit,
  phase,
  progress,
  rate,
  resumeFit,
  running,
  seconds,
  stage,
  startFit,
  stopFit,
} from "./fit-state";
import { brush, brushSize } from "./goal-editor";
import {
  canReadAgain,
  goalError,
  info,
  masks,
  picture,
  readAgain,
  reading,
  redoMask,
  setMask,
  undoMask,
} from "./goal-state";
import { MeasuresPart } from "./measures";
import { SearchPart } from "./search-part";

function GoalPart(): JSX.Element {
  const found = info.value;
  const busy = running.value || reading.value !== null;
  return (
    <section class="part" aria-label="Goal">
      <h3>Goal</h3>
      <div class="row wrap">
        <ChooseButton primary={false} />
        <TargetSelect disabled={busy} />
      </div>
      {found && (
        <p class="facts">
          <strong>{picture.value?.name.replaceAll("_", " ")}</strong> · {found.width} × {found.height} ·{" "}
          {found.masked
            ? `a tree found in a photograph${found.confidence === null ? "" : `, ${Math.round(found.confidence * 100)} % sure`}`
            : "a silhouette"}
        </p>
      )}
      {found?.warnings.map((warning) => (
        <p key={warning} class="warning">
          {warning}
        </p>
      ))}
      {found && canReadAgain() && (
        <Button
          kind="quiet"
          label={found.masked ? "Take the dark pixels instead" : "Look for a tree in a photograph"}
          disabled={busy}
          onPress={() => void readAgain(found.masked ? "off" : "photo")}
        />
      )}
      <div class="row wrap">
        <Segmented
          label="Brush"
          value={brush.value}
          disabled={running.value}
          options={[
            { value: "add", label: "Add" },
            { value: "take", label: "Take away" },
            { value: "box", label: "Box" },
            { value: "measures", label: "Measures" },
          ]}
          onPick={(picked) => {
            brush.value = picked;
          }}
        />
        <Button
          icon="undo"
          iconOnly
          label="Undo the brush"
          disabled={busy || !masks.canUndo.value}
          onPress={undoMask}
          testid="undo-mask"
        />
        <Button
          icon="redo"
          iconOnly
          label="Redo the brush"
          disabled={busy || !masks.canRedo.value}
          onPress={redoMask}
        />
      </div>
      {brush.value === "box" && (
        <p class="hint">Drag a box around all of the tree: it is then looked for inside.</p>
      )}
      {brush.value === "measures" && <MeasuresPart />}
      <Field label="Brush size">
        {(id) => (
          <input
            id={id}
            type="range"
            min={1}
            max={30}
            step={0.5}
            value={brushSize.value}
            onInput={(event) => {
              brushSize.value = event.currentTarget.valueAsNumber;
            }}
          />
        )}
      </Field>
      {(masks.value.ground !== null || masks.value.axis !== null) && (
        <Button
          kind="quiet"
          label="Find ground and trunk again"
          disabled={busy}
          onPress={() => setMask({ ground: null, axis: null })}
        />
      )}
    </section>
  );
}

function Running(): JSX.Element | null {
  const now = progress.value;
  if (!running.value) return null;
  const searching = phase.value === "searching" || phase.value === "paused";
  return (
    <div class="running">
      <p class="stagename">
        {phase.value === "paused" ? "Paused" : searching ? "Searching" : stage.value.text || "Starting"}
      </p>
      <Bar
        label="Progress of the fit"
        share={searching ? Math.min(1, now?.used ?? elapsed.value / seconds.value) : stage.value.share}
      />
      {searching && now && (
        <dl class="livenumbers">
          <div>
            <dt>Likeness</dt>
            <dd data-testid="likeness">{now.likeness?.toFixed(3) ?? "…"}</dd>
          </div>
          <div>
            <dt>Trees</dt>
            <dd>{now.evaluations}</dd>
          </div>
          <div>
            <dt>Trees a second</dt>
            <dd>{rate.value === null ? "…" : Math.round(rate.value)}</dd>
          </div>
          <div>
            <dt>Seconds</dt>
            <dd>{elapsed.value.toFixed(0)}</dd>
          </div>
        </dl>
      )}
    </div>
  );
}

function Kin(): JSX.Element | null {
  const seen = guess.value;
  if (!seen) return null;
  return (
    <p class="kin">
      Looks like{" "}
      {seen.looks_like.slice(0, 3).map(({ species, confidence }, at) => (
        <span key={species}>
          {at > 0 && ", "}
          <strong>{species.replaceAll("_", " ")}</strong> {Math.round(confidence * 100)} %
        </span>
      ))}
      , {seen.leaves ? "leafy" : "bare"}.
    </p>
  );
}

function keepBest(): void {
  const toml = bestToml.peek();
  if (toml !== null) keepSpecies(`${picture.peek()?.name ?? "fit"} so far`, toml);
}

export function Controls(): JSX.Element {
  const state = phase.value;
  return (
    <>
      <div class="panelbody">
        {reading.value && (
          <p class="reading" role="status">
            Reading {reading.value} …
          </p>
        )}
        {goalError.value && <Alert text={goalError.value} />}
        <GoalPart />
        <SearchPart />
      </div>
      <footer class="panelfoot">
        {failure.value && <Alert text={failure.value} />}
        <Kin />
        <Running />
        <div class="row">
          {!running.value && (
            <Button
              icon="play"
              kind="primary"
              label={state === "done" ? "Fit again" : "Fit"}
              disabled={picture.value === null || reading.value !== null}
              onPress={() => void startFit()}
              testid="start"
            />
          )}
          {state === "searching" && <Button icon="pause" label="Pause" onPress={pauseFit} testid="pause" />}
          {state === "paused" && (
            <Button icon="play" label="Go on" kind="primary" onPress={resumeFit} testid="resume" />
          )}
          {running.value && (
            <Button
              icon="stop"
              label={state === "searching" || state === "paused" ? "Stop" : "Cancel"}
              onPress={stopFit}
              testid="stop"
            />
          )}
          {bestToml.value !== null && state !== "judging" && (
            <Button
              icon="keep"
              iconOnly
              kind="quiet"
              label="Keep the best so far as a species"
              onPress={keepBest}
            />
          )}
        </div>
      </footer>
    </>
  );
}
