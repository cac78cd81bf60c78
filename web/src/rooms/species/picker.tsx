// The species by name: the user's own, then all built-in ones by family.
import type { JSX } from "preact";
import { families } from "../../engine/catalogue";
import { familyTitle } from "../../state/families";
import { mySpecies } from "../../state/library";
import { recipes, speciesName, startOrSay } from "../../state/species";
import { Field } from "../../ui/controls";

/** The value of the entry for a species that is in no list. */
const OTHER = "other:";

export function Picker(): JSX.Element {
  const { source } = recipes.value;
  const own = "toml" in source ? mySpecies.value.find((kept) => kept.toml === source.toml) : undefined;
  const value = "builtin" in source ? `built:${source.builtin}` : own ? `mine:${own.id}` : OTHER;
  const pick = (picked: string) => {
    const [kind, key = ""] = picked.split(":", 2);
    const kept = mySpecies.peek().find((each) => each.id === key);
    if (kind === "built") void startOrSay({ builtin: key });
    else if (kind === "mine" && kept) void startOrSay({ toml: kept.toml, name: kept.name });
  };
  return (
    <Field label="Start from">
      {(id) => (
        <select id={id} value={value} onChange={(event) => pick(event.currentTarget.value)}>
          {value === OTHER && <option value={OTHER}>{speciesName.value.replaceAll("_", " ")}</option>}
          {mySpecies.value.length > 0 && (
            <optgroup label="My species">
              {mySpecies.value.map((kept) => (
                <option key={kept.id} value={`mine:${kept.id}`}>
                  {kept.name.replaceAll("_", " ")}
                </option>
              ))}
            </optgroup>
          )}
          {families.map(({ family, species }) => (
            <optgroup key={family} label={familyTitle(family)}>
              {species.map(({ name }) => (
                <option key={name} value={`built:${name}`}>
                  {name.replaceAll("_", " ")}
                </option>
              ))}
            </optgroup>
          ))}
        </select>
      )}
    </Field>
  );
}
