// One number of a parameter: slider, field or choice, lock and reset.
import type { JSX } from "preact";
import { memo } from "preact/compat";
import { useId } from "preact/hooks";
import type { Parameter, Slot } from "../../engine/protocol";
import { original, setSlot, toggleLock } from "../../state/species";
import { Button, NumberInput } from "../../ui/controls";

/** What the slider spans: what fits search, widened to the present and the original value. */
export function span(slot: Slot, value: number): [number, number] {
  const [low, high] = slot.search;
  const first = original(slot);
  return [Math.min(low, value, first), Math.max(high, value, first)];
}

/** Three figures of the span are enough for a hand on a slider. */
export function rounded(value: number, low: number, high: number, whole: boolean): number {
  if (whole) return Math.round(value);
  const step = 10 ** Math.floor(Math.log10(Math.max(high - low, 1e-9) / 300));
  return Number((Math.round(value / step) * step).toPrecision(10));
}

const UNITS: Record<string, string> = { ratio: "", count: "" };
export const unitText = (unit: string) => UNITS[unit] ?? unit;

/** What a value of a choice is called, which counts from the first; null for other numbers. */
export const choiceName = ({ choices, first }: Parameter, value: number): string | null =>
  choices?.[value - (first ?? 0)]?.replaceAll("_", " ") ?? null;

interface RowProps {
  parameter: Parameter;
  slot: Slot;
  label: string;
  value: number;
  active: boolean;
  locked: boolean;
  /** Whether it stands apart from the other rows of its parameter, under a name of its own. */
  isHandle?: boolean;
}

function Choice({ parameter, slot, value, id }: RowProps & { id: string }): JSX.Element {
  return (
    <select id={id} value={value} onChange={(event) => setSlot(slot, Number(event.currentTarget.value))}>
      {parameter.choices?.map((choice, at) => (
        <option key={choice} value={(parameter.first ?? 0) + at}>
          {choice.replaceAll("_", " ")}
        </option>
      ))}
    </select>
  );
}

function Slide({ parameter, slot, value, id, label, isHandle }: RowProps & { id: string }): JSX.Element {
  const [low, high] = span(slot, value);
  const whole = parameter.kind === "integer" || parameter.kind === "flagged integer";
  // Logarithmic where the declaration says so: the slider then moves by factors.
  const log = slot.scale === "log" && low > 0;
  const place = (of: number) => (log ? Math.log(of) : of);
  const unit = unitText(parameter.unit);
  return (
    <>
      <input
        id={id}
        type="range"
        min={place(low)}
        max={place(high)}
        step={whole && !log ? 1 : "any"}
        value={place(value)}
        disabled={low === high}
        aria-valuetext={`${value}${unit ? ` ${unit}` : ""}`}
        onInput={(event) => {
          const at = event.currentTarget.valueAsNumber;
          setSlot(slot, rounded(log ? Math.exp(at) : at, low, high, whole));
        }}
      />
      <NumberInput
        label={isHandle ? label : `${parameter.name} ${label}`}
        value={value}
        {...(parameter.min === null ? {} : { min: parameter.min })}
        {...(parameter.max === null ? {} : { max: parameter.max })}
        step={whole ? 1 : "any"}
        onChange={(next) => setSlot(slot, next)}
      />
    </>
  );
}

function Row(props: RowProps): JSX.Element {
  const { parameter, slot, label, value, active, locked, isHandle } = props;
  const id = useId();
  const name = isHandle ? label : slot.slot;
  const changed = original(slot) !== value;
  return (
    <div
      class={`slot${active ? "" : " inactive"}${changed ? " changed" : ""}`}
      {...{ [isHandle ? "data-handle" : "data-slot"]: slot.slot }}
    >
      <label for={id}>
        <span class={parameter.slots.length === 1 && !isHandle ? "hidden" : ""}>{label}</span>
        {!active && <span class="note"> has no effect now</span>}
      </label>
      <div class="slide">
        {parameter.kind === "choice" ? <Choice {...props} id={id} /> : <Slide {...props} id={id} />}
        <Button
          icon="reset"
          iconOnly
          kind="quiet"
          label={`Reset ${name}`}
          disabled={!changed}
          onPress={() => setSlot(slot, original(slot))}
        />
        <Button
          icon={locked ? "lock" : "unlock"}
          iconOnly
          kind="quiet"
          label={`Lock ${name}`}
          pressed={locked}
          title={locked ? "Dice leave this as it is" : "Keep this from the dice"}
          onPress={() => toggleLock(slot.slot)}
        />
      </div>
    </div>
  );
}

export const SlotRow = memo(Row);
