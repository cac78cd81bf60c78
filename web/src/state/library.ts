// "My species": species files that the user keeps, in this browser only.
import { signal } from "@preact/signals";
import { say } from "./notes";
import { load, save } from "./store";

export interface Kept {
  id: string;
  name: string;
  toml: string;
}

export const mySpecies = signal<readonly Kept[]>(load<Kept[]>("species", []));

function store(list: readonly Kept[]): boolean {
  mySpecies.value = list;
  return save("species", list);
}

export function keepSpecies(name: string, toml: string): void {
  const id = `${Date.now().toString(36)}${Math.floor(Math.random() * 1296).toString(36)}`;
  const kept = store([{ id, name, toml }, ...mySpecies.peek()]);
  say(
    kept
      ? `${name} is kept in my species, in the gallery.`
      : `${name} is in my species until the page is closed: this browser keeps no more data. Download it.`,
  );
}

export function dropSpecies(id: string): void {
  store(mySpecies.peek().filter((kept) => kept.id !== id));
}
