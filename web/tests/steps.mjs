// A fit without the page, by the functions that its workers call.

/**
 * Runs `fit` to the end of its search, as the page does: first the race between families, where there is one. It has two
 * evaluators, as two workers have them, and pieces of any size. Needs nothing from outside: it runs in a browser too.
 */
export function runSteps(fit, Evaluator) {
  const search = (recipe) => {
    const evaluators = [0, 1].map(() => new Evaluator(recipe));
    const inFlight = [];
    for (let round = 0; ; round += 1) {
      // Others are asked for before the oldest have their scores.
      inFlight.push(...fit.ask(1 + (round % 3), 0));
      if (inFlight.length === 0) break;
      const oldest = inFlight.splice(0, 1 + (round % 2));
      fit.tell(
        oldest.map((piece, number) => evaluators[number % 2].score(piece)),
        0,
      );
    }
    for (const evaluator of evaluators) evaluator.free();
  };
  const families = [];
  fit.compare(() => {});
  for (let leg = fit.next_leg(); leg; leg = fit.next_leg()) {
    families.push(leg.family);
    search(leg.recipe);
  }
  fit.begin();
  search(fit.recipe());
  return families;
}
