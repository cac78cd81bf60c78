// The best tree so far in three dimensions, which the pointer and the arrow keys turn.
import { useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { theme } from "../../state/theme";
import { GrowingCanvas } from "../../view3d/growing-canvas";
import { KEYS_IN_WORDS, onTurningKey } from "../../view3d/handle";
import { growing, treeIsDrawn } from "./growing-state";

/** `children` is what is seen until the first tree is drawn, and where none can be. */
export function GrowingStage({ children }: { children: JSX.Element }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const open = useRef<GrowingCanvas | null>(null);
  const state = useSignal<"coming" | "growing" | "flat">("coming");
  /** Where the pointer that turns the tree was last. */
  const from = useRef<{ x: number; y: number } | null>(null);

  useSignalEffect(() => {
    const tree = growing.value;
    if (!tree || !canvas.current || state.peek() === "flat") return;
    const failed = () => {
      state.value = "flat";
    };
    try {
      open.current ??= new GrowingCanvas(canvas.current, theme() === "dark", {
        drawn(took, programs) {
          state.value = "growing";
          treeIsDrawn(took, programs);
        },
        failed,
      });
      open.current.show(tree);
    } catch {
      failed();
    }
  });
  useSignalEffect(() => open.current?.setTheme(theme() === "dark"));
  useEffect(() => () => open.current?.dispose(), []);

  const isGrowing = state.value === "growing";
  return (
    <div class={`growing-stage ${state.value}`} data-testid="growing" data-state={state.value}>
      {!isGrowing && children}
      {/* biome-ignore lint/a11y/useSemanticElements: no element means "a view that arrow keys turn". */}
      <div
        class="view"
        role="group"
        aria-label={`View of the best tree so far. ${KEYS_IN_WORDS}`}
        aria-hidden={!isGrowing}
        tabIndex={isGrowing ? 0 : -1}
        onKeyDown={(event) => onTurningKey(event, (...step) => open.current?.orbit(...step))}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          from.current = { x: event.clientX, y: event.clientY };
        }}
        onPointerMove={(event) => {
          const before = from.current;
          if (!before) return;
          // Across the height of the view it turns once.
          const radians = (2 * Math.PI) / event.currentTarget.clientHeight;
          const [right, down] = [event.clientX - before.x, event.clientY - before.y];
          open.current?.orbit(-right * radians, down * radians, 1);
          from.current = { x: event.clientX, y: event.clientY };
        }}
        onPointerUp={() => {
          from.current = null;
        }}
        onPointerCancel={() => {
          from.current = null;
        }}
      >
        <canvas ref={canvas} role="img" aria-label="The best tree so far in three dimensions." />
      </div>
    </div>
  );
}
