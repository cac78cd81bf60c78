// The page's controls. All are native elements underneath, so that keyboards and screen readers know them.
import type { ComponentChildren, JSX } from "preact";
import { useId } from "preact/hooks";
import { Icon, type IconName } from "./icons";

interface ButtonProps {
  icon?: IconName;
  label: string;
  onPress: () => void;
  kind?: "plain" | "primary" | "quiet";
  disabled?: boolean;
  pressed?: boolean;
  /** Shows the icon alone; the label becomes its name and tooltip. */
  iconOnly?: boolean;
  title?: string;
  testid?: string;
}

export function Button(props: ButtonProps): JSX.Element {
  const { icon, label, kind = "plain", iconOnly = false } = props;
  return (
    <button
      type="button"
      class={`button ${kind}${iconOnly ? " square" : ""}`}
      aria-label={iconOnly ? label : undefined}
      aria-pressed={props.pressed}
      title={props.title ?? (iconOnly ? label : undefined)}
      disabled={props.disabled ?? false}
      data-testid={props.testid}
      onClick={props.onPress}
    >
      {icon && <Icon name={icon} />}
      {!iconOnly && <span>{label}</span>}
    </button>
  );
}

interface SegmentedProps<T extends string> {
  label: string;
  options: readonly { value: T; label: string }[];
  value: T;
  onPick: (value: T) => void;
  disabled?: boolean;
}

/** A few choices side by side: radio buttons that look like one switch. */
export function Segmented<T extends string>(props: SegmentedProps<T>): JSX.Element {
  const name = useId();
  return (
    <fieldset class="segmented" disabled={props.disabled ?? false}>
      <legend class="hidden">{props.label}</legend>
      {props.options.map((option) => (
        <label key={option.value}>
          <input
            type="radio"
            name={name}
            checked={option.value === props.value}
            onChange={() => props.onPick(option.value)}
          />
          <span>{option.label}</span>
        </label>
      ))}
    </fieldset>
  );
}

interface FieldProps {
  label: string;
  /** Of what it is the label of; one of its own by default. */
  id?: string;
  hint?: string;
  children: (id: string) => ComponentChildren;
}

export function Field({ label, hint, children, id: given }: FieldProps): JSX.Element {
  const own = useId();
  const id = given ?? own;
  return (
    <div class="field">
      <label for={id}>{label}</label>
      {children(id)}
      {hint && <p class="hint">{hint}</p>}
    </div>
  );
}

interface NumberProps {
  id?: string;
  label?: string;
  value: number;
  min?: number;
  max?: number;
  step?: number | "any";
  disabled?: boolean;
  onChange: (value: number) => void;
}

/** Takes a number when it is whole and within the bounds; otherwise shows the old one again. */
export function NumberInput(props: NumberProps): JSX.Element {
  return (
    <input
      id={props.id}
      class="number"
      type="number"
      aria-label={props.label}
      value={props.value}
      min={props.min}
      max={props.max}
      step={props.step ?? "any"}
      disabled={props.disabled ?? false}
      onChange={(event) => {
        const input = event.currentTarget;
        const value = input.valueAsNumber;
        if (Number.isFinite(value) && input.checkValidity()) props.onChange(value);
        else input.value = String(props.value);
      }}
    />
  );
}

export function Check(props: {
  label: string;
  checked: boolean;
  onChange: (checked: boolean) => void;
  disabled?: boolean;
}): JSX.Element {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={props.checked}
        disabled={props.disabled ?? false}
        onChange={(event) => props.onChange(event.currentTarget.checked)}
      />
      <span>{props.label}</span>
    </label>
  );
}

/** A message in place. */
export function Alert({ text, children }: { text: string; children?: ComponentChildren }): JSX.Element {
  return (
    <div class="alert" role="alert">
      <Icon name="info" />
      <p>{text}</p>
      {children}
    </div>
  );
}

/** A share of a whole, 0 to 1. */
export function Meter({ label, value }: { label: string; value: number }): JSX.Element {
  return (
    // biome-ignore lint/a11y/useSemanticElements: the look of <meter> cannot be set in all browsers.
    <div
      class="meter"
      role="meter"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={1}
      aria-valuenow={Number(value.toFixed(3))}
    >
      <div style={{ width: `${100 * Math.max(0, Math.min(1, value))}%` }} />
    </div>
  );
}

export function Bar({ label, share }: { label: string; share: number | null }): JSX.Element {
  return (
    <progress class="bar" aria-label={label} max={1} {...(share === null ? {} : { value: share })}>
      {share === null ? "" : `${Math.round(share * 100)} %`}
    </progress>
  );
}
