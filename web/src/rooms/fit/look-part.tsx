// What was read in the goal, in words, with what can be said of it by number or colour.
import type { JSX } from "preact";
import type { Tint, Told } from "../../engine/protocol";
import { Button, Check, Field, NumberInput } from "../../ui/controls";
import { running } from "./fit-state";
import { asRead, correct, corrections } from "./goal-state";
import { type Found, measure } from "./look-measures";
import { look, lookShown } from "./look-state";

export const PART_ID = "look-part";

const TINTS: readonly { tint: Tint; label: string }[] = [
  { tint: "leaf", label: "Leaf colour" },
  { tint: "bark", label: "Bark colour" },
];

/** Where the handle of a measure appears that was not read, in heights or degrees. */
const MISSED: readonly { key: Told; label: string; from: number }[] = [
  { key: "first_fork", label: "Add a fork", from: 0.3 },
  { key: "bare_height", label: "Add a bare height", from: 0.2 },
  { key: "lean_deg", label: "Add a lean", from: 0 },
  { key: "trunk_width", label: "Add a trunk width", from: 0.04 },
];

/** Handles for what was not read. */
function Missed({ found }: { found: Found }): JSX.Element | null {
  const missed = MISSED.filter(({ key }) => measure(key, found) === null);
  if (missed.length === 0) return null;
  return (
    <div class="row wrap">
      {missed.map(({ key, label, from }) => (
        <Button
          key={key}
          kind="quiet"
          label={label}
          disabled={running.value}
          onPress={() => {
            lookShown.value = true;
            correct({ [key]: from });
          }}
        />
      ))}
    </div>
  );
}

function Colors({ found }: { found: Found }): JSX.Element | null {
  const { colors } = found;
  if (!colors || colors.leaves === null) return null;
  const seen = TINTS.flatMap((each) => {
    const color = corrections.value.colors?.[each.tint] ?? colors[each.tint];
    return color ? [{ ...each, color }] : [];
  });
  return (
    <div class="pair">
      {seen.map(({ tint, label, color }) => (
        <Field key={tint} label={label}>
          {(id) => (
            <input
              id={id}
              type="color"
              value={color}
              disabled={running.value}
              onChange={(event) => correct({ colors: { [tint]: event.currentTarget.value } })}
            />
          )}
        </Field>
      ))}
    </div>
  );
}

export function LookPart(): JSX.Element {
  const seen = look.value;
  return (
    <section class="part" aria-label="What was read" id={PART_ID}>
      <h3>What was read in it</h3>
      <Check
        label="Show it over the goal"
        checked={lookShown.value}
        onChange={(on) => {
          lookShown.value = on;
        }}
      />
      {seen ? (
        <>
          <p class="hint">
            If you see it better, drag the handles. The search then prefers trees that agree with you.
          </p>
          <Field label="Trunks">
            {(id) => (
              <NumberInput
                id={id}
                min={1}
                max={64}
                step={1}
                disabled={running.value}
                value={measure("trunks", seen.found) ?? 1}
                onChange={(trunks) => correct({ trunks })}
              />
            )}
          </Field>
          {seen.anchor && <Missed found={seen.found} />}
          <Colors found={seen.found} />
          <details>
            <summary>All measures</summary>
            <table class="readtable" data-testid="reading-table">
              <thead>
                <tr>
                  <th scope="col">Measure</th>
                  <th scope="col">Read</th>
                  <th scope="col">Sure</th>
                </tr>
              </thead>
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
          </details>
        </>
      ) : (
        <p class="hint">The picture is being read.</p>
      )}
      {Object.keys(corrections.value).length > 0 && (
        <Button kind="quiet" label="As it was read" disabled={running.value} onPress={asRead} />
      )}
    </section>
  );
}
