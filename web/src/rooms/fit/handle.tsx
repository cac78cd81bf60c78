// A handle over the goal: it is dragged, or moved with the arrow keys.
import type { JSX } from "preact";
import { useRef } from "preact/hooks";
import { running } from "./fit-state";

/** A place in parts of the picture's width and height. */
export type Place = readonly [number, number];

interface HandleProps {
  /** What screen readers call it; the label is in sight. */
  name: string;
  label: string;
  kind: string;
  way: "horizontal" | "vertical";
  at: Place;
  value: number;
  range: readonly [number, number];
  text?: string;
  step: number;
  /** With a value of this sign more is farther down, as for rows of a picture. */
  down?: boolean;
  /** The value at a place. */
  valueAt: (place: Place) => number;
  onValue: (value: number) => void;
}

const clamp = (value: number, [least, most]: readonly [number, number]) =>
  Math.min(most, Math.max(least, value));

/** A value as a whole number of steps. */
const stepped = (value: number, step: number) => Number((Math.round(value / step) * step).toFixed(6));

/** Where a pointer is over the goal. */
function placeOf(event: PointerEvent & { currentTarget: Element }): Place | null {
  const frame = event.currentTarget.closest(".editor")?.getBoundingClientRect();
  if (!frame) return null;
  return [(event.clientX - frame.left) / frame.width, (event.clientY - frame.top) / frame.height];
}

/** Which way a key leads. */
const KEYS: Record<string, -1 | 1> = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };

export function Handle(props: HandleProps): JSX.Element {
  const { name, label, kind, way, at, value, range, text, step, down = false } = props;
  /** How far from its place it was grabbed; null where it is not dragged. */
  const grabbed = useRef<Place | null>(null);
  const move = (to: number) => props.onValue(stepped(clamp(to, range), step));
  const isKept = () => running.peek();
  return (
    <div
      class={`handle ${kind} ${way}`}
      role="slider"
      tabIndex={running.value ? -1 : 0}
      aria-label={name}
      aria-orientation={way}
      aria-valuemin={range[0]}
      aria-valuemax={range[1]}
      aria-valuenow={value}
      aria-valuetext={text}
      aria-disabled={running.value}
      style={{ left: `${100 * at[0]}%`, top: `${100 * at[1]}%` }}
      onPointerDown={(event) => {
        if (isKept() || !event.isPrimary || event.button !== 0) return;
        const place = placeOf(event);
        if (!place) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        grabbed.current = [place[0] - at[0], place[1] - at[1]];
        event.preventDefault();
        event.currentTarget.focus({ preventScroll: true });
      }}
      onPointerMove={(event) => {
        const off = grabbed.current;
        const place = placeOf(event);
        if (!off || !place || isKept() || !event.isPrimary) return;
        move(props.valueAt([place[0] - off[0], place[1] - off[1]]));
      }}
      onPointerUp={() => {
        grabbed.current = null;
      }}
      onPointerCancel={() => {
        grabbed.current = null;
      }}
      onKeyDown={(event) => {
        const sign = KEYS[event.key];
        if (sign === undefined || isKept()) return;
        event.preventDefault();
        const turned = down && (event.key === "ArrowUp" || event.key === "ArrowDown") ? -sign : sign;
        move(value + turned * step * (event.shiftKey ? 10 : 1));
      }}
    >
      <span>{label}</span>
    </div>
  );
}
