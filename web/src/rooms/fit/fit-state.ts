// The running search.
import { computed, effect, signal } from "@preact/signals";
import type { FitOptions, FitProgress, GoalPixels } from "../../engine/protocol";
import { type FitEvents, FitSession } from "../../engine/session";
import { familyTitle } from "../../state/families";
import { announce, say, sentence } from "../../state/notes";
import { corrections, type GoalPicture, goalError, goalPixels, picture, treeHeight } from "./goal-state";
import { seenColors } from "./look-state";
import { type CurvePoint, change, type Fitted, finished, guess, record, shownTree } from "./record";

/** "trying": generators that the goal may be of, one after the other. */
export type Phase = "idle" | "guessing" | "trying" | "searching" | "paused" | "judging";

export const phase = signal<Phase>("idle");
export const stage = signal<{ text: string; share: number | null }>({ text: "", share: null });
export const progress = signal<FitProgress | null>(null);
export const elapsed = signal(0);
export const failure = signal<string | null>(null);
/** Times to search, in seconds. */
export const BUDGETS = [10, 30, 60, 180, 600] as const;
export const seconds = signal(30);
/** A family or a choice of the library's, or "" for what the library chooses by the picture. */
export const generator = signal("");
export const leafiness = signal<NonNullable<FitOptions["leaves"]>>("auto");
/** Whether this very tree is looked for after its kind. */
export const individual = signal(true);

/** Options that no control of the page sets: see `studio` in main.tsx. */
export const told: { options: FitOptions } = { options: {} };

export const running = computed(() => phase.value !== "idle");
export const rate = computed(() => {
  const count = progress.value?.evaluations ?? 0;
  return elapsed.value > 0.5 ? count / elapsed.value : null;
});

let session: FitSession | null = null;
/** The picture that it looks at. */
let searched: GoalPicture | null = null;

/** Points on the curve: more than a screen shows would cost time and say nothing. */
const MAX_POINTS = 400;

function withPoint(points: readonly CurvePoint[], point: CurvePoint): readonly CurvePoint[] {
  const last = points.at(-1);
  if (last && point.seconds - last.seconds < Math.max(0.1, point.seconds / MAX_POINTS)) return points;
  return [...points, point];
}

function optionsNow(more: FitOptions): FitOptions {
  return {
    height: treeHeight.peek(),
    ...(generator.peek() === "" ? {} : { generator: generator.peek() }),
    timeout: seconds.peek(),
    leaves: leafiness.peek(),
    individual: individual.peek() ? "share" : "off",
    reading: corrections.peek(),
    ...more,
    ...told.options,
  };
}

/** What a search says, put into the record of its fit, for as long as it `isCurrent`. */
function events(id: number, goal: GoalPixels, isCurrent: () => boolean): FitEvents {
  const { ink, width, height } = goal;
  let said = 0;
  return {
    stage(now) {
      if (!isCurrent()) return;
      const share = now.done !== undefined && now.all ? now.done / now.all : null;
      stage.value = { text: now.stage, share };
      if (phase.peek() === "searching") phase.value = "judging";
    },
    began() {
      if (!isCurrent()) return;
      record.value = {
        id,
        width,
        height,
        goal: ink,
        guess: null,
        curve: [],
        best: null,
        soFar: null,
        result: null,
        earlier: finished(record.peek()),
      };
    },
    nearest({ ink, toml }) {
      if (!isCurrent() || record.peek()?.id !== id) return;
      change({ best: { ink, ownInk: null }, soFar: toml });
    },
    tries({ family, number, count }) {
      if (!isCurrent()) return;
      stage.value = { text: `Trying ${familyTitle(family)}, search ${number} of ${count}`, share: null };
      if (phase.peek() !== "paused") phase.value = "trying";
    },
    guessed(guess) {
      if (!isCurrent() || record.peek()?.id !== id) return;
      change({ guess });
      if (phase.peek() !== "paused") phase.value = "searching";
      announce("The search begins");
    },
    step(now, time, found) {
      if (!isCurrent() || record.peek()?.id !== id) return;
      progress.value = now;
      elapsed.value = time;
      const { likeness, iou } = now;
      const points = record.peek()?.curve ?? [];
      // Each generator starts from the beginning: the curve is that of the search.
      const curve =
        guess.peek() && likeness !== null && iou !== null
          ? withPoint(points, { seconds: time, likeness, iou })
          : points;
      if (found) change({ curve, best: { ink: found.ink, ownInk: null }, soFar: found.toml });
      else if (curve !== points) change({ curve });
      // Screen readers hear of it now and then, not forty times a second.
      if (likeness !== null && time - said > 10) {
        said = time;
        announce(`${Math.round(time)} seconds, likeness ${likeness.toFixed(2)}`);
      }
    },
  };
}

/** What remains of a search without a result: the fit before it, unless that had less. */
function fallBack(earlier: Fitted | null): void {
  const now = record.peek();
  if (!earlier || now?.result) return;
  if (earlier.result || !now?.best) record.value = earlier;
}

/** With more options than the page's controls say. */
export async function startFit(more: FitOptions = {}): Promise<void> {
  const goal = goalPixels();
  const id = picture.peek()?.id;
  if (!goal || id === undefined || running.peek()) return;
  // On a telephone the pictures are above the button. Not now: the page would have to be laid out for it.
  const up = () => document.getElementById("room")?.scrollTo({ top: 0, behavior: "smooth" });
  requestAnimationFrame(up);
  phase.value = "guessing";
  failure.value = null;
  goalError.value = null;
  progress.value = null;
  elapsed.value = 0;
  const earlier = record.peek();
  const isGoal = () => picture.peek()?.id === id;
  const isCurrent = () => session === mine && isGoal();
  const mine = new FitSession(goal, seenColors, optionsNow(more), events(id, goal, isCurrent));
  searched = picture.peek();
  session = mine;
  try {
    const { ink, ownInk, result } = await mine.run();
    if (!isCurrent() || record.peek()?.id !== id) return;
    change({ best: { ink, ownInk }, result, soFar: null, earlier: null });
    const likeness = shownTree.peek()?.card.likeness ?? result.report.likeness;
    announce(`The fit has ended with likeness ${likeness.toFixed(2)}`);
  } catch (error) {
    failure.value = sentence(error);
    if (isGoal()) fallBack(earlier);
  } finally {
    session = null;
    phase.value = "idle";
  }
}

// A search is of one goal, and ends with it.
effect(() => {
  const { id, name } = picture.value ?? {};
  if (session && searched && searched.id !== id) {
    session.cancel();
    say(`The search for ${searched.name} has ended: ${name} is the goal now.`);
  }
});

export function pauseFit(): void {
  session?.pause();
  phase.value = "paused";
}

export function resumeFit(): void {
  session?.resume();
  phase.value = guess.peek() ? "searching" : "trying";
}

/** Ends the search; the best so far is judged. */
export function stopFit(): void {
  if (phase.peek() === "guessing" || phase.peek() === "judging") {
    session?.cancel();
    return;
  }
  phase.value = "searching";
  session?.stop();
}
