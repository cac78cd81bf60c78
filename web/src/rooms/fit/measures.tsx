// What was read in the goal, drawn over it, with handles for what the user sees better.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import type { Corrections, Look } from "../../engine/protocol";
import { Button, Field, NumberInput } from "../../ui/controls";
import { running } from "./fit-state";
import { corrections, picture } from "./goal-state";
import { correct, look } from "./look-state";

/** Part of the height at which the handle of the lean is. */
const LEAN_AT = 0.3;
/** Width of the line of the bare height, in heights. */
const BAR = 0.14;
const ARM = 0.1;

const radians = (degrees: number) => (degrees * Math.PI) / 180;
const clamp = (value: number, least: number, most: number) => Math.min(most, Math.max(least, value));
const hundredths = (value: number) => Math.round(100 * value) / 100;

/** The value of a measure: as the user says, or as it was read. */
function value(key: keyof Corrections, found: Look["found"]): number | null {
  const said = corrections.value[key];
  if (said !== undefined) return said;
  return key === "trunks" ? found.feet.length : found[key];
}

/** The column of the main trunk at a height. */
function trunkAt(found: Look["found"], height: number): number {
  const below = found.trunk.filter(([, y]) => y <= height).at(-1) ?? found.trunk[0];
  return below ? below[0] : (found.feet[0]?.x ?? 0);
}

export function Measures(): JSX.Element | null {
  const seen = look.value;
  const shown = picture.value;
  if (!seen?.anchor || !shown) return null;
  const { found, anchor } = seen;
  const { width, height } = shown;
  const column = (x: number) => anchor.origin + x * anchor.height;
  const row = (y: number) => anchor.ground - y * anchor.height;
  const path = (points: [number, number][]) =>
    points.map(([x, y]) => `${column(x).toFixed(1)},${row(y).toFixed(1)}`).join(" ");
  const outline = (sides: number[], sign: number) =>
    sides.map((reach, at): [number, number] => [sign * reach, at / (sides.length - 1)]);
  const edge = (side: number) => found.trunk.map(([x, y, wide]): [number, number] => [x + side * wide, y]);
  const [lean, bare, fork] = [
    value("lean_deg", found),
    value("bare_height", found),
    value("first_fork", found),
  ];
  const foot = trunkAt(found, 0);
  const leaning = foot + LEAN_AT * Math.tan(radians(lean ?? 0));
  const forkX = found.fork_x ?? trunkAt(found, fork ?? 0);
  return (
    <>
      <svg class="measures" viewBox={`0 0 ${width} ${height}`} preserveAspectRatio="none" aria-hidden="true">
        <polyline class="crown" points={path(outline(found.crown.left, -1))} />
        <polyline class="crown" points={path(outline(found.crown.right, 1))} />
        <polyline class="trunk" points={path(edge(-0.5))} />
        <polyline class="trunk" points={path(edge(0.5))} />
        {found.feet.map(({ x, width: wide }) => (
          <polyline
            key={x}
            class="foot"
            points={path([
              [x - wide / 2, 0.008],
              [x + wide / 2, 0.008],
            ])}
          />
        ))}
        {lean !== null && (
          <polyline
            class="lean"
            points={path([
              [foot, 0],
              [leaning, LEAN_AT],
            ])}
          />
        )}
        {bare !== null && (
          <polyline
            class="bare"
            points={path([
              [trunkAt(found, bare) - BAR, bare],
              [trunkAt(found, bare) + BAR, bare],
            ])}
          />
        )}
        {fork !== null &&
          found.fork_arms_deg.map((angle) => (
            <polyline
              key={angle}
              class="fork"
              points={path([
                [forkX, fork],
                [forkX + ARM * Math.sin(radians(angle)), fork + ARM * Math.cos(radians(angle))],
              ])}
            />
          ))}
      </svg>
      {lean !== null && (
        <Handle
          name="Lean"
          way="horizontal"
          at={[column(leaning) / width, row(LEAN_AT) / height]}
          value={Math.round(lean)}
          range={[-60, 60]}
          text={`${Math.abs(Math.round(lean))}° to the ${lean < 0 ? "left" : "right"}`}
          step={1}
          onMove={(x) => {
            const reach = (x * width - anchor.origin) / anchor.height - foot;
            return Math.round(clamp((Math.atan2(reach, LEAN_AT) * 180) / Math.PI, -60, 60));
          }}
          onValue={(degrees) => correct("lean_deg", degrees)}
        />
      )}
      {bare !== null && (
        <Handle
          name="Bare"
          way="vertical"
          at={[column(trunkAt(found, bare) + BAR) / width, row(bare) / height]}
          value={hundredths(bare)}
          range={[0, 1]}
          text={`up to ${hundredths(bare)} of the height`}
          step={0.01}
          onMove={(_, y) => hundredths(clamp((anchor.ground - y * height) / anchor.height, 0, 1))}
          onValue={(part) => correct("bare_height", part)}
        />
      )}
      {fork !== null && (
        <Handle
          name="Fork"
          way="vertical"
          at={[column(forkX) / width, row(fork) / height]}
          value={hundredths(fork)}
          range={[0, 1]}
          text={`at ${hundredths(fork)} of the height`}
          step={0.01}
          onMove={(_, y) => hundredths(clamp((anchor.ground - y * height) / anchor.height, 0, 1))}
          onValue={(part) => correct("first_fork", part)}
        />
      )}
    </>
  );
}

