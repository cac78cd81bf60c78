// Short notes at the edge of the page, and one line that screen readers hear.
import { signal } from "@preact/signals";
import { Cancelled } from "../engine/client";

export interface Note {
  id: number;
  kind: "info" | "error";
  text: string;
}

export const notes = signal<readonly Note[]>([]);
/** The live region's text. */
export const announced = signal("");

let nextId = 1;

export function say(text: string, kind: Note["kind"] = "info"): void {
  if (notes.peek().some((note) => note.text === text)) return;
  const note = { id: nextId++, kind, text };
  notes.value = [...notes.peek().slice(-2), note];
  if (kind === "info") setTimeout(() => dismiss(note.id), 5000);
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
