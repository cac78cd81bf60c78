// A worker with one instance of the library, called like functions that return promises.
import { wasmModule } from "./module";
import type { FromWorker, Op, Ops, Progress, ToWorker } from "./protocol";

/** The call was cancelled on purpose: not an error to show. */
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}

/** What the library has against a call. */
export class Refused extends Error {
  constructor(
    message: string,
    /** Of a grammar, from 1. */
    readonly line: number | null,
  ) {
    super(message);
    this.name = "Refused";
  }
}

interface Waiting {
  resolve: (value: unknown) => void;
  reject: (error: Error) => void;
  progress: ((progress: Progress) => void) | undefined;
}

/** Called when a worker died, with what is known of the cause. Set once by the page. */
let onDeath: (what: string, message: string) => void = () => {};
export function reportDeaths(report: (what: string, message: string) => void): void {
  onDeath = report;
}

export class Client {
  private worker: Worker | null = null;
  private waiting = new Map<number, Waiting>();
  private nextId = 1;
  private cancels = 0;
  /** How many of its workers have died: what they held is lost. */
  deaths = 0;

  /** `what` names the worker in messages: "the map". */
  constructor(readonly what: string) {}

  /** How many calls have no answer yet. */
  get pending(): number {
    return this.waiting.size;
  }

  async call<K extends Op>(
    op: K,
    input: Ops[K]["in"],
    progress?: (progress: Progress) => void,
    transfer: Transferable[] = [],
  ): Promise<Ops[K]["out"]> {
    const { cancels } = this;
    const module = await wasmModule();
    // Given up while the library was loading.
    if (cancels !== this.cancels) throw new Cancelled();
    const worker = this.start(module);
    const id = this.nextId++;
    return new Promise<Ops[K]["out"]>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (value: unknown) => void, reject, progress });
      const message = { id, op, input } as ToWorker;
      worker.postMessage(message, transfer);
    });
  }

  /** Stops what runs at once. The next call starts a fresh worker, whose memory is small again. */
  cancel(): void {
    this.cancels++;
    this.stop(new Cancelled());
  }

  private start(module: WebAssembly.Module): Worker {
    if (this.worker) return this.worker;
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    worker.postMessage({ module } satisfies ToWorker);
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.hear(event.data);
    worker.onerror = (event) => this.die(event.message || "it could not be started");
    this.worker = worker;
    return worker;
  }

  private hear(reply: FromWorker): void {
    const waiting = this.waiting.get(reply.id);
    if (!waiting) return;
    if (reply.kind === "progress") {
      waiting.progress?.(reply.progress);
      return;
    }
    this.waiting.delete(reply.id);
    if (reply.kind === "done") waiting.resolve(reply.value);
    else {
      waiting.reject(new Refused(reply.message, reply.line));
      if (reply.fatal) this.die(reply.message);
    }
  }

  private die(message: string): void {
    this.deaths++;
    onDeath(this.what, message);
    this.stop(new Error(`The worker of ${this.what} stopped: ${message}. A new one takes its place.`));
  }

  private stop(error: Error): void {
    this.worker?.terminate();
    this.worker = null;
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const each of waiting) each.reject(error);
  }
}
