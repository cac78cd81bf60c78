// Fits. One worker holds the search, others the evaluators that grow and score its trees.
import { Evaluator, Fit } from "../wasm/pleach_web.js";
import type { FitProgress, FitResult, Guess } from "./protocol";
import type { Handlers } from "./worker";
import { makeGoal } from "./worker-goal";

let fit: Fit | undefined;
let evaluator: Evaluator | undefined;

function running(): Fit {
  if (!fit) throw new Error("No fit has been started in this worker.");
  return fit;
}

export const fitHandlers: Handlers<
  "fitGuess" | "fitRecipe" | "fitStep" | "fitFinish" | "evaluator" | "evaluate"
> = {
  fitGuess({ goal, options, drawings }, report) {
    const made = makeGoal(goal);
    fit?.free();
    // What is left open is left out.
    const said = Object.entries(options).filter(([, value]) => value !== null);
    fit = new Fit(made, JSON.stringify(Object.fromEntries(said)));
    if (drawings) fit.use_drawings(drawings);
    const found = fit.guess((done: number, all: number) => report({ stage: "looking for kin", done, all }));
    return JSON.parse(found) as Guess;
  },

  fitRecipe: () => running().recipe().slice(),

  fitStep({ scores, parts, elapsed, best }) {
    const search = running();
    if (scores) search.tell(scores, elapsed);
    const pieces = search.ask(parts, elapsed).map((piece) => piece.slice());
    const progress = JSON.parse(search.progress()) as FitProgress;
    // There is a best tree from the first scores on.
    const shows = best && progress.likeness !== null;
    return {
      pieces,
      progress,
      best: shows ? { ink: search.best_silhouette().slice(), toml: search.best_toml() } : null,
    };
  },

  fitFinish(_, report) {
    const search = running();
    // A fit that has ended shows no silhouette any more.
    const ink = search.best_silhouette().slice();
    const result = JSON.parse(search.finish((stage: string) => report({ stage }))) as FitResult;
    return { ...result, ink };
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
