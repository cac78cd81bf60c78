// The three pictures of a fit: goal, best tree so far, and both over each other.
import { useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import { Segmented } from "../../ui/controls";
import { BOTH, inkImage, overlayImage, show } from "../../ui/ink";
import { best, progress, result, shownInk, shownTree, shownWhich, which } from "./fit-state";
import { GoalEditor } from "./goal-editor";

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

export function Tiles(): JSX.Element {
  const now = best.value;
  return (
    <div class={`tiles${now ? " three" : ""}`}>
      <figure class="tile goal">
        <div class="paper">
          <GoalEditor />
        </div>
        <figcaption>Goal</figcaption>
      </figure>
      {now && (
        <>
          <figure class="tile">
            <div class="paper">
              <Overlay />
            </div>
            <figcaption>
              <span class="swatch goal">goal only</span>
              <span class="swatch tree">tree only</span>
              <span class="swatch both">both</span>
            </figcaption>
          </figure>
          <figure class="tile">
            <div class="paper">
              <Best />
            </div>
            <figcaption>
              {now.ownInk ? (
                <Segmented
                  label="Tree that is shown"
                  value={shownWhich.value}
                  options={[
                    { value: "own", label: "This very tree" },
                    { value: "kind", label: "Its kind" },
                  ]}
                  onPick={(picked) => {
                    which.value = picked;
                  }}
                />
              ) : result.value ? (
                "Best tree"
              ) : (
                "Best tree so far"
              )}
            </figcaption>
          </figure>
        </>
      )}
    </div>
  );
}
