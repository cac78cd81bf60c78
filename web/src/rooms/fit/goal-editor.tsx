// The goal with its mask: a brush that adds and takes away, a box around the tree, and two lines to drag.
import { signal, useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import { GOAL_ONLY, show } from "../../ui/ink";
import { running } from "./fit-state";
import { canReadAgain, info, masks, picture, readAgain, setMask } from "./goal-state";
import { Measures } from "./measures";

/** What dragging over the picture does: paint the tree, paint what is not the tree, draw a box around the tree, or move
 * what was read. */
export const brush = signal<"add" | "take" | "box" | "measures">("add");
/** Diameter in hundredths of the picture's longer side. */
export const brushSize = signal(5);

/** The photograph, pale, under its mask in blue; or the mask alone, dark. */
function paint(canvas: HTMLCanvasElement, ink: Uint8Array): void {
  const shown = picture.peek();
  if (!shown || ink.length !== shown.width * shown.height) return;
  const { width, height, photo } = shown;
  const image = new ImageData(width, height);
  const { data } = image;
  const [red, green, blue] = GOAL_ONLY;
  for (let at = 0; at < ink.length; at++) {
    const to = at * 4;
    const inside = ink[at] === 1;
    if (photo) {
      const share = inside ? 0.45 : 0.25;
      for (let channel = 0; channel < 3; channel++) {
        const over = inside ? ([red, green, blue][channel] ?? 0) : 255;
        data[to + channel] = (photo[to + channel] ?? 0) * (1 - share) + over * share;
      }
      data[to + 3] = 255;
    } else if (inside) {
      data[to] = 30;
      data[to + 1] = 38;
      data[to + 2] = 42;
      data[to + 3] = 255;
    }
  }
  show(canvas, image);
}

function stroke(
  ink: Uint8Array,
  width: number,
  height: number,
  from: Point,
  to: Point,
  radius: number,
  value: number,
): void {
  const steps = Math.max(1, Math.ceil(Math.hypot(to.x - from.x, to.y - from.y) / Math.max(1, radius / 2)));
  for (let step = 0; step <= steps; step++) {
    const x = from.x + ((to.x - from.x) * step) / steps;
    const y = from.y + ((to.y - from.y) * step) / steps;
    for (let row = Math.max(0, Math.floor(y - radius)); row <= Math.min(height - 1, y + radius); row++) {
      const half = Math.sqrt(Math.max(0, radius * radius - (row - y) * (row - y)));
      const first = Math.max(0, Math.round(x - half));
      const last = Math.min(width - 1, Math.round(x + half));
      if (last >= first) ink.fill(value, row * width + first, row * width + last + 1);
    }
  }
}

interface Point {
  x: number;
  y: number;
}

/** Two corners of a rectangle. */
interface Box {
  from: Point;
  to: Point;
}

/** Boxes of fewer pixels a side are slips of the hand. */
const SMALLEST_BOX = 8;

/** First column and row, columns and rows of what a box covers of the picture; null if that is next to nothing. */
function within({ from, to }: Box, width: number, height: number): [number, number, number, number] | null {
  const clamp = (at: number, side: number) => Math.round(Math.min(side, Math.max(0, at)));
  const [left, right] = [clamp(Math.min(from.x, to.x), width), clamp(Math.max(from.x, to.x), width)];
  const [top, bottom] = [clamp(Math.min(from.y, to.y), height), clamp(Math.max(from.y, to.y), height)];
  if (right - left < SMALLEST_BOX || bottom - top < SMALLEST_BOX) return null;
  return [left, top, right - left, bottom - top];
}

/** Where a box lies over the picture, in parts of its sides. */
function edges({ from, to }: Box, width: number, height: number): Record<string, string> {
  const part = (at: number, side: number) => `${(100 * at) / side}%`;
  return {
    left: part(Math.min(from.x, to.x), width),
    top: part(Math.min(from.y, to.y), height),
    width: part(Math.abs(to.x - from.x), width),
    height: part(Math.abs(to.y - from.y), height),
  };
}

export function GoalEditor(): JSX.Element | null {
  const canvas = useRef<HTMLCanvasElement>(null);
  const stroking = useRef<{ ink: Uint8Array<ArrayBuffer>; last: Point } | null>(null);
  const frame = useRef(0);
  const cursor = useSignal<Point | null>(null);
  const box = useSignal<Box | null>(null);

  useSignalEffect(() => {
    picture.value;
    if (canvas.current) paint(canvas.current, masks.value.ink);
  });

  const shown = picture.value;
  if (!shown) return null;
  const { width, height } = shown;
  const radius = (brushSize.value / 200) * Math.max(width, height);
  const place = (event: PointerEvent): Point => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    return {
      x: ((event.clientX - box.left) / box.width) * width,
      y: ((event.clientY - box.top) / box.height) * height,
    };
  };
  const draw = (to: Point) => {
    const now = stroking.current;
    if (!now) return;
    stroke(now.ink, width, height, now.last, to, radius, brush.peek() === "add" ? 1 : 0);
    now.last = to;
    cancelAnimationFrame(frame.current);
    frame.current = requestAnimationFrame(() => {
      if (canvas.current && stroking.current) paint(canvas.current, stroking.current.ink);
    });
  };
  const end = () => {
    const now = stroking.current;
    stroking.current = null;
    if (now) setMask({ ink: now.ink });
    const drawn = box.peek();
    box.value = null;
    const sides = drawn && within(drawn, width, height);
    if (sides) void readAgain("photo", { box: sides });
  };
  const text = `Goal ${shown.name}, ${width} by ${height} pixels, ${info.value ? `${Math.round((100 * info.value.ink) / (width * height))} % tree` : "mask"}`;
  return (
    <div class="editor" style={{ aspectRatio: `${width} / ${height}` }}>
      <canvas
        ref={canvas}
        role="img"
        aria-label={text}
        data-testid="goal"
        class={running.value || brush.value === "measures" ? "" : "paintable"}
        onPointerDown={(event) => {
          if (running.peek() || event.button !== 0 || brush.peek() === "measures") return;
          event.currentTarget.setPointerCapture(event.pointerId);
          const at = place(event);
          if (brush.peek() === "box") {
            if (canReadAgain()) box.value = { from: at, to: at };
            return;
          }
          stroking.current = { ink: masks.peek().ink.slice(), last: at };
          draw(at);
        }}
        onPointerMove={(event) => {
          cursor.value = place(event);
          if (stroking.current) draw(place(event));
          if (box.peek()) box.value = { from: box.peek()?.from ?? place(event), to: place(event) };
        }}
        onPointerUp={end}
        onPointerCancel={end}
        onPointerLeave={() => {
          cursor.value = null;
        }}
      />
      {box.value && <span class="box" style={edges(box.value, width, height)} />}
      {cursor.value && !running.value && (brush.value === "add" || brush.value === "take") && (
        <span
          class={`brush ${brush.value}`}
          style={{
            left: `${(100 * cursor.value.x) / width}%`,
            top: `${(100 * cursor.value.y) / height}%`,
            width: `${(200 * radius) / width}%`,
          }}
        />
      )}
      {brush.value === "measures" ? (
        <Measures />
      ) : (
        <>
          <Line kind="ground" size={height} at={masks.value.ground ?? info.value?.ground_row ?? height - 1} />
          <Line kind="axis" size={width} at={masks.value.axis ?? info.value?.axis_column ?? width / 2} />
        </>
      )}
    </div>
  );
}

