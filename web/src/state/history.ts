// Undo and redo of values that are never changed in place.
import { computed, signal } from "@preact/signals";

const DEPTH = 200;
/** Changes of one thing within this time, in milliseconds, are one step back: a drag of a slider. */
const TOGETHER = 800;

export class History<T> {
  private readonly past = signal<readonly T[]>([]);
  private readonly future = signal<readonly T[]>([]);
  private readonly now;
  private lastKey = "";
  private lastTime = 0;

  readonly canUndo = computed(() => this.past.value.length > 0);
  readonly canRedo = computed(() => this.future.value.length > 0);

  constructor(first: T) {
    this.now = signal(first);
  }

  get value(): T {
    return this.now.value;
  }

  peek(): T {
    return this.now.peek();
  }

  /** A new value. Values with the same non-empty key that follow each other closely become one step. */
  push(value: T, key = ""): void {
    const time = performance.now();
    const together = key !== "" && key === this.lastKey && time - this.lastTime < TOGETHER;
    if (!together) this.past.value = [...this.past.peek(), this.now.peek()].slice(-DEPTH);
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
    const past = this.past.peek();
    const before = past.at(-1);
    if (before === undefined) return;
    this.past.value = past.slice(0, -1);
    this.future.value = [this.now.peek(), ...this.future.peek()];
    this.now.value = before;
    this.lastKey = "";
  }

  redo(): void {
    const [after, ...rest] = this.future.peek();
    if (after === undefined) return;
    this.future.value = rest;
    this.past.value = [...this.past.peek(), this.now.peek()];
    this.now.value = after;
    this.lastKey = "";
  }
}
