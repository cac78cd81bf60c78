// The goal and its fit survive a reload, as one. Photographs do not: they would fill the browser's store.
import { effect } from "@preact/signals";
import { say } from "../../state/notes";
import type { Linked } from "../../state/route";
import { fields, number, orNull, type Shape, versionOf } from "../../state/shape";
import { debounce, load, save } from "../../state/store";
import { running, seconds } from "./fit-state";
import { masks, picture, takeTarget, treeHeight, wholeGoal } from "./goal-state";
import { finished, record } from "./record";
import {
  isStoredFit,
  isStoredGoal,
  openStored,
  packFit,
  packGoal,
  type StoredFit,
  type StoredGoal,
} from "./stored-fit";

/** Changes with the shape of what is stored: another one is not read. */
const VERSION = 1;

interface Saved {
  version: number;
  goal: StoredGoal;
  /** Of this goal, or null. */
  fit: StoredFit | null;
  treeHeight: number;
  seconds: number;
}

const isSaved: Shape<Saved> = fields({
  version: number,
  goal: isStoredGoal,
  fit: orNull(isStoredFit),
  treeHeight: number,
  seconds: number,
});

let saves = 0;
/** Whether the user knows that the browser has no room. */
let toldFull = false;

/** What does not fit must not leave the fit of another goal in its place. */
function store(saved: Saved): void {
  if (save("fit", saved)) return;
  save("fit", null);
  if (toldFull) return;
  toldFull = true;
  say("The browser has no room left for this goal and its fit: a reload would lose them.", "error");
}

async function saveAll(): Promise<void> {
  const mine = ++saves;
  const shown = wholeGoal();
  if (!shown) return;
  const time = seconds.peek();
  // While the same goal is fitted again, the fit that it has is kept.
  const fit = await packFit(finished(record.peek()));
  const goal = await packGoal(shown);
  const saved: Saved = { version: VERSION, goal, fit, treeHeight: shown.treeHeight, seconds: time };
  // Packing takes a moment, in which a newer state may have come.
  if (mine === saves) store(saved);
}

/** What earlier pages stored apart: a goal, and a result that may have been another's. */
const OLD = ["goal", "result", "result.2"];

export async function restoreFit(): Promise<void> {
  for (const key of OLD) save(key, null);
  const saved = load("fit");
  try {
    if (versionOf(saved) === VERSION) {
      if (!isSaved(saved)) throw new Error("A field is missing.");
      await openStored(saved);
      seconds.value = saved.seconds;
    }
  } catch {
    // It would fail at each reload; and what comes now is to be stored all the same.
    save("fit", null);
    say("What the browser has stored of the last fit is damaged, and was cleared.", "error");
  }
  const queue = debounce(500, () => void saveAll());
  effect(() => {
    picture.value;
    masks.value;
    treeHeight.value;
    seconds.value;
    // A search that runs is not stored: what it has found so far changes several times a second.
    if (running.value) return;
    record.value;
    queue();
  });
}

/** A goal that the page brings is part of the link; a picture of the user's own never leaves the page. */
export const fitLink: Linked = {
  write(fields) {
    const target = picture.value?.target;
    if (!target) return;
    fields.set("goal", target.replace(/\.png$/, ""));
    fields.set("height", String(treeHeight.value));
  },

  async read(fields) {
    const name = fields.get("goal");
    if (!name || !/^[a-z0-9_]+$/.test(name) || picture.peek()?.target === `${name}.png`) return;
    const height = Number(fields.get("height"));
    await takeTarget(`${name}.png`, height > 0 && height <= 200 ? height : null);
  },
};
