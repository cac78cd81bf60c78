// The running fit and its result.
import { computed, signal } from "@preact/signals";
import type { Card, FitOptions, FitProgress, FitResult, Guess } from "../../engine/protocol";
import { FitSession } from "../../engine/session";
import { announce, sentence } from "../../state/notes";
import { corrections, goalPixels, treeHeight } from "./goal-state";
import { seenColors } from "./look-state";

export type Phase = "idle" | "guessing" | "searching" | "paused" | "judging" | "done";

export const phase = signal<Phase>("idle");
export const stage = signal<{ text: string; share: number | null }>({ text: "", share: null });
export const guess = signal<Guess | null>(null);
export const progress = signal<FitProgress | null>(null);
export const elapsed = signal(0);
export const failure = signal<string | null>(null);
export const result = signal<FitResult | null>(null);

/** The best tree so far, in the goal's frame. */
export interface Best {
  ink: Uint8Array<ArrayBuffer>;
  /** This very tree, once it was found. */
  ownInk: Uint8Array<ArrayBuffer> | null;
  width: number;
  height: number;
  /** The goal that it was fitted to, which may be painted over since. */
  goal: Uint8Array<ArrayBuffer>;
}
export const best = signal<Best | null>(null);

/** Which of the trees that were found is shown and saved: the goal's own, or one of its kind. */
export type Which = "own" | "kind";
export const which = signal<Which>("own");

/** The same, where there is one of its own. */
export const shownWhich = computed<Which>(() => (best.value?.ownInk ? which.value : "kind"));

export const shownInk = computed(() => {
  const now = best.value;
  return now && ((shownWhich.value === "own" && now.ownInk) || now.ink);
});

/** The species file and the scores of the tree that is shown. */
export const shownTree = computed<{ name: string; toml: string; card: Card } | null>(() => {
  const fit = result.value;
  if (!fit) return null;
  const { report, toml, own_toml: own } = fit;
  const name = report.species;
  if (shownWhich.value === "own" && own !== null && report.individual) {
    return { name, toml: own, card: report.individual };
  }
  return { name, toml, card: report };
});
/** Its species, while the search runs and if it fails. */
export const bestToml = signal<string | null>(null);

export interface CurvePoint {
  seconds: number;
  likeness: number;
  iou: number;
}
export const curve = signal<readonly CurvePoint[]>([]);

export const seconds = signal(30);
export const generator = signal("weber-penn");
export const leafiness = signal<NonNullable<FitOptions["leaves"]>>("auto");
/** Whether this very tree is looked for after its kind. */
export const individual = signal(true);

export const running = computed(() => !["idle", "done"].includes(phase.value));
export const rate = computed(() => {
  const count = progress.value?.evaluations ?? 0;
  return elapsed.value > 0.5 ? count / elapsed.value : null;
});

let session: FitSession | null = null;

/** Points on the curve: more than a screen shows would cost time and say nothing. */
const MAX_POINTS = 400;

function addPoint(point: CurvePoint): void {
  const points = curve.peek();
  const last = points.at(-1);
  if (last && point.seconds - last.seconds < Math.max(0.1, point.seconds / MAX_POINTS)) return;
  curve.value = [...points, point];
}

export async function startFit(): Promise<void> {
  const pixels = goalPixels();
  if (!pixels || running.peek()) return;
  const { width, height } = pixels;
  const options: FitOptions = {
    height: treeHeight.peek(),
    generator: generator.peek(),
    timeout: seconds.peek(),
    leaves: leafiness.peek(),
    individual: individual.peek() ? "share" : "off",
    reading: corrections.peek(),
  };
  // On a telephone the pictures are above the button.
  document.getElementById("room")?.scrollTo({ top: 0, behavior: "smooth" });
  phase.value = "guessing";
  failure.value = null;
  guess.value = null;
  bestToml.value = null;
  progress.value = null;
  elapsed.value = 0;
  curve.value = [];
  const keptBest = best.peek();
  const keptResult = result.peek();
  let said = 0;
  const goal = { ...pixels, colors: await seenColors() };
  session = new FitSession(goal, options, {
    stage(now) {
      const share = now.done !== undefined && now.all ? now.done / now.all : null;
      stage.value = { text: now.stage, share };
      if (phase.peek() === "searching") phase.value = "judging";
    },
    guessed(said) {
      guess.value = said;
      result.value = null;
      best.value = null;
      phase.value = "searching";
      announce("The search begins");
    },
    step(now, time, found) {
      progress.value = now;
      elapsed.value = time;
      const { likeness, iou } = now;
      if (likeness !== null && iou !== null) addPoint({ seconds: time, likeness, iou });
      if (found) {
        best.value = { ink: found.ink, ownInk: null, width, height, goal: goal.ink };
        bestToml.value = found.toml;
      }
      // Screen readers hear of it now and then, not forty times a second.
      if (likeness !== null && time - said > 10) {
        said = time;
        announce(`${Math.round(time)} seconds, likeness ${likeness.toFixed(2)}`);
      }
    },
  });
  try {
    const { ink, ownInk, result: finished } = await session.run();
    best.value = { ink, ownInk, width, height, goal: goal.ink };
    result.value = finished;
    bestToml.value = null;
    phase.value = "done";
    const likeness = shownTree.peek()?.card.likeness ?? finished.report.likeness;
    announce(`The fit has ended with likeness ${likeness.toFixed(2)}`);
  } catch (error) {
    failure.value = sentence(error);
    best.value ??= keptBest;
    result.value ??= keptResult;
    phase.value = result.peek() ? "done" : "idle";
  } finally {
    session = null;
  }
}

export function pauseFit(): void {
  session?.pause();
  phase.value = "paused";
}

export function resumeFit(): void {
  session?.resume();
  phase.value = "searching";
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
