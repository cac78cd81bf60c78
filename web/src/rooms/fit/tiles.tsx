// The three pictures of a fit: goal, best tree so far, and both over each other.
import { useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import { reducedMotion } from "../../state/theme";
import { Button, Segmented } from "../../ui/controls";
import { BOTH, inkImage, overlayImage, show } from "../../ui/ink";
import { Later } from "../../ui/later";
import { Curve } from "./curve";
import { EightTrees } from "./eight-trees";
import { progress } from "./fit-state";
import { GoalEditor } from "./goal-editor";
import { picture } from "./goal-state";
import { layers } from "./look-state";
import { ModelStage } from "./model-stage";
import { blowing, season, seasons } from "./model-state";
import { TakeAway } from "./outcome";
import { best, curve, other, pick, result, shownInk, shownTree, shownWhich } from "./record";
import { Verdict } from "./verdict";

function Best(): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  useSignalEffect(() => {
    const now = best.value;
    const ink = shownInk.value;
    if (now && ink && canvas.current) show(canvas.current, inkImage(ink, now.width, now.height, BOTH));
  });
  return <canvas ref={canvas} role="img" aria-label={`Best tree so far. ${scoreText()}`} />;
}

function Overlay(): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  useSignalEffect(() => {
    const now = best.value;
    const ink = shownInk.value;
    if (now && ink && canvas.current)
      show(canvas.current, overlayImage(now.goal, ink, now.width, now.height));
  });
  return (
    <canvas
      ref={canvas}
      role="img"
      data-testid="overlay"
      aria-label={`Goal in blue and tree in orange over each other, dark where both are. ${scoreText()}`}
    />
  );
}

function scoreText(): string {
  const card = shownTree.value?.card ?? progress.value;
  if (!card || card.likeness === null || card.iou === null) return "";
  return `Likeness ${card.likeness.toFixed(2)}, IoU ${card.iou.toFixed(2)}.`;
}

/** What the tree is where there is one alone. Before the first scores it is a known one. */
function soleName(): string {
  if (result.value) return "Best tree";
  return progress.value ? "Best tree so far" : "Nearest known tree";
}

/** The choice between the goal's own tree and one of its kind, or what the one tree is. */
function Caption(): JSX.Element {
  const isOwn = best.value?.ownInk;
  const another = other.value;
  if (!isOwn && !another) return <>{soleName()}</>;
  return (
    <Segmented
      label="Tree that is shown"
      value={shownWhich.value}
      options={[
        ...(isOwn ? [{ value: "own", label: "This very tree" } as const] : []),
        { value: "kind", label: "Its kind" },
        ...(another ? [{ value: "other", label: `Seed ${another.seed}` } as const] : []),
      ]}
      onPick={(picked) => {
        if (picked !== "other") pick(picked);
      }}
    />
  );
}

function Season(): JSX.Element | null {
  const known = ["", ...new Set([...seasons.value, "winter"])];
  return (
    <label class="inline">
      <span>Season</span>
      <select
        value={season.value}
        onChange={(event) => {
          season.value = event.currentTarget.value;
        }}
      >
        {known.map((name) => (
          <option key={name} value={name}>
            {name || "its own"}
          </option>
        ))}
      </select>
    </label>
  );
}

function Wind(): JSX.Element {
  return (
    <Button
      icon="wind"
      label="Wind"
      pressed={blowing.value}
      disabled={reducedMotion.value}
      {...(reducedMotion.value ? { title: "Your system asks for little motion." } : {})}
      testid="fit-wind"
      onPress={() => {
        blowing.value = !blowing.value;
      }}
    />
  );
}

/** The best tree in three dimensions; flat until it is drawn. */
function TreeTile(): JSX.Element {
  return (
    <figure class="tile tree">
      <ModelStage>
        <Best />
      </ModelStage>
      <figcaption>
        <Caption />
        {result.value && (
          <>
            <Season />
            <Wind />
          </>
        )}
        <span>Drag to turn it.</span>
      </figcaption>
    </figure>
  );
}

export function Tiles(): JSX.Element {
  const now = best.value;
  const shown = picture.value;
  const layout = now ? ` beside-tree${result.value ? " done" : ""}` : "";
  const aspect = shown ? { "--aspect": shown.width / shown.height } : {};
  return (
    <div class={`tiles${layout}`} style={aspect}>
      <figure class="tile goal">
        <div class="paper">
          <GoalEditor />
        </div>
        <figcaption>
          <span>Goal</span>
          {layers.value && (
            <>
              <span class="swatch wood">wood</span>
              <span class="swatch leaves">leaves</span>
            </>
          )}
        </figcaption>
      </figure>
      {now && (
        <>
          <TreeTile />
          <figure class="tile over">
            <div class="paper">
              <Overlay />
            </div>
            <figcaption>
              <span class="swatch goal">goal only</span>
              <span class="swatch tree">tree only</span>
              <span class="swatch both">both</span>
              {other.value && <span>This is the first tree of the kind.</span>}
            </figcaption>
          </figure>
          {result.value && (
            <div class="beside">
              <Later>
                <Verdict />
                <TakeAway />
              </Later>
              <Later>
                <EightTrees />
                {curve.value.length > 1 && <Curve />}
              </Later>
            </div>
          )}
        </>
      )}
    </div>
  );
}
