// "My species": species files that the user keeps, in this browser only.
import { say } from "./notes";
import { fields, text } from "./shape";
import { newId, StoredList } from "./stored-list";

export interface Kept {
  id: string;
  name: string;
  toml: string;
}

export const mySpecies = new StoredList<Kept>({
  key: "species",
  version: 1,
  field: "species",
  is: fields({ id: text, name: text, toml: text }),
});

export function keepSpecies(name: string, toml: string): void {
  const kept = mySpecies.update((list) => [{ id: newId(), name, toml }, ...list]);
  say(
    kept
      ? `${name} is kept in my species, in the gallery.`
      : `${name} is in my species until the page is closed: this browser keeps no more data. Download it.`,
  );
}

export function dropSpecies(id: string): void {
  mySpecies.update((list) => list.filter((kept) => kept.id !== id));
}
