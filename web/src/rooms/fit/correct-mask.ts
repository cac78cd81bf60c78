// Ways to another mask, for buttons beside what is wrong with this one.
import { pickBrush } from "./goal-editor";
import { canReadAgain } from "./goal-state";

export interface Way {
  label: string;
  run: () => void;
}

/** The goal is in sight, and the choice of a brush has the focus. */
export function showBrush(mode: "add" | "take" | "box"): void {
  pickBrush(mode);
  document.querySelector('[data-testid="goal"]')?.scrollIntoView({ block: "nearest", behavior: "smooth" });
  document.querySelector<HTMLElement>('[data-part="brush"] input:checked')?.focus({ preventScroll: true });
}

const BOX: Way = { label: "Draw a box around the tree", run: () => showBrush("box") };
const ADD: Way = { label: "Paint what is missing", run: () => showBrush("add") };
const TAKE: Way = { label: "Paint away what is too much", run: () => showBrush("take") };

/** By the library's words for what is odd about a goal. What else can be read in its picture is a button of the goal. */
const WAYS: Readonly<Record<string, readonly Way[]>> = {
  photograph: [BOX],
  "by-color": [BOX],
  "doubtful-mask": [BOX, TAKE, ADD],
  "several-pieces": [BOX, TAKE],
  ground: [TAKE],
  noise: [TAKE],
  solid: [BOX],
  "mostly-ink": [BOX],
  outline: [ADD],
};

/** A picture whose file the page does not have any more is only painted. */
const isPossible = (way: Way) => canReadAgain() || way === ADD || way === TAKE;

export const waysFor = (kind: string): readonly Way[] => (WAYS[kind] ?? []).filter(isPossible);

/** All that may mend a mask. */
export const anyWay = (): readonly Way[] => [TAKE, ADD, BOX].filter(isPossible);
