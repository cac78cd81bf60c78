// The goal with its mask: a brush that adds and takes away, a box around the tree, two lines to drag, and what was read.
import { computed, signal, useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import { type Area, joined, NOTHING, type Point, stroke } from "./brush";
import { running } from "./fit-state";
import { canReadAgain, type GoalPicture, info, masks, picture, readInBox, setMask } from "./goal-state";
import { Handle } from "./handle";
import { layers } from "./look-state";
import { LookView } from "./look-view";
import { MaskCanvas } from "./mask-canvas";

/**
 * What dragging over the picture does: nothing, paint the tree, paint what is not the tree, or draw a box around the tree.
 * A finger scrolls the page until one of them is picked.
 */
export type BrushMode = "off" | "add" | "take" | "box";
const brushMode = signal<BrushMode>(matchMedia("(pointer: coarse)").matches ? "off" : "add");
const picked = signal(false);
export const brush = computed(() => brushMode.value);

export function pickBrush(mode: BrushMode): void {
  brushMode.value = mode;
  picked.value = true;
}

/** Diameter in hundredths of the picture's longer side. */
export const brushSize = signal(5);

/** Of a rectangle. */
interface Corners {
  from: Point;
  to: Point;
}

/** A rectangle that is drawn, and the picture that it was begun on. */
interface Box extends Corners {
  on: GoalPicture;
}

/** What the brush has painted so far, which is not the mask yet. */
interface Stroke {
  on: GoalPicture;
  ink: Uint8Array<ArrayBuffer>;
  value: 0 | 1;
  /** Where it has been, the last place included. */
  points: Point[];
  dirty: Area;
}

/** What was begun on a picture says nothing of the next one, nor of the same file that was read again. */
const stillOn = <T extends { on: GoalPicture }>(begun: T | null): T | null =>
  begun?.on === picture.peek() ? begun : null;

/** Boxes of fewer pixels a side are slips of the hand. */
const SMALLEST_BOX = 8;

/** First column and row, columns and rows of what a box covers of the picture; null if that is next to nothing. */
function within(
  { from, to }: Corners,
  width: number,
  height: number,
): [number, number, number, number] | null {
  const clamp = (at: number, side: number) => Math.round(Math.min(side, Math.max(0, at)));
  const [left, right] = [clamp(Math.min(from.x, to.x), width), clamp(Math.max(from.x, to.x), width)];
  const [top, bottom] = [clamp(Math.min(from.y, to.y), height), clamp(Math.max(from.y, to.y), height)];
  if (right - left < SMALLEST_BOX || bottom - top < SMALLEST_BOX) return null;
  return [left, top, right - left, bottom - top];
}

/** Where a box lies over the picture, in parts of its sides. */
function edges({ from, to }: Corners, width: number, height: number): Record<string, string> {
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
  const onCanvas = useRef(new MaskCanvas());
  const stroking = useRef<Stroke | null>(null);
  const frame = useRef(0);
  /** What the canvas shows. */
  const painted = useRef<{ ink: Uint8Array; on: GoalPicture; layers: Uint8Array | null } | null>(null);
  const cursor = useSignal<Point | null>(null);
  const box = useSignal<Box | null>(null);

  useSignalEffect(() => {
    const { ink } = masks.value;
    const now = picture.value;
    const kinds = layers.value;
    stroking.current = stillOn(stroking.current);
    box.value = stillOn(box.peek());
    const last = painted.current;
    // A stroke that has ended is on the canvas already.
    const isThere = last?.ink === ink && last.on === now && last.layers === kinds;
    // One that goes on paints by itself, and ends with all of it.
    if (!canvas.current || !now || isThere || stroking.current) return;
    onCanvas.current.paint(canvas.current, now, { ink, layers: kinds });
    painted.current = { ink, on: now, layers: kinds };
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
  /** Those that the canvas shows: what is read during a stroke is drawn after it. */
  const kinds = () => painted.current?.layers ?? null;
  const draw = (to: Point) => {
    const now = stillOn(stroking.current);
    if (!now) return;
    const from = now.points.at(-1) ?? to;
    now.dirty = joined(now.dirty, stroke(now.ink, shown, [from, to], radius, now.value));
    now.points.push(to);
    cancelAnimationFrame(frame.current);
    frame.current = requestAnimationFrame(() => {
      const drawn = stillOn(stroking.current);
      if (!canvas.current || !drawn) return;
      onCanvas.current.paint(canvas.current, shown, { ink: drawn.ink, layers: kinds() }, drawn.dirty);
      drawn.dirty = NOTHING;
    });
  };
  const end = () => {
    const now = stillOn(stroking.current);
    stroking.current = null;
    // A search has begun, by the keyboard: its goal stays.
    if (running.peek()) return giveUp();
    if (now) {
      cancelAnimationFrame(frame.current);
      const drawn = { ink: now.ink, layers: kinds() };
      if (canvas.current) onCanvas.current.paint(canvas.current, shown, drawn, now.dirty);
      painted.current = { ...drawn, on: shown };
      const { value, points } = now;
      setMask({ ink: now.ink, strokes: [...masks.peek().strokes, { value, points }] });
    }
    const drawn = stillOn(box.peek());
    box.value = null;
    const sides = drawn && within(drawn, width, height);
    if (sides) void readInBox(sides);
  };
  /** The page scrolls: the stroke was not meant. */
  const giveUp = () => {
    stroking.current = null;
    box.value = null;
    const drawn = { ink: masks.peek().ink, layers: layers.peek() };
    if (canvas.current) onCanvas.current.paint(canvas.current, shown, drawn);
    painted.current = { ...drawn, on: shown };
  };
  const idle = running.value || brush.value === "off";
  const text = `Goal ${shown.name}, ${width} by ${height} pixels, ${info.value ? `${Math.round((100 * info.value.ink) / (width * height))} % tree` : "mask"}`;
  return (
    <div class="editor" style={{ aspectRatio: `${width} / ${height}` }}>
      <canvas
        ref={canvas}
        role="img"
        aria-label={text}
        data-testid="goal"
        class={idle ? "" : picked.value ? "paintable touch" : "paintable"}
        onPointerDown={(event) => {
          // A second finger: what the first has painted stays, and a box with it has no clear end.
          if (!event.isPrimary) {
            box.value = null;
            end();
            return;
          }
          if (idle || event.button !== 0 || (event.pointerType === "touch" && !picked.peek())) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          const at = place(event);
          if (brush.peek() === "box") {
            if (canReadAgain()) box.value = { on: shown, from: at, to: at };
            return;
          }
          const value = brush.peek() === "add" ? 1 : 0;
          stroking.current = { on: shown, ink: masks.peek().ink.slice(), value, points: [], dirty: NOTHING };
          draw(at);
        }}
        onPointerMove={(event) => {
          if (!event.isPrimary) return;
          const at = place(event);
          cursor.value = at;
          draw(at);
          const begun = box.peek();
          if (begun) box.value = { ...begun, to: at };
        }}
        onPointerUp={(event) => event.isPrimary && end()}
        onPointerCancel={(event) => event.isPrimary && giveUp()}
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
      <LookView />
      <Line kind="ground" size={height} at={masks.value.ground ?? info.value?.ground_row ?? height - 1} />
      <Line kind="axis" size={width} at={masks.value.axis ?? info.value?.axis_column ?? width / 2} />
    </div>
  );
}

/** A line across the picture with a handle at its end. */
function Line({ kind, size, at }: { kind: "ground" | "axis"; size: number; at: number }): JSX.Element {
  const share = (at + 0.5) / size;
  const isGround = kind === "ground";
  return (
    <>
      <div class={`line ${kind}`} style={{ [isGround ? "top" : "left"]: `${100 * share}%` }} />
      <Handle
        name={isGround ? "Ground" : "Trunk"}
        label={isGround ? "ground" : "trunk"}
        kind={isGround ? "at-right" : "at-top"}
        way={isGround ? "vertical" : "horizontal"}
        at={isGround ? [1, share] : [share, 0]}
        value={Math.round(at)}
        range={[0, size - 1]}
        step={1}
        down={isGround}
        valueAt={([column, row]) => (isGround ? row : column) * size}
        onValue={(to) => setMask({ [kind]: to }, `line ${kind}`)}
      />
    </>
  );
}
