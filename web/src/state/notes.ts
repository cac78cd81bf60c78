// Short notes at the edge of the page, and one line that screen readers hear.
import { signal } from "@preact/signals";
import { Cancelled } from "../engine/client";

export interface Note {
  id: number;
  kind: "info" | "error";
  text: string;
  action: Action | null;
}

/** A button of a note, which goes once it is pressed. */
export interface Action {
  label: string;
  run: () => void;
}

export const notes = signal<readonly Note[]>([]);
/** The live region's text. */
export const announced = signal("");

let nextId = 1;

/** Long enough to read a note, and to decide about one with a button, in milliseconds. */
const SHORT = 5000;
const LONG = 15_000;

function add(text: string, kind: Note["kind"], action: Action | null, time: number | null): void {
  const others = notes.peek().filter((note) => note.text !== text);
  const note = { id: nextId++, kind, text, action };
  notes.value = [...others.slice(-2), note];
  if (time !== null) setTimeout(() => dismiss(note.id), time);
}

export function say(text: string, kind: Note["kind"] = "info"): void {
  if (notes.peek().some((note) => note.text === text)) return;
  add(text, kind, null, kind === "info" ? SHORT : null);
}

/** A note with a button. One that `stays` is there until it is pressed or closed. */
export function offer(text: string, action: Action, stays = false): void {
  add(text, "info", action, stays ? null : LONG);
}

export function dismiss(id: number): void {
  notes.value = notes.peek().filter((note) => note.id !== id);
}

export function announce(text: string): void {
  announced.value = text;
}

/** The sentence of an error, or null for a call that was given up on purpose. */
export function sentence(error: unknown): string | null {
  if (error instanceof Cancelled) return null;
  return error instanceof Error ? error.message : String(error);
}

export function sayError(error: unknown): void {
  const text = sentence(error);
  if (text !== null) say(text, "error");
}
