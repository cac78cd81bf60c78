// One instance of the library behind a message port. What it can do is in worker-fit.ts, worker-goal.ts, worker-map.ts,
// worker-species.ts and worker-zip.ts.
import init from "../wasm/pleach_web.js";
import type { FromWorker, Op, Ops, Progress, ToWorker } from "./protocol";
import { fitHandlers } from "./worker-fit";
import { goalHandlers } from "./worker-goal";
import { mapHandlers } from "./worker-map";
import { speciesHandlers } from "./worker-species";
import { zipHandlers } from "./worker-zip";

export type Handlers<K extends Op> = {
  [Name in K]: (
    input: Ops[Name]["in"],
    report: (progress: Progress) => void,
  ) => Ops[Name]["out"] | Promise<Ops[Name]["out"]>;
};

const handlers: Handlers<Op> = {
  ...speciesHandlers,
  ...goalHandlers,
  ...mapHandlers,
  ...fitHandlers,
  ...zipHandlers,
};

let ready: Promise<unknown> | undefined;

function send(reply: FromWorker, transfer: Transferable[] = []): void {
  self.postMessage(reply, { transfer });
}

/** The buffers of the typed arrays in a reply: all are copies of wasm memory and can be given away. */
function buffers(value: unknown): ArrayBuffer[] {
  if (value instanceof Uint8Array || value instanceof Float32Array || value instanceof Uint32Array) {
    return value.buffer instanceof ArrayBuffer ? [value.buffer] : [];
  }
  if (Array.isArray(value)) {
    // Long lists are numbers or JSON, never arrays of arrays of bytes.
    return value.length > 64 ? [] : value.flatMap(buffers);
  }
  if (value && typeof value === "object") return Object.values(value).flatMap(buffers);
  return [];
}

/** The line of a grammar that the library's error is about, if it is about one. */
const lineOf = (error: unknown) =>
  error instanceof Error && "line" in error && typeof error.line === "number" ? error.line : null;

async function answer<K extends Op>(id: number, op: K, input: Ops[K]["in"]): Promise<void> {
  try {
    await ready;
    const begun = performance.now();
    const value = await handlers[op](input, (progress) => send({ kind: "progress", id, progress }));
    const ms = performance.now() - begun;
    send({ kind: "done", id, value, ms }, [...new Set(buffers(value))]);
  } catch (error) {
    // A trap leaves the instance in an unknown state: the page throws this worker away.
    const fatal = error instanceof WebAssembly.RuntimeError;
    const message = error instanceof Error ? error.message : String(error);
    send({ kind: "failed", id, message, line: lineOf(error), fatal });
  }
}

self.onmessage = (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  if ("module" in message) ready = init({ module_or_path: message.module });
  else void answer(message.id, message.op, message.input);
};
