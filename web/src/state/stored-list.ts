// A list that the browser stores, with a version. All tabs share it.
import { signal } from "@preact/signals";
import { type Shape, versionOf } from "./shape";
import { load, onStored, save } from "./store";

interface How<T> {
  /** In the browser's store. */
  key: string;
  /** Changes with the shape of the entries. A newer page's list is neither read nor written over. */
  version: number;
  /** Of the list in what is stored. */
  field: string;
  /** Entries of another shape are left out. */
  is: Shape<T>;
}

export class StoredList<T> {
  private readonly all = signal<readonly T[]>([]);

  constructor(private readonly how: How<T>) {
    this.all.value = this.stored() ?? [];
    onStored(how.key, () => {
      this.all.value = this.stored() ?? this.all.peek();
    });
  }

  get value(): readonly T[] {
    return this.all.value;
  }

  peek(): readonly T[] {
    return this.all.peek();
  }

  /** A newer page has written the list: this one cannot change it. */
  isNewer(): boolean {
    return this.stored() === null;
  }

  /** Changes the list as it is stored, which another tab may have changed. False if it could not be stored. */
  update(change: (list: readonly T[]) => readonly T[]): boolean {
    const known = this.stored();
    const list = change(known ?? this.all.peek());
    this.all.value = list;
    const { key, version, field } = this.how;
    return known !== null && save(key, { version, [field]: list });
  }

  /** Pages before the first version stored the bare list. Null if a newer page has written it. */
  private stored(): readonly T[] | null {
    const { key, version, field, is } = this.how;
    const found = load(key);
    const theirs = versionOf(found);
    if (theirs !== null && theirs !== version) return null;
    const all = theirs === null ? found : (found as Record<string, unknown>)[field];
    return Array.isArray(all) ? all.filter(is) : [];
  }
}

export const newId = () =>
  `${Date.now().toString(36)}${Math.floor(Math.random() * 46_656)
    .toString(36)
    .padStart(3, "0")}`;
