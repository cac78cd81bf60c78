// Fits. One worker holds the search, others the evaluators that grow and score its trees.
import { Evaluator, Fit } from "../wasm/pleach_web.js";
import type { DrawnTree, FitProgress, FitResult, Guess } from "./protocol";
import type { Handlers } from "./worker";
import { makeGoal } from "./worker-goal";

/** The library's words for what comes after the search. */
const LAST_STAGES = { judging: "Judging", individual: "Looking for this very tree" };

let fit: Fit | undefined;
let evaluator: Evaluator | undefined;

function running(): Fit {
  if (!fit) throw new Error("No fit has been started in this worker.");
  return fit;
}

/** The species file that was drawn last. */
let drawn: string | null = null;

/** The best tree, drawn over the goal, unless it was drawn last. */
function newBest(search: Fit): DrawnTree | null {
  const toml = search.best_toml();
  if (toml === drawn) return null;
  drawn = toml;
  return { ink: search.best_silhouette().slice(), toml };
}

export const fitHandlers: Handlers<
  "fitCompare" | "fitLeg" | "fitBegin" | "fitStep" | "fitFinish" | "evaluator" | "evaluate"
> = {
  fitCompare({ goal, options, drawings }, report) {
    const made = makeGoal(goal);
    fit?.free();
    drawn = null;
    fit = new Fit(made, JSON.stringify(options));
    if (drawings) fit.use_drawings(drawings);
    const stage = "Comparing with known species";
    fit.compare(
      (done: number, all: number) => report({ stage, done, all }),
      (ink: Uint8Array<ArrayBuffer>, toml: string) => report({ stage, nearest: { ink, toml } }),
    );
    return null;
  },

  fitLeg() {
    const leg = running().next_leg();
    if (!leg) return null;
    const { family, species, number, count } = leg;
    const recipe = leg.recipe.slice();
    leg.free();
    return { recipe, family, species, number, count };
  },

  fitBegin() {
    const search = running();
    const guess = JSON.parse(search.begin()) as Guess;
    return { guess, recipe: search.recipe().slice() };
  },

  fitStep({ scores, workers, elapsed, best }) {
    const search = running();
    if (scores.length > 0) search.tell(scores, elapsed);
    const pieces = workers > 0 ? search.ask(workers, elapsed).map((piece) => piece.slice()) : [];
    const progress = JSON.parse(search.progress()) as FitProgress;
    // There is a best tree from the first scores on.
    return { pieces, progress, best: best && progress.likeness !== null ? newBest(search) : null };
  },

  fitFinish(_, report) {
    const search = running();
    const said = search.finish((stage: keyof typeof LAST_STAGES, used?: number) => {
      report({ stage: LAST_STAGES[stage], ...(used === undefined ? {} : { done: used, all: 1 }) });
    });
    const result = JSON.parse(said) as FitResult;
    const ownInk = result.own_toml === null ? null : search.found_silhouette(1).slice();
    return { result, ink: search.found_silhouette(0).slice(), ownInk };
  },

  evaluator(recipe) {
    evaluator?.free();
    evaluator = new Evaluator(recipe);
    return null;
  },

  evaluate(batch) {
    if (!evaluator) throw new Error("This worker holds no evaluator.");
    return evaluator.score(batch).slice();
  },
};
