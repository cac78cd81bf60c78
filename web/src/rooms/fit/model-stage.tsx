// The tree in three dimensions, with bark and leaves as they are exported: while the search runs the best so far, then the
// fitted tree.
import { useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { reducedMotion, theme } from "../../state/theme";
import { Bar } from "../../ui/controls";
import { nextTask, openContext } from "../../view3d/context";
import { KEYS_IN_WORDS, setView, turnByKey } from "../../view3d/handle";
import type { ModelView } from "../../view3d/model-view";
import { running } from "./fit-state";
import { GrowingStage } from "./growing-stage";
import { blowing, drawing, drawModel, isOf, type Model, model, modelFailure, wanted } from "./model-state";
import { shownWhich } from "./record";

/** What is to be seen: `flat` where the browser draws nothing in three dimensions. */
type State = "coming" | "shown" | "lost" | "flat";

const IN_WORDS = { own: "This very tree", kind: "A tree of this kind", other: "Another tree of this kind" };

const LOST = "The graphics card lost the view. It comes back by itself; the tree is kept.";

/** Opens the view once there is a tree to show: the graphics card takes its time. */
async function openView(canvas: HTMLCanvasElement, lost: (gone: boolean) => void): Promise<ModelView | null> {
  const { ModelView } = await import("../../view3d/model-view");
  // Code, graphics context and view take a task each: together they would hold up the page.
  await nextTask();
  openContext(canvas);
  await nextTask();
  if (!canvas.isConnected) return null;
  const view = new ModelView(canvas, lost);
  view.setTheme(theme() === "dark");
  view.setWind(blowing.peek() && !reducedMotion.peek());
  setView(view);
  return view;
}

/** What is in the way of the tree, if anything. */
function Told(now: { failed: string | null; lost: boolean; busy: boolean }): JSX.Element | null {
  const wrong = now.failed ?? (now.lost ? LOST : null);
  if (wrong) {
    return (
      <div class="drawing" role="alert">
        {wrong}
      </div>
    );
  }
  if (!now.busy) return null;
  return (
    <div class="drawing" role="status">
      Drawing the tree
      <Bar label="Drawing the tree" share={null} />
    </div>
  );
}

/** `children` is what is seen until the tree is drawn, and where it cannot be. */
export function ModelStage({ children }: { children: JSX.Element }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const frame = useRef<HTMLDivElement>(null);
  const view = useRef<Promise<ModelView | null> | null>(null);
  const state = useSignal<State>("coming");

  const show = async (made: Model) => {
    if (!canvas.current) return;
    try {
      view.current ??= openView(canvas.current, (lost) => {
        state.value = lost ? "lost" : "shown";
      });
      const seen = await (await view.current)?.show(made.bytes.buffer);
      // A graphics card that is gone says itself when it is back.
      if (seen && state.peek() !== "lost") state.value = "shown";
    } catch {
      state.value = "flat";
    }
  };

  useEffect(() => () => setView(null), []);

  // The wheel scrolls the page until the view is chosen.
  useEffect(() => {
    const element = frame.current;
    const hold = (event: WheelEvent) => {
      if (!element?.contains(document.activeElement)) event.stopPropagation();
    };
    element?.addEventListener("wheel", hold, { capture: true });
    return () => element?.removeEventListener("wheel", hold, { capture: true });
  }, []);

  useSignalEffect(() => {
    const of = wanted.value;
    if (of) drawModel(of);
  });
  useSignalEffect(() => {
    const made = model.value;
    if (made && wanted.value && isOf(made, wanted.value)) void show(made);
  });
  useSignalEffect(() => {
    const dark = theme() === "dark";
    // A view that could not open is told above.
    view.current?.then((open) => open?.setTheme(dark)).catch(() => {});
  });

  useSignalEffect(() => {
    const on = blowing.value && !reducedMotion.value;
    view.current?.then((open) => open?.setWind(on)).catch(() => {});
  });

  const failed = modelFailure.value;
  const searching = running.value && !wanted.value;
  const busy = !searching && (drawing.value || (state.value === "coming" && !failed));
  return (
    <div
      class={`model-stage ${state.value}`}
      ref={frame}
      data-testid="model"
      data-state={busy ? "busy" : state.value}
    >
      {state.value !== "shown" && (
        <div class="instead">
          {state.value === "flat" ? children : <GrowingStage>{children}</GrowingStage>}
        </div>
      )}
      {/* biome-ignore lint/a11y/useSemanticElements: no element means "a view that arrow keys turn". */}
      <div
        class="view"
        role="group"
        aria-label={`View of the tree. ${KEYS_IN_WORDS}`}
        hidden={state.value === "flat"}
        // biome-ignore lint/a11y/noNoninteractiveTabindex: the keys turn the tree.
        tabIndex={0}
        onKeyDown={turnByKey}
      >
        <canvas ref={canvas} role="img" aria-label={`${IN_WORDS[shownWhich.value]} in three dimensions.`} />
      </div>
      <Told
        failed={searching ? null : failed}
        lost={state.value === "lost"}
        busy={busy && state.value !== "flat"}
      />
    </div>
  );
}
