// A fit as the page sees it: one coordinator, several evaluators, and the clock of the search.
import { Cancelled, Client } from "./client";
import { Evaluators } from "./evaluators";
import type {
  DrawnTree,
  FitOptions,
  FitProgress,
  FitResult,
  FitStep,
  FoundTrees,
  GoalPixels,
  Guess,
  Leg,
  Op,
  Ops,
  Progress,
  SeenColors,
} from "./protocol";

export interface FitEvents {
  stage(progress: Progress): void;
  /** Trees of the goal are searched from now on: first of several generators in turn, where there are several. */
  began(): void;
  /** The known tree that is most like the goal, before any search. */
  nearest(found: DrawnTree): void;
  /** A generator is tried. */
  tries(leg: Leg): void;
  guessed(guess: Guess): void;
  /** Seconds of this search so far, without pauses. `best` comes a few times a second. */
  step(progress: FitProgress, elapsed: number, best: FitStep["best"]): void;
}

/** How often the best tree is drawn, in milliseconds: a picture is 64 KiB or more. */
const BEST_EVERY = 250;
/** How often the page hears how far a search is, in milliseconds: what it draws takes time from the search. */
const STEP_EVERY = 100;

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
  private readonly evaluators = new Evaluators();
  private elapsed = 0;
  private since: number | null = null;
  private stopping = false;
  /** Cancelled or done: whatever still comes back is of no use. */
  private over = false;
  private leave: () => void = () => {};
  private goOn: (() => void) | null = null;
  private paused: Promise<void> | null = null;

  constructor(
    private readonly goal: GoalPixels,
    /** Reads the colours of its picture. */
    private readonly colors: () => Promise<SeenColors | null>,
    private readonly options: FitOptions,
    private readonly events: FitEvents,
  ) {}

  async run(): Promise<FoundTrees & { result: FitResult }> {
    try {
      this.events.stage({ stage: "Loading what is known" });
      let hasBegun = false;
      const stage = (progress: Progress) => {
        if (progress.nearest) {
          if (!hasBegun) this.events.began();
          hasBegun = true;
          this.events.nearest(progress.nearest);
        } else {
          this.events.stage(progress);
        }
      };
      const [colors, known] = await this.unlessCancelled(Promise.all([this.colors(), knownDrawings()]));
      const goal = { ...this.goal, colors, ink: this.goal.ink.slice() };
      const input = { goal, options: this.options, drawings: known };
      await this.ask(this.coordinator, "fitCompare", input, stage);
      if (!hasBegun) this.events.began();
      await this.race();
      const { guess, recipe } = await this.ask(this.coordinator, "fitBegin", null);
      this.events.guessed(guess);
      // A search that was stopped before it began has a tree all the same.
      await this.search(recipe, 1);
      this.evaluators.cancel();
      return await this.ask(this.coordinator, "fitFinish", null, stage);
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
    this.end();
    this.resume();
    this.leave();
  }

  /** Ends at once what has no worker that could be stopped: files that are loaded, colours that are read. */
  private unlessCancelled<T>(work: Promise<T>): Promise<T> {
    return new Promise((resolve, reject) => {
      this.leave = () => reject(new Cancelled());
      if (this.over) this.leave();
      work.then(resolve, reject);
    });
  }

  /** A call that starts no worker once all is over, and whose answer does not come after that. */
  private async ask<K extends Op>(
    client: Client,
    op: K,
    input: Ops[K]["in"],
    progress?: (progress: Progress) => void,
  ): Promise<Ops[K]["out"]> {
    this.check();
    const answer = await client.call(op, input, progress);
    this.check();
    return answer;
  }

  private check(): void {
    if (this.over) throw new Cancelled();
    // It may die while it waits for scores, and the one in its place knows nothing of the search.
    if (this.coordinator.deaths > 0)
      throw new Error("The search is lost: its worker stopped. Start it again.");
  }

  private end(): void {
    this.over = true;
    this.coordinator.cancel();
    this.evaluators.cancel();
  }

  private clock(): number {
    return this.elapsed + (this.since === null ? 0 : (performance.now() - this.since) / 1000);
  }

  private holdClock(): void {
    this.elapsed = this.clock();
    this.since = null;
  }

  /** Searches one generator after the other for a short while; the library keeps the one that suits the goal best. */
  private async race(): Promise<void> {
    while (!this.stopping) {
      const leg = await this.ask(this.coordinator, "fitLeg", null);
      if (!leg) break;
      this.events.tries(leg);
      await this.search(leg.recipe, 0);
    }
  }

  /**
   * Has trees scored by evaluators of `recipe` until the leg or the search is over, or the user stops it after `least`
   * pieces. Scores are told in the order in which the trees were asked for, and others are asked for before a worker has
   * nothing to do.
   */
  private async search(recipe: Uint8Array, least: number): Promise<void> {
    this.elapsed = 0;
    this.check();
    await this.evaluators.use(recipe);
    const inFlight: Scored[] = [];
    let told = 0;
    const stops = () => this.stopping && told >= least;
    let drawn = Number.NEGATIVE_INFINITY;
    let said = Number.NEGATIVE_INFINITY;
    this.since = performance.now();
    while (!stops()) {
      if (this.paused) {
        this.holdClock();
        await this.paused;
        this.check();
        this.since = performance.now();
      }
      const scores = takeReady(inFlight);
      const best = performance.now() - drawn > BEST_EVERY;
      if (best) drawn = performance.now();
      const step: FitStep = await this.ask(this.coordinator, "fitStep", {
        scores,
        workers: this.evaluators.wantWork ? this.evaluators.count : 0,
        elapsed: this.clock(),
        best,
      });
      told += scores.length;
      const isOver = step.progress.ended !== null || (step.pieces.length === 0 && inFlight.length === 0);
      if (isOver || step.best || performance.now() - said > STEP_EVERY) {
        said = performance.now();
        this.events.step(step.progress, this.clock(), step.best);
      }
      if (isOver) break;
      for (const piece of step.pieces) inFlight.push(new Scored(this.evaluators.score(piece)));
      await inFlight[0]?.done;
      this.check();
    }
    this.holdClock();
  }
}

/** A piece that is scored, or has been. */
class Scored {
  scores: Uint8Array | null = null;
  readonly done: Promise<void>;

  constructor(work: Promise<Uint8Array>) {
    this.done = work.then((scores) => {
      this.scores = scores;
    });
    // A search that has ended waits for none of its pieces.
    this.done.catch(() => {});
  }
}

/** Takes the scores of the oldest pieces, up to the first that has none yet. */
function takeReady(pieces: Scored[]): Uint8Array[] {
  const ready: Uint8Array[] = [];
  for (let scores = pieces[0]?.scores; scores; scores = pieces[0]?.scores) {
    ready.push(scores);
    pieces.shift();
  }
  return ready;
}