/** A line across the picture with a handle at its end. */
function Line({ kind, size, at }: { kind: "ground" | "axis"; size: number; at: number }): JSX.Element {
  const dragging = useSignal(false);
  const move = (to: number) =>
    setMask({ [kind]: Math.round(Math.min(Math.max(to, 0), size - 1)) }, `line ${kind}`);
  const share = `${(100 * (at + 0.5)) / size}%`;
  const ground = kind === "ground";
  return (
    <div class={`line ${kind}`} style={ground ? { top: share } : { left: share }}>
      <div
        class="handle"
        role="slider"
        tabIndex={running.value ? -1 : 0}
        aria-label={ground ? "Ground" : "Trunk"}
        aria-orientation={ground ? "vertical" : "horizontal"}
        aria-valuemin={0}
        aria-valuemax={size - 1}
        aria-valuenow={Math.round(at)}
        aria-disabled={running.value}
        onPointerDown={(event) => {
          if (running.peek()) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          dragging.value = true;
          event.preventDefault();
        }}
        onPointerMove={(event) => {
          const frame = event.currentTarget.closest(".editor")?.getBoundingClientRect();
          if (!dragging.peek() || !frame) return;
          move(
            ground
              ? ((event.clientY - frame.top) / frame.height) * size
              : ((event.clientX - frame.left) / frame.width) * size,
          );
        }}
        onPointerUp={() => {
          dragging.value = false;
        }}
        onKeyDown={(event) => {
          const step = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
          if (step === undefined || running.peek()) return;
          event.preventDefault();
          move(at + step * (event.shiftKey ? 10 : 1));
        }}
      >
        {ground ? "ground" : "trunk"}
      </div>
    </div>
  );
}
