// The panel of the fit room: goal, brush, and what the search does.
import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import { keepSpecies } from "../../state/library";
import { Alert, Bar, Button, Field, Segmented } from "../../ui/controls";
import { useFocusAfter, useUndoKeys } from "../../ui/keys";
import { Later } from "../../ui/later";
import { ChooseButton, TargetSelect } from "./chooser";
import {
  elapsed,
  failure,
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
import { brush, brushSize, pickBrush } from "./goal-editor";
import {
  canReadAgain,
  type GoalPicture,
  goalError,
  info,
  masks,
  picture,
  readAgain,
  readByStrokes,
  reading,
  redoMask,
  setMask,
  undoMask,
} from "./goal-state";
import { LookPart } from "./look-part";
import { before, bestToml, goBack, guess, outdated, result } from "./record";
import { SearchPart } from "./search-part";
import { Warning } from "./warning";

/** Where the mask is from, which painting does not change. */
function origin({ masked, confidence }: GoalPicture): string {
  if (!masked) return "a silhouette";
  const sure = confidence === null ? "" : `, ${Math.round(confidence * 100)} % sure`;
  return `a tree found in a photograph${sure}`;
}

function GoalPart(): JSX.Element {
  const found = info.value;
  const shown = picture.value;
  const back = before.value;
  const busy = running.value || reading.value !== null;
  return (
    <section class="part" aria-label="Goal">
      <h3>Goal</h3>
      <div class="row wrap">
        <ChooseButton primary={false} />
        <TargetSelect disabled={busy} />
      </div>
      {shown && (
        <p class="facts">
          <strong>{shown.name.replaceAll("_", " ")}</strong> · {shown.full.width} × {shown.full.height} ·{" "}
          {origin(shown)}
          {masks.value.painted && ", painted over"}
        </p>
      )}
      {back && (
        <Button
          kind="quiet"
          icon="undo"
          label={`Back to ${back.goal.picture.name.replaceAll("_", " ")} and its tree`}
          disabled={reading.value !== null}
          onPress={goBack}
        />
      )}
      {found?.warnings.map((warning) => (
        <Warning key={warning.message} of={warning} />
      ))}
      {shown && canReadAgain() && (
        <Button
          kind="quiet"
          label={shown.masked ? "Take the dark pixels instead" : "Look for a tree in a photograph"}
          disabled={busy}
          onPress={() => void readAgain(shown.masked ? "off" : "photo")}
        />
      )}
      <div class="row wrap" data-part="brush">
        <Segmented
          label="Brush"
          value={brush.value}
          disabled={running.value}
          options={[
            { value: "off", label: "Off" },
            { value: "add", label: "Add" },
            { value: "take", label: "Take away" },
            { value: "box", label: "Box" },
          ]}
          onPick={pickBrush}
        />
        <div class="row">
          <Button
            icon="undo"
            iconOnly
            label="Undo (Ctrl+Z)"
            disabled={busy || !masks.canUndo.value}
            onPress={undoMask}
            testid="undo-mask"
          />
          <Button
            icon="redo"
            iconOnly
            label="Redo (Ctrl+Shift+Z)"
            disabled={busy || !masks.canRedo.value}
            onPress={redoMask}
          />
        </div>
      </div>
      {brush.value === "box" && (
        <p class="hint">Drag a box around all of the tree: it is then looked for inside.</p>
      )}
      {shown?.masked && canReadAgain() && masks.value.strokes.length > 0 && (
        <Button
          label="Find the tree by these strokes"
          title="Strokes that add show the tree, strokes that take away show what is not. The mask is found again by the colours of the picture."
          disabled={busy}
          onPress={() => void readByStrokes()}
        />
      )}
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
  const isTrying = phase.value === "trying";
  const grows = isTrying || phase.value === "searching" || phase.value === "paused";
  return (
    <div class="running">
      <p class="stagename">
        {phase.value === "paused"
          ? "Paused"
          : phase.value === "searching"
            ? "Searching"
            : stage.value.text || "Starting"}
      </p>
      <Bar
        label="Progress of the fit"
        share={grows ? Math.min(1, now?.used ?? elapsed.value / seconds.value) : stage.value.share}
      />
      {grows && now && (
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
            <dd>{rate.value === null || isTrying ? "…" : Math.round(rate.value)}</dd>
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
      {seen.looks_like.length > 0 ? "Looks like " : "Looks"}
      {seen.looks_like.slice(0, 3).map(({ species, confidence }, at) => (
        <span key={species}>
          {at > 0 && ", "}
          <strong>{species.replaceAll("_", " ")}</strong> {Math.round(confidence * 100)} %
        </span>
      ))}
      {seen.looks_like.length > 0 ? ", " : " "}
      {seen.leaves ? "leafy" : "bare"}.
    </p>
  );
}

function keepBest(): void {
  const toml = bestToml.peek();
  if (toml !== null) keepSpecies(`${picture.peek()?.name ?? "fit"} so far`, toml);
}

const UNDO = {
  undo: () => running.peek() || undoMask(),
  redo: () => running.peek() || redoMask(),
};

export function Controls(): JSX.Element {
  const state = phase.value;
  const foot = useRef<HTMLElement>(null);
  useUndoKeys(UNDO);
  useFocusAfter(foot, `${state} ${reading.value}`);
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
        <Later>
          <LookPart />
        </Later>
        <Later>
          <SearchPart />
        </Later>
      </div>
      <footer class="panelfoot" ref={foot}>
        {failure.value && <Alert text={failure.value} />}
        <Kin />
        {result.value && outdated.value && !running.value && (
          <p class="hint">The goal was painted over after this fit.</p>
        )}
        <Running />
        <div class="row">
          {!running.value && (
            <Button
              icon="play"
              kind="primary"
              label={result.value ? "Fit again" : "Fit"}
              disabled={picture.value === null || reading.value !== null}
              onPress={() => void startFit()}
              testid="start"
            />
          )}
          {(state === "searching" || state === "trying") && (
            <Button icon="pause" label="Pause" onPress={pauseFit} testid="pause" />
          )}
          {state === "paused" && (
            <Button icon="play" label="Go on" kind="primary" onPress={resumeFit} testid="resume" />
          )}
          {running.value && (
            <Button
              icon="stop"
              label={state === "guessing" || state === "judging" ? "Cancel" : "Stop"}
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
