// What is in the goal's picture, and what the user says is otherwise.
import { effect, signal } from "@preact/signals";
import { goalClient } from "../../engine/clients";
import type { Corrections, Look } from "../../engine/protocol";
import { debounce } from "../../state/store";
import { corrections, goalPixels, masks, photoPixels, picture } from "./goal-state";

export const look = signal<Look | null>(null);

/** Milliseconds without a change before the picture is read again: reading takes about as long. */
const PAUSE = 250;

let asked = 0;
let pending: Promise<void> = Promise.resolve();

function read(): void {
  const goal = goalPixels();
  const mine = ++asked;
  if (!goal) return;
  const input = {
    goal,
    photo: photoPixels(),
    corrections: corrections.peek(),
  };
  pending = goalClient
    .call("goalLook", input)
    .then((found) => {
      if (mine === asked) look.value = found;
    })
    .catch(() => {
      // A mask without a tree: the editor says so.
      if (mine === asked) look.value = null;
    });
}

const readSoon = debounce(PAUSE, read);

effect(() => {
  picture.value;
  masks.value;
  corrections.value;
  readSoon();
});

/** Colours of the goal as it is now, once they are seen; null where its picture has none. */
export async function seenColors(): Promise<string | null> {
  read();
  await pending;
  const colors = look.peek()?.found.colors;
  return colors ? JSON.stringify(colors) : null;
}

export function correct(key: keyof Corrections, value: number): void {
  corrections.value = { ...corrections.peek(), [key]: value };
}
