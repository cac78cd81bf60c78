// What files are to have: their detail, the pictures in them, their format.
import type { JSX } from "preact";
import type { MeshFormat } from "../../engine/protocol";
import { Field } from "../../ui/controls";
import { BUDGETS, type Budget, FORMATS, SHADERS, type Shaders, TEXTURES, type Textures } from "./exports";

interface Choice<T> {
  value: T;
  onPick: (value: T) => void;
}

export function DetailChoice(
  props: Choice<Budget> & { label: string; budgets?: readonly Budget[] },
): JSX.Element {
  const { label, value, budgets = BUDGETS, onPick } = props;
  return (
    <Field label={label}>
      {(id) => (
        <select
          id={id}
          data-testid="budget"
          value={value.id}
          onChange={(event) => {
            const picked = budgets.find((one) => one.id === event.currentTarget.value);
            if (picked) onPick(picked);
          }}
        >
          {budgets.map((one) => (
            <option key={one.id} value={one.id}>
              {one.label}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

const pixels = (side: Textures) => (side === 0 ? "None" : `${side.toLocaleString("en")} pixels a side`);

export function TexturesChoice({ value, onPick }: Choice<Textures>): JSX.Element {
  return (
    <Field label="Pictures of bark and leaves">
      {(id) => (
        <select
          id={id}
          data-testid="textures"
          value={value}
          onChange={(event) => {
            const picked = TEXTURES.find((side) => String(side) === event.currentTarget.value);
            if (picked !== undefined) onPick(picked);
          }}
        >
          {TEXTURES.map((side) => (
            <option key={side} value={side}>
              {pixels(side)}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

export function ShadersChoice({ value, onPick }: Choice<Shaders>): JSX.Element {
  return (
    <Field label="Numbers for shaders">
      {(id) => (
        <select
          id={id}
          data-testid="shaders"
          value={value}
          onChange={(event) => onPick(event.currentTarget.value as Shaders)}
        >
          {Object.entries(SHADERS).map(([kind, label]) => (
            <option key={kind} value={kind}>
              {label}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

export function FormatChoice({ value, onPick }: Choice<MeshFormat>): JSX.Element {
  return (
    <Field label="Format">
      {(id) => (
        <select
          id={id}
          data-testid="zip-format"
          value={value}
          onChange={(event) => {
            const picked = FORMATS.find(({ format }) => format === event.currentTarget.value);
            if (picked) onPick(picked.format);
          }}
        >
          {FORMATS.map(({ format, label, what }) => (
            <option key={format} value={format}>
              {label}, {what}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}
