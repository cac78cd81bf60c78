// The panel of the fit room: goal, brush, search.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";
import { loadCatalogue } from "../../engine/clients";
import { sayError } from "../../state/notes";
import { Alert, Bar, Button, Field, NumberInput, Segmented } from "../../ui/controls";
import { ChooseButton, TargetSelect } from "./chooser";
import {
  elapsed,
  failure,
  generator,
  guess,
  leafiness,
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
  treeHeight,
  undoMask,
} from "./goal-state";

const BUDGETS = [10, 30, 60, 180] as const;

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
          onPress={() => void readAgain(found.masked ? "off" : "auto")}
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

function SearchPart(): JSX.Element {
  const families = useSignal<readonly string[]>(["weber-penn"]);
  useEffect(() => {
    loadCatalogue()
      .then((all) => {
        families.value = all.families.map(({ family }) => family);
      })
      .catch(sayError);
  }, [families]);
  return (
    <section class="part" aria-label="Search">
      <h3>Search</h3>
      <div class="pair">
        <Field label="Height, m">
          {(id) => (
            <NumberInput
              id={id}
              value={treeHeight.value}
              min={0.1}
              max={200}
              disabled={running.value}
              onChange={(next) => {
                treeHeight.value = next;
              }}
            />
          )}
        </Field>
        <Field label="Leaves">
          {(id) => (
            <select
              id={id}
              value={leafiness.value}
              disabled={running.value}
              onChange={(event) => {
                leafiness.value = event.currentTarget.value as typeof leafiness.value;
              }}
            >
              <option value="auto">as it looks</option>
              <option value="leafy">leafy</option>
              <option value="bare">bare</option>
            </select>
          )}
        </Field>
      </div>
      <Field label="Family">
        {(id) => (
          <select
            id={id}
            value={generator.value}
            disabled={running.value}
            onChange={(event) => {
              generator.value = event.currentTarget.value;
            }}
          >
            {families.value.map((family) => (
              <option key={family} value={family}>
                {family}
              </option>
            ))}
            <option value="auto">the family that it looks like</option>
          </select>
        )}
      </Field>
      <Field label="Time to search">
        {() => (
          <Segmented
            label="Time to search"
            value={String(seconds.value)}
            disabled={running.value}
            options={BUDGETS.map((value) => ({
              value: String(value),
              label: value < 100 ? `${value} s` : `${value / 60} min`,
            }))}
            onPick={(picked) => {
              seconds.value = Number(picked);
            }}
          />
        )}
      </Field>
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
      {seen.looks_like
        .slice(0, 3)
        .filter(([, share], at) => at === 0 || share >= 0.005)
        .map(([name, share], at) => (
          <span key={name}>
            {at > 0 && ", "}
            <strong>{name.replaceAll("_", " ")}</strong> {Math.round(share * 100)} %
          </span>
        ))}
      , {seen.leaves ? "leafy" : "bare"}.
    </p>
  );
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
        </div>
      </footer>
    </>
  );
}
