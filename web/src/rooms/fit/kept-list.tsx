// The fits that the user keeps, as a list.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { fromBase64Url, unpackBits } from "../../state/codec";
import { sayError } from "../../state/notes";
import { Button, Check } from "../../ui/controls";
import { BOTH, inkImage, show } from "../../ui/ink";
import { Comparison } from "./comparison";
import {
  compare,
  compared,
  deleteFit,
  duplicateFit,
  type KeptFit,
  keptFits,
  openFit,
  renameFit,
} from "./kept-fits";

const date = new Intl.DateTimeFormat("en", { dateStyle: "medium" });

/** Runs what may fail: a stored fit may be damaged. */
function attempt(run: () => void): void {
  try {
    run();
  } catch (error) {
    sayError(error);
  }
}

function Goal({ thumb }: Pick<KeptFit, "thumb">): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const { width, height, ink } = thumb;
    if (!canvas.current || width * height === 0) return;
    try {
      const pixels = unpackBits(fromBase64Url(ink), width * height);
      show(canvas.current, inkImage(pixels, width, height, BOTH));
    } catch {
      // A picture that is damaged is left blank: the fit may be whole.
    }
  }, [thumb]);
  return <canvas ref={canvas} width={96} height={96} />;
}

function Name({ entry, onDone }: { entry: KeptFit; onDone: () => void }): JSX.Element {
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => field.current?.select(), []);
  const done = (keeps: boolean) => {
    if (keeps && field.current) renameFit(entry.id, field.current.value);
    onDone();
  };
  return (
    <input
      ref={field}
      type="text"
      aria-label="Name of the fit"
      defaultValue={entry.name}
      maxLength={80}
      onBlur={() => done(true)}
      onKeyDown={(event) => {
        if (event.key === "Enter") done(true);
        if (event.key === "Escape") done(false);
      }}
    />
  );
}

function Entry({ entry }: { entry: KeptFit }): JSX.Element {
  const naming = useSignal(false);
  const { id, name, likeness, time } = entry;
  return (
    <li data-testid="kept-fit">
      <button
        type="button"
        class="open"
        aria-label={`Open ${name}`}
        title={`Open ${name}`}
        onClick={() => void openFit(entry).catch(sayError)}
      >
        <Goal thumb={entry.thumb} />
      </button>
      <div class="about">
        {naming.value ? (
          <Name
            entry={entry}
            onDone={() => {
              naming.value = false;
            }}
          />
        ) : (
          <h4>{name}</h4>
        )}
        <p class="hint">
          Likeness {likeness.toFixed(2)} · {date.format(time)}
        </p>
        <Check label="Compare" checked={compared.value.includes(id)} onChange={(on) => compare(id, on)} />
      </div>
      <div class="tools">
        <Button
          icon="edit"
          iconOnly
          kind="quiet"
          label={`Rename ${name}`}
          onPress={() => {
            naming.value = true;
          }}
        />
        <Button
          icon="copy"
          iconOnly
          kind="quiet"
          label={`Duplicate ${name}`}
          onPress={() => attempt(() => duplicateFit(entry))}
        />
        <Button
          icon="trash"
          iconOnly
          kind="quiet"
          label={`Delete ${name}`}
          onPress={() => deleteFit(entry)}
        />
      </div>
    </li>
  );
}

export function KeptFits(): JSX.Element | null {
  const all = keptFits.value;
  if (all.length === 0) return null;
  const pair = compared.value.flatMap((id) => all.find((entry) => entry.id === id) ?? []);
  const [one, other] = pair;
  return (
    <section class="keptfits" aria-label="Your fits">
      <h3>Your fits</h3>
      <p class="hint">
        Kept in this browser only, without photographs. Open one to go on with it, or choose two to compare
        them.
      </p>
      <ul>
        {all.map((entry) => (
          <Entry key={entry.id} entry={entry} />
        ))}
      </ul>
      {one && other && <Comparison key={`${one.id} ${other.id}`} one={one} other={other} />}
    </section>
  );
}
