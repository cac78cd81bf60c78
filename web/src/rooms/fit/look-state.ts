// What is in the goal's picture, as it is read and corrected.
import { computed, effect, signal } from "@preact/signals";
import { goalClient } from "../../engine/clients";
import type { Look, SeenColors } from "../../engine/protocol";
import { debounce } from "../../state/store";
import { corrections, type GoalPicture, goalPixels, masks, photoPixels, picture } from "./goal-state";

const latest = signal<{ on: GoalPicture; look: Look } | null>(null);

/** Null until the picture has been read, and where its mask has no tree. */
export const look = computed(() =>
  latest.value?.on === picture.value ? (latest.value?.look ?? null) : null,
);

/** Whether it is drawn over the goal. */
export const lookShown = signal(true);

/** What the pixels of the goal are, where its colours tell. */
export const layers = computed(() => {
  const found = look.value?.layers;
  return lookShown.value && found && found.length > 0 ? found : null;
});

/** Milliseconds without a change before the picture is read again: reading takes about as long. */
const PAUSE = 250;

let asked = 0;
let pending: Promise<void> = Promise.resolve();

function read(): void {
  const goal = goalPixels();
  const on = picture.peek();
  const mine = ++asked;
  if (!goal || !on) return;
  const input = { goal, photo: photoPixels(), corrections: corrections.peek() };
  pending = goalClient
    .call("goalLook", input)
    .then((found) => {
      if (mine === asked) latest.value = { on, look: found };
    })
    .catch(() => {
      // A mask without a tree: the editor says so.
      if (mine === asked) latest.value = null;
    });
}

const readSoon = debounce(PAUSE, read);

effect(() => {
  picture.value;
  masks.value;
  readSoon();
});

/** Colours of the goal as it is now, once they are seen; null where its picture has none. */
export async function seenColors(): Promise<SeenColors | null> {
  read();
  await pending;
  const found = look.peek();
  const colors = found?.found.colors;
  return colors ? { json: JSON.stringify(colors), layers: found.layers } : null;
}