interface HandleProps {
  name: string;
  way: "horizontal" | "vertical";
  /** Parts of the picture's width and height. */
  at: [number, number];
  value: number;
  range: [number, number];
  text: string;
  step: number;
  /** The value at a place in parts of the picture. */
  onMove: (x: number, y: number) => number;
  onValue: (value: number) => void;
}

/** A measure that can be dragged, or moved with the arrow keys. */
function Handle({ name, way, at, value, range, text, step, onMove, onValue }: HandleProps): JSX.Element {
  const dragging = useSignal(false);
  return (
    <div
      class={`handle measure ${way}`}
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
        if (running.peek()) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        dragging.value = true;
        event.preventDefault();
      }}
      onPointerMove={(event) => {
        const frame = event.currentTarget.closest(".editor")?.getBoundingClientRect();
        if (!dragging.peek() || !frame) return;
        const [x, y] = [
          (event.clientX - frame.left) / frame.width,
          (event.clientY - frame.top) / frame.height,
        ];
        onValue(onMove(x, y));
      }}
      onPointerUp={() => {
        dragging.value = false;
      }}
      onPointerCancel={() => {
        dragging.value = false;
      }}
      onKeyDown={(event) => {
        const sign = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
        if (sign === undefined || running.peek()) return;
        event.preventDefault();
        const next = value + sign * step * (event.shiftKey ? 10 : 1);
        onValue(hundredths(clamp(next, range[0], range[1])));
      }}
    >
      {name.toLowerCase()}
    </div>
  );
}

/** The measures in words, the number of trunks, and the way back. */
export function MeasuresPart(): JSX.Element | null {
  const seen = look.value;
  if (!seen) return <p class="hint">The picture is being read.</p>;
  return (
    <div class="readpart">
      <p class="hint">
        What was read in the picture. Drag what you see better: the fit then starts from species that agree
        with it.
      </p>
      <Field label="Trunks">
        {(id) => (
          <NumberInput
            id={id}
            min={1}
            max={64}
            step={1}
            disabled={running.value}
            value={value("trunks", seen.found) ?? 1}
            onChange={(count) => correct("trunks", count)}
          />
        )}
      </Field>
      <table class="readtable" data-testid="reading-table">
        <tbody>
          {seen.table.map(([name, words, confidence]) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td>{words}</td>
              <td>{Math.round(100 * confidence)} %</td>
            </tr>
          ))}
        </tbody>
      </table>
      {Object.keys(corrections.value).length > 0 && (
        <Button
          kind="quiet"
          label="As it was read"
          disabled={running.value}
          onPress={() => {
            corrections.value = {};
          }}
        />
      )}
    </div>
  );
}
