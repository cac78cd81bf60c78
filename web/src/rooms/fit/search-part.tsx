// What to search: height, leaves, family, and for how long.
import type { JSX } from "preact";
import { families } from "../../engine/catalogue";
import { familyTitle } from "../../state/families";
import { Check, Field, NumberInput, Segmented } from "../../ui/controls";
import { BUDGETS, generator, individual, leafiness, running, seconds } from "./fit-state";
import { treeHeight } from "./goal-state";

export const HEIGHT_ID = "tree-height";

/** A time in words. */
export const timeText = (seconds: number): string => (seconds < 100 ? `${seconds} s` : `${seconds / 60} min`);

export function SearchPart(): JSX.Element {
  return (
    <section class="part" aria-label="Search">
      <h3>Search</h3>
      <div class="pair">
        <Field label="Height, m" id={HEIGHT_ID}>
          {(id) => (
            <NumberInput
              id={id}
              value={treeHeight.value}
              min={0.1}
              max={200}
              disabled={running.value}
              onChange={(next) => {
                treeHeight.value = next;
              }}
            />
          )}
        </Field>
        <Field label="Leaves">
          {(id) => (
            <select
              id={id}
              value={leafiness.value}
              disabled={running.value}
              onChange={(event) => {
                leafiness.value = event.currentTarget.value as typeof leafiness.value;
              }}
            >
              <option value="auto">as it looks</option>
              <option value="on">leafy</option>
              <option value="off">bare</option>
            </select>
          )}
        </Field>
      </div>
      <Field label="Family">
        {(id) => (
          <select
            id={id}
            value={generator.value}
            disabled={running.value}
            onChange={(event) => {
              generator.value = event.currentTarget.value;
            }}
          >
            <option value="">what suits the picture</option>
            <option value="trees">natural trees</option>
            <option value="auto">any family</option>
            {families.map(({ family }) => (
              <option key={family} value={family}>
                {familyTitle(family)}
              </option>
            ))}
          </select>
        )}
      </Field>
      <Field label="Time to search">
        {() => (
          <Segmented
            label="Time to search"
            value={String(seconds.value)}
            disabled={running.value}
            options={BUDGETS.map((value) => ({
              value: String(value),
              label: timeText(value),
            }))}
            onPick={(picked) => {
              seconds.value = Number(picked);
            }}
          />
        )}
      </Field>
      <Check
        label="Look for this very tree too"
        checked={individual.value}
        disabled={running.value}
        onChange={(next) => {
          individual.value = next;
        }}
      />
    </section>
  );
}
