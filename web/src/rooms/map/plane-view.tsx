// The canvas of the map, its pointer and its keys.
import { signal, useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { thumbnails } from "../../engine/pool";
import type { Plane } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import { theme } from "../../state/theme";
import { inkImage, show, styleColor } from "../../ui/ink";
import { drawMap, frameOf, type MapColors, toPlane } from "./drawing";
import {
  about,
  held,
  layout,
  moveTo,
  type Place,
  path,
  pin,
  pins,
  planes,
  point,
  showSwitches,
  tidy,
} from "./map-state";

export type Tool = "look" | "path" | "pin";
export const tool = signal<Tool>("look");

const THUMB_SIZE = 112;

/** Silhouettes of the species, each drawn when its worker is done. */
function useThumbs(plane: Plane | undefined): ReadonlyMap<string, CanvasImageSource> {
  const thumbs = useSignal<ReadonlyMap<string, CanvasImageSource>>(new Map());
  const dark = theme();
  useEffect(() => {
    const stop = new AbortController();
    for (const { name } of plane?.dots ?? []) {
      const spec = { source: { builtin: name }, values: null };
      thumbnails
        .call("silhouette", { spec, seed: 1, size: THUMB_SIZE, coarse: false }, stop.signal)
        .then(({ ink, width, height }) => {
          if (stop.signal.aborted) return;
          const canvas = document.createElement("canvas");
          show(canvas, inkImage(ink, width, height, styleColor("--silhouette")));
          thumbs.value = new Map(thumbs.peek()).set(name, canvas);
        })
        .catch((error: unknown) => {
          if (!stop.signal.aborted) sayError(error);
        });
    }
    return () => stop.abort();
  }, [plane, dark, thumbs]);
  return thumbs.value;
}

function colors(): MapColors {
  const of = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return {
    ink: of("--text"),
    soft: of("--text-soft"),
    line: of("--line-strong"),
    hull: of("--hull"),
    accent: of("--accent"),
    warn: of("--warn"),
    paper: of("--page"),
  };
}

function describe(): string {
  const at = point.value;
  if (!at) return "Map of species. No point is chosen.";
  const parts = about.value?.weights
    .slice(0, 3)
    .map(([name, share]) => `${Math.round(share * 100)} % ${name.replaceAll("_", " ")}`);
  return `Map of species. Point ${at[0].toFixed(2)}, ${at[1].toFixed(2)}: ${parts?.join(", ") ?? "growing"}`;
}

export function PlaneView({ onOpen }: { onOpen: () => void }): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawing = useRef<Place[] | null>(null);
  const resized = useSignal(0);
  const plane = planes.value[layout.value];
  const thumbs = useThumbs(plane);

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const watcher = new ResizeObserver(() => {
      resized.value++;
    });
    watcher.observe(element);
    return () => watcher.disconnect();
  }, [resized]);

  const redraw = () => {
    if (!canvas.current) return;
    if (!plane) {
      canvas.current.width = 0;
      return;
    }
    const scene = {
      plane,
      thumbs,
      point: point.value,
      held: held.value,
      pins: pins.value,
      path: path.value,
      switches: showSwitches.value,
    };
    drawMap(canvas.current, scene, colors());
  };
  const latest = useRef(redraw);
  latest.current = redraw;
  useSignalEffect(() => {
    theme();
    resized.value;
    latest.current();
  });
  useEffect(() => latest.current(), [plane, thumbs]);

  const place = (event: PointerEvent | MouseEvent): Place | null => {
    const element = canvas.current;
    if (!element || !plane) return null;
    const box = element.getBoundingClientRect();
    const frame = frameOf(plane, element.clientWidth, element.clientHeight);
    const [x, y] = toPlane(frame, event.clientX - box.left, event.clientY - box.top);
    return [tidy(x), tidy(y)];
  };

  const down = (event: PointerEvent) => {
    const at = place(event);
    if (!at || event.button !== 0) return;
    canvas.current?.setPointerCapture(event.pointerId);
    if (tool.peek() === "pin") pin(at);
    drawing.current = [at];
    moveTo(...at);
    held.value = true;
  };
  const move = (event: PointerEvent) => {
    const at = place(event);
    if (!at) return;
    const line = drawing.current;
    if (!line) {
      if (!held.peek() && event.pointerType !== "touch") moveTo(...at);
      return;
    }
    moveTo(...at);
    if (tool.peek() !== "path") return;
    line.push(at);
    path.value = [...line];
  };
  const up = () => {
    drawing.current = null;
  };

  const keys = (event: KeyboardEvent) => {
    if (!plane || event.ctrlKey || event.metaKey) return;
    const [x0, y0, x1, y1] = plane.box;
    const step = Math.max(x1 - x0, y1 - y0) * (event.shiftKey ? 0.05 : 0.01);
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[
      event.key
    ];
    const at = point.peek() ?? [(x0 + x1) / 2, (y0 + y1) / 2];
    if (by) {
      held.value = true;
      moveTo(at[0] + (by[0] ?? 0), at[1] + (by[1] ?? 0));
    } else if (event.key === "Enter") onOpen();
    else if (event.key === "p") pin(at);
    else if (event.key === "Escape") held.value = false;
    else return;
    event.preventDefault();
  };

  return (
    // biome-ignore lint/a11y/useSemanticElements: no element means "a plane with a point that arrow keys move".
    <div
      class={`plane ${tool.value}`}
      role="group"
      aria-label="Plane of species. Arrow keys move the point, Enter opens its species, P pins it."
      // biome-ignore lint/a11y/noNoninteractiveTabindex: the keys above move the point.
      tabIndex={0}
      onKeyDown={keys}
    >
      <canvas
        ref={canvas}
        role="img"
        aria-label={describe()}
        data-testid="plane"
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={up}
        onPointerCancel={up}
        onDblClick={onOpen}
      />
      {!plane && <p class="empty">The map is being drawn.</p>}
    </div>
  );
}
