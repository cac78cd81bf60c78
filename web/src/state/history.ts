// Undo and redo of values that are never changed in place.
import { computed, type ReadonlySignal, signal } from "@preact/signals";

const DEPTH = 200;
/** Of all steps together. */
const MAX_BYTES = 32_000_000;
/** Changes of one thing within this time, in milliseconds, are one step back: a drag of a slider. */
const TOGETHER = 800;

/** Values of type `T`, and steps of type `S` that lead from each to the next and back. */
export abstract class Steps<T, S> {
  private readonly past = signal<readonly S[]>([]);
  private readonly future = signal<readonly S[]>([]);
  private readonly now;
  private lastKey = "";
  private lastTime = 0;

  readonly canUndo: ReadonlySignal<boolean> = computed(() => this.past.value.length > 0);
  readonly canRedo: ReadonlySignal<boolean> = computed(() => this.future.value.length > 0);

  constructor(first: T) {
    this.now = signal(first);
  }

  protected abstract between(before: T, after: T): S;
  protected abstract back(now: T, step: S): T;
  protected abstract forward(now: T, step: S): T;
  /** Two steps that follow each other as one; null if there is no such step. */
  protected abstract joined(one: S, next: S): S | null;
  /** What a step takes, where that is much. */
  protected size(_step: S): number {
    return 0;
  }

  get value(): T {
    return this.now.value;
  }

  peek(): T {
    return this.now.peek();
  }

  /** Bytes that all steps take. */
  bytes(): number {
    return [...this.past.peek(), ...this.future.peek()].reduce((sum, step) => sum + this.size(step), 0);
  }

  /** A new value. Values with the same non-empty key that follow each other closely become one step if they can. */
  push(value: T, key = ""): void {
    const time = performance.now();
    const past = this.past.peek();
    const step = this.between(this.now.peek(), value);
    const last = past.at(-1);
    const follows = key !== "" && key === this.lastKey && time - this.lastTime < TOGETHER;
    const one = follows && last !== undefined ? this.joined(last, step) : null;
    this.past.value = one === null ? this.bounded([...past, step]) : [...past.slice(0, -1), one];
    this.future.value = [];
    this.now.value = value;
    this.lastKey = key;
    this.lastTime = time;
  }

  /** A new value without a step back: earlier ones are forgotten. */
  reset(value: T): void {
    this.past.value = [];
    this.future.value = [];
    this.now.value = value;
    this.lastKey = "";
  }

  undo(): void {
    const step = this.past.peek().at(-1);
    if (step === undefined) return;
    this.past.value = this.past.peek().slice(0, -1);
    this.future.value = [step, ...this.future.peek()];
    this.now.value = this.back(this.now.peek(), step);
    this.lastKey = "";
  }

  redo(): void {
    const [step, ...rest] = this.future.peek();
    if (step === undefined) return;
    this.future.value = rest;
    this.past.value = [...this.past.peek(), step];
    this.now.value = this.forward(this.now.peek(), step);
    this.lastKey = "";
  }

  /** The newest of the steps, as many as there is room for. */
  private bounded(steps: readonly S[]): readonly S[] {
    const newest = steps.slice(-DEPTH);
    let room = MAX_BYTES;
    let first = newest.length;
    for (const step of newest.slice().reverse()) {
      room -= this.size(step);
      if (room < 0) break;
      first--;
    }
    return newest.slice(first);
  }
}

/** Steps that hold both values. */
export class History<T> extends Steps<T, { before: T; after: T }> {
  protected override between(before: T, after: T): { before: T; after: T } {
    return { before, after };
  }

  protected override back(_now: T, { before }: { before: T }): T {
    return before;
  }

  protected override forward(_now: T, { after }: { after: T }): T {
    return after;
  }

  protected override joined(one: { before: T }, { after }: { after: T }): { before: T; after: T } {
    return { before: one.before, after };
  }
}
