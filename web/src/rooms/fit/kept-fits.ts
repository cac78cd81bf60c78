// Fits that the user keeps: each with its goal, in this browser only. A short list names them; each fit is stored apart,
// so that the list is quick to read and to share between tabs.
import { signal } from "@preact/signals";
import { smallerInk, within } from "../../engine/smaller";
import { packBits, toBase64Url } from "../../state/codec";
import { offer, say } from "../../state/notes";
import { fields, number, type Shape, text, versionOf, whole } from "../../state/shape";
import { keysFrom, load, save } from "../../state/store";
import { newId, StoredList } from "../../state/stored-list";
import { wholeGoal } from "./goal-state";
import { finished, record, shownTree } from "./record";
import {
  isStoredFit,
  isStoredGoal,
  openStored,
  packFit,
  packGoal,
  type StoredFit,
  type StoredGoal,
} from "./stored-fit";

export interface KeptFit {
  id: string;
  name: string;
  /** When it was kept, in milliseconds since 1970. */
  time: number;
  likeness: number;
  /** A small goal. */
  thumb: { width: number; height: number; ink: string };
}

/** Changes with the shape of a fit. */
const VERSION = 1;
export interface StoredWhole {
  version: number;
  goal: StoredGoal;
  fit: StoredFit;
  treeHeight: number;
}
const isWhole: Shape<StoredWhole> = fields({
  version: number,
  goal: isStoredGoal,
  fit: isStoredFit,
  treeHeight: number,
});

export const keptFits = new StoredList<KeptFit>({
  key: "fits",
  version: 1,
  field: "fits",
  is: fields({
    id: text,
    name: text,
    time: number,
    likeness: number,
    thumb: fields({ width: whole, height: whole, ink: text }),
  }),
});

/** Longest side of a small goal in pixels. */
const THUMB = 96;
const FULL = "The browser has no room left for another fit. Delete one, or save the species as a file.";

const NEWER = "A newer version of this page keeps your fits now. Load the page again to change them.";
const BEFORE_ID = "fit.";
const keyOf = (id: string) => BEFORE_ID + id;

/** Why a fit could not be kept. */
const whyNot = () => (keptFits.isNewer() ? NEWER : FULL);

/** No list names them, so that nobody could open or delete them: their entry was damaged. */
function removeUnnamed(): void {
  if (keptFits.isNewer()) return;
  const named = new Set(keptFits.peek().map(({ id }) => keyOf(id)));
  for (const key of keysFrom(BEFORE_ID)) if (!named.has(key)) save(key, null);
}
removeUnnamed();

/** Throws if it is damaged, or of a newer page. */
export function loadWhole({ id, name }: KeptFit): StoredWhole {
  const found = load(keyOf(id));
  if (versionOf(found) === VERSION && isWhole(found)) return found;
  throw new Error(`What the browser has stored of ${name} is damaged or of a newer version of this page.`);
}

/** Stores a fit at this place of the list; false, and nothing, if there is no room or the list is a newer page's. */
function put(entry: KeptFit, stored: unknown, at = 0): boolean {
  if (!save(keyOf(entry.id), stored)) return false;
  if (keptFits.update((list) => [...list.slice(0, at), entry, ...list.slice(at)])) return true;
  save(keyOf(entry.id), null);
  keptFits.update((list) => list.filter(({ id }) => id !== entry.id));
  return false;
}

/** Keeps the fit that is shown. */
export async function keepFit(): Promise<void> {
  const [shown, tree] = [wholeGoal(), shownTree.peek()];
  const fit = await packFit(finished(record.peek()));
  if (!shown || !fit || !tree) return;
  const goal = await packGoal(shown);
  const { width, height } = within(shown.picture, THUMB);
  const small = smallerInk(shown.mask.ink, shown.picture, { width, height });
  const entry: KeptFit = {
    id: newId(),
    name: shown.picture.name.replaceAll("_", " "),
    time: Date.now(),
    likeness: tree.card.likeness,
    thumb: { width, height, ink: toBase64Url(packBits(small)) },
  };
  const whole: StoredWhole = { version: VERSION, goal, fit, treeHeight: shown.treeHeight };
  if (put(entry, whole)) say(`${entry.name} is kept in your fits, below.`);
  else say(whyNot(), "error");
}

/** Its goal becomes the goal, with its tree. */
export async function openFit(entry: KeptFit): Promise<void> {
  await openStored(loadWhole(entry));
  document.getElementById("room")?.scrollTo({ top: 0 });
}

export function renameFit(id: string, name: string): void {
  const named = name.trim();
  if (named === "") return;
  const rename = (entry: KeptFit) => (entry.id === id ? { ...entry, name: named } : entry);
  if (!keptFits.update((list) => list.map(rename))) say(whyNot(), "error");
}

export function duplicateFit(entry: KeptFit): void {
  const at = keptFits.peek().findIndex(({ id }) => id === entry.id);
  const copy = { ...entry, id: newId(), name: `${entry.name}, copy` };
  if (!put(copy, loadWhole(entry), at + 1)) say(whyNot(), "error");
}

export function deleteFit(entry: KeptFit): void {
  const at = keptFits.peek().findIndex(({ id }) => id === entry.id);
  // As it is: what is damaged can be deleted too.
  const stored = load(keyOf(entry.id));
  // A list that still names it needs what is stored of it.
  if (keptFits.isNewer()) {
    say(NEWER, "error");
    return;
  }
  if (!keptFits.update((list) => list.filter(({ id }) => id !== entry.id))) {
    say(`${entry.name} could not be deleted: the browser stores nothing more for this page.`, "error");
    return;
  }
  save(keyOf(entry.id), null);
  compared.value = compared.peek().filter((id) => id !== entry.id);
  const run = () => {
    if (!put(entry, stored, at)) say(whyNot(), "error");
  };
  offer(`${entry.name} is deleted.`, { label: "Undo", run });
}

/** The fits that are compared: at most two, the one that was chosen first in front. */
export const compared = signal<readonly string[]>([]);

export function compare(id: string, on: boolean): void {
  const others = compared.peek().filter((each) => each !== id);
  compared.value = on ? [...others.slice(-1), id] : others;
}
