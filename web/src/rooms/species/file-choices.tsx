// What files are to have: their detail, the pictures and numbers in them, their format.
import type { JSX } from "preact";
import type { MeshFormat } from "../../engine/protocol";
import { Field } from "../../ui/controls";
import { BUDGETS, type Budget, FORMATS, SHADERS, type Shaders, TEXTURES, type Textures } from "./exports";

interface Choice<T> {
  value: T;
  onPick: (value: T) => void;
}

interface Picked<T> extends Choice<T> {
  label: string;
  testid: string;
  options: readonly { id: T; label: string }[];
}

/** A list of which one is picked. */
function Pick<T extends string | number>(props: Picked<T>): JSX.Element {
  const { label, testid, options, value, onPick } = props;
  return (
    <Field label={label}>
      {(id) => (
        <select
          id={id}
          data-testid={testid}
          value={value}
          onChange={(event) => {
            const picked = options.find((one) => String(one.id) === event.currentTarget.value);
            if (picked) onPick(picked.id);
          }}
        >
          {options.map((one) => (
            <option key={one.id} value={one.id}>
              {one.label}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

export function DetailChoice(
  props: Choice<Budget> & { label: string; budgets?: readonly Budget[] },
): JSX.Element {
  const { label, value, budgets = BUDGETS, onPick } = props;
  return (
    <Pick
      label={label}
      testid="budget"
      options={budgets}
      value={value.id}
      onPick={(id) => onPick(budgets.find((one) => one.id === id) ?? value)}
    />
  );
}

const PIXELS = TEXTURES.map((id) => ({
  id,
  label: id === 0 ? "None" : `${id.toLocaleString("en")} pixels a side`,
}));

export function TexturesChoice(props: Choice<Textures>): JSX.Element {
  return <Pick label="Pictures of bark and leaves" testid="textures" options={PIXELS} {...props} />;
}

export function ShadersChoice(props: Choice<Shaders>): JSX.Element {
  return <Pick label="Numbers for shaders" testid="shaders" options={SHADERS} {...props} />;
}

const FILES = FORMATS.map(({ format, label, what }) => ({ id: format, label: `${label}, ${what}` }));

export function FormatChoice(props: Choice<MeshFormat>): JSX.Element {
  return <Pick label="Format" testid="zip-format" options={FILES} {...props} />;
}
