// A few workers that draw small pictures: thumbnails, seeds, the gallery.
import { Client } from "./client";
import type { Op, Ops } from "./protocol";

interface Job {
  run: (client: Client) => Promise<void>;
  signal: AbortSignal | undefined;
  rank: number;
}

export class Pool {
  private readonly free: Client[];
  private readonly jobs: Job[] = [];

  constructor(what: string, workers: number) {
    this.free = Array.from({ length: workers }, () => new Client(what));
  }

  /** The job of the lowest rank runs first. A job whose signal is aborted before it starts is dropped; its promise then rejects. */
  call<K extends Op>(op: K, input: Ops[K]["in"], signal?: AbortSignal, rank = 0): Promise<Ops[K]["out"]> {
    return new Promise((resolve, reject) => {
      const run = (client: Client) => client.call(op, input).then(resolve, reject);
      signal?.addEventListener("abort", () => reject(signal.reason), { once: true });
      this.jobs.push({ run, signal, rank });
      this.jobs.sort((a, b) => a.rank - b.rank);
      this.pump();
    });
  }

  private pump(): void {
    while (this.free.length > 0) {
      const job = this.jobs.shift();
      if (!job) return;
      if (job.signal?.aborted) continue;
      const client = this.free.pop();
      if (!client) return;
      void job.run(client).finally(() => {
        this.free.push(client);
        this.pump();
      });
    }
  }
}

export const cores = Math.max(1, Math.min(navigator.hardwareConcurrency || 2, 8));

/** Each worker has an instance of the library with its own memory: more than four gain little. */
export const thumbnails = new Pool("the small pictures", Math.min(4, cores));
