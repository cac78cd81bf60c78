// The open species with another: a way between two.
import type { JSX } from "preact";
import { families } from "../../engine/catalogue";
import type { SpeciesSource } from "../../engine/protocol";
import { blendWith, endBlend, moveBlend, pair } from "../../state/blend";
import { mySpecies } from "../../state/library";
import { opened, recipes, speciesName } from "../../state/species";
import { Field } from "../../ui/controls";

const said = (name: string) => name.replaceAll("_", " ");
/** Of a species that was removed from the user's own since. */
const GONE = "gone:";

export function Blend(): JSX.Element | null {
  const species = opened.value;
  // Each grammar has parameters of its own.
  if (!species || species.grammar !== null) return null;
  const now = pair.value;
  const built = families.find(({ family }) => family === species.info.generator)?.species ?? [];
  const keyOf = (source: SpeciesSource): string => {
    if ("builtin" in source) return `built:${source.builtin}`;
    const kept = mySpecies.value.find(({ toml }) => toml === source.toml);
    return kept ? `mine:${kept.id}` : GONE;
  };
  const own = keyOf(now ? now.from.spec.source : recipes.value.source);
  const to = now ? keyOf(now.to.spec.source) : "";
  const others = [
    ...built.map(({ name }) => ({ key: `built:${name}`, name, source: { builtin: name } })),
    ...mySpecies.value.map(({ id, name, toml }) => ({ key: `mine:${id}`, name, source: { toml, name } })),
  ].filter(({ key }) => key !== own);
  const pick = (picked: string) => {
    const other = others.find(({ key }) => key === picked);
    if (other) blendWith(other.source, other.name);
    else if (picked === "") endBlend();
  };
  return (
    <div class="pair">
      <Field label="Blend with">
        {(id) => (
          <select
            id={id}
            value={to}
            data-testid="blend-with"
            onChange={(event) => pick(event.currentTarget.value)}
          >
            <option value="">nothing</option>
            {others.map(({ key, name }) => (
              <option key={key} value={key}>
                {said(name)}
              </option>
            ))}
            {now && to === GONE && <option value={GONE}>{said(now.to.name)}</option>}
          </select>
        )}
      </Field>
      {now && (
        <Field label={`${Math.round(100 * now.at)} % ${said(now.to.name)}`}>
          {(id) => (
            <input
              id={id}
              type="range"
              min={0}
              max={1}
              step={0.05}
              value={now.at}
              aria-label={`How much of ${said(now.to.name)} is in ${said(speciesName.value)}`}
              data-testid="blend-at"
              onInput={(event) => moveBlend(event.currentTarget.valueAsNumber)}
            />
          )}
        </Field>
      )}
    </div>
  );
}
