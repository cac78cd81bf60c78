// A fit as the page sees it: one coordinator, several evaluators, and the clock of the search.
import { Cancelled, Client } from "./client";
import { cores } from "./pool";
import type {
  FitOptions,
  FitProgress,
  FitResult,
  FitStep,
  FoundTrees,
  GoalPixels,
  Guess,
  Progress,
} from "./protocol";

export interface FitEvents {
  stage(progress: Progress): void;
  guessed(guess: Guess): void;
  /** Seconds of search so far, without pauses. `best` comes a few times a second. */
  step(progress: FitProgress, elapsed: number, best: FitStep["best"]): void;
}

/** How often the best tree is drawn, in milliseconds: a picture is 64 KiB or more. */
const BEST_EVERY = 250;

let drawings: Promise<Uint8Array | null> | undefined;

/** Drawings of known species: the first guess is faster with them, and works without them. */
function knownDrawings(): Promise<Uint8Array | null> {
  drawings ??= fetch(new URL("known.bin", document.baseURI))
    .then(async (response) => (response.ok ? new Uint8Array(await response.arrayBuffer()) : null))
    .catch(() => null);
  return drawings;
}

export class FitSession {
  private readonly coordinator = new Client("the search");
  private readonly evaluators = Array.from({ length: cores }, () => new Client("the search"));
  private recipe: Uint8Array | null = null;
  private elapsed = 0;
  private since: number | null = null;
  private stopping = false;
  private goOn: (() => void) | null = null;
  private paused: Promise<void> | null = null;

  constructor(
    private readonly goal: GoalPixels,
    private readonly options: FitOptions,
    private readonly events: FitEvents,
  ) {}

  async run(): Promise<FoundTrees & { result: FitResult }> {
    try {
      this.events.stage({ stage: "Loading what is known" });
      const known = await knownDrawings();
      const goal = { ...this.goal, ink: this.goal.ink.slice() };
      const guess = await this.coordinator.call(
        "fitGuess",
        { goal, options: this.options, drawings: known },
        (progress) => this.events.stage(progress),
      );
      this.events.guessed(guess);
      const recipe = await this.coordinator.call("fitRecipe", null);
      this.recipe = recipe;
      await Promise.all(this.evaluators.map((each) => each.call("evaluator", recipe)));
      await this.search();
      for (const each of this.evaluators) each.cancel();
      return await this.coordinator.call("fitFinish", null, (progress) => this.events.stage(progress));
    } finally {
      this.end();
    }
  }

  pause(): void {
    if (this.paused) return;
    this.paused = new Promise((resolve) => {
      this.goOn = resolve;
    });
  }

  resume(): void {
    this.goOn?.();
    this.goOn = null;
    this.paused = null;
  }

  /** Ends the search with the best so far, which is then judged. */
  stop(): void {
    this.stopping = true;
    this.resume();
  }

  /** Gives all up at once. */
  cancel(): void {
    this.stopping = true;
    this.resume();
    this.end();
  }

  private end(): void {
    this.coordinator.cancel();
    for (const each of this.evaluators) each.cancel();
  }

  private clock(): number {
    return this.elapsed + (this.since === null ? 0 : (performance.now() - this.since) / 1000);
  }

  private holdClock(): void {
    this.elapsed = this.clock();
    this.since = null;
  }

  private async search(): Promise<void> {
    const parts = this.evaluators.length;
    let scores: Uint8Array[] | null = null;
    let drawn = Number.NEGATIVE_INFINITY;
    this.since = performance.now();
    for (;;) {
      if (this.paused) {
        this.holdClock();
        await this.paused;
        this.since = performance.now();
      }
      if (this.stopping && scores === null) break;
      const best = performance.now() - drawn > BEST_EVERY;
      if (best) drawn = performance.now();
      const step: FitStep = await this.coordinator.call("fitStep", {
        scores,
        parts,
        elapsed: this.clock(),
        best,
      });
      this.events.step(step.progress, this.clock(), step.best);
      if (step.pieces.length === 0 || this.stopping) break;
      scores = await Promise.all(step.pieces.map((piece, at) => this.evaluate(at, piece)));
    }
    this.holdClock();
  }

  /** A worker that fails once is replaced, and its piece is done again: scores do not depend on who gives them. */
  private async evaluate(at: number, piece: Uint8Array): Promise<Uint8Array<ArrayBuffer>> {
    const client = this.evaluators[at % this.evaluators.length];
    if (!client || !this.recipe) throw new Cancelled();
    try {
      return await client.call("evaluate", piece);
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      await client.call("evaluator", this.recipe);
      return client.call("evaluate", piece);
    }
  }
}
