// The grammar of the species room as text: what is typed, what the library says of it, and the species it becomes.
import { batch, computed, effect, signal } from "@preact/signals";
import { speciesClient } from "../../engine/clients";
import { Latest } from "../../engine/latest";
import type { Remark, SpeciesSource } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import { opened, openSource, recipes, spec, speciesName } from "../../state/species";
import { debounce } from "../../state/store";
import { failedLine, failure } from "./tree-state";

/** What is typed, and the species that the room has had since. */
const draft = signal<{ text: string; source: SpeciesSource } | null>(null);
/** What the library says of a text. */
const checked = signal<{ text: string; remarks: readonly Remark[] } | null>(null);

/** The text of the species, with line ends as a field has them. */
const written = computed(() => opened.value?.grammar?.replaceAll(/\r\n?/g, "\n") ?? null);

/** The text of the field; null for species of other families. Another species takes the place of what is typed. */
export const grammar = computed(() =>
  draft.value?.source === recipes.value.source ? draft.value.text : written.value,
);

const isBroken = computed(
  () => checked.value?.text === grammar.value && checked.value.remarks.some((remark) => !remark.warning),
);

/** Where the tree does not grow though the grammar can be read. */
const unable = computed<Remark | null>(() => {
  const line = failedLine.value;
  if (line === null || failure.value === null || isBroken.value) return null;
  const end = (grammar.value?.split("\n")[line - 1]?.length ?? 0) + 1;
  return {
    line,
    column: 1,
    end_line: line,
    end_column: end,
    warning: false,
    message: failure.value,
    help: null,
  };
});

/** Whether the tree beside the text is that of an earlier one. */
export const isBehind = computed(() => isBroken.value || unable.value !== null);

/** Those of the present text, or of the one before until the library has read this one. */
export const remarks = computed<readonly Remark[]>(() => {
  const found = checked.value?.remarks ?? [];
  return unable.value ? [...found, unable.value].sort((a, b) => a.line - b.line) : found;
});

/** Milliseconds without a key before the text is read. */
const QUIET = 200;

const reader = new Latest<string>(async (text) => {
  const now = spec.peek();
  const isPresent = () => grammar.peek() === text && spec.peek() === now;
  const { toml, remarks } = await speciesClient.call("grammar", { spec: now, text });
  const isNew = toml !== null && text !== written.peek();
  const source = isNew ? { toml, name: speciesName.peek() } : null;
  // Before it takes its place, so that the room is never without a species.
  if (source) await openSource(source);
  if (!isPresent()) return readSoon();
  batch(() => {
    checked.value = { text, remarks };
    if (!source) return;
    draft.value = { text, source };
    // Texts that follow each other closely are one step back.
    recipes.push({ ...recipes.peek(), source, values: null }, "grammar");
  });
}, sayError);

const readSoon = debounce(QUIET, () => {
  const text = grammar.peek();
  if (text !== null && checked.peek()?.text !== text) reader.ask(text);
});

export function type(text: string): void {
  draft.value = { text, source: recipes.peek().source };
  readSoon();
}

/** While the field is shown, the library reads each text that comes into it. */
export const watchGrammar = (): (() => void) =>
  effect(() => {
    if (grammar.value !== null) readSoon();
  });
