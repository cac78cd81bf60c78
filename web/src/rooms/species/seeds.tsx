// Eight trees of the same species at once: a click takes one.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { change, recipes, spec } from "../../state/species";
import { Button, Field, NumberInput } from "../../ui/controls";
import { Thumb } from "../../ui/thumb";

const MANY = 8;

export function Seeds(): JSX.Element {
  const { seed, season } = recipes.value;
  const first = useSignal(Math.max(1, seed - (seed % MANY)));
  const list = Array.from({ length: MANY }, (_, at) => first.value + at);
  return (
    <section class="seeds" aria-label="Eight seeds">
      <div class="seedbar">
        <Field label="Seed">
          {(id) => (
            <NumberInput
              id={id}
              value={seed}
              min={0}
              max={2 ** 53 - 1}
              step={1}
              onChange={(next) => change({ seed: next }, "seed")}
            />
          )}
        </Field>
        <Button
          label="Previous"
          kind="quiet"
          disabled={first.value <= 1}
          onPress={() => {
            first.value = Math.max(1, first.value - MANY);
          }}
        />
        <Button
          label="Next"
          kind="quiet"
          onPress={() => {
            first.value += MANY;
          }}
        />
      </div>
      <ul class="strip">
        {list.map((each) => (
          <li key={each}>
            <button type="button" aria-pressed={each === seed} onClick={() => change({ seed: each })}>
              <Thumb
                spec={spec.value}
                seed={each}
                season={season}
                size={144}
                name={`Seed ${each}`}
                wait={500}
              />
              <span>Seed {each}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
