// Which room is open, and the link that keeps everything.
import { effect, signal } from "@preact/signals";
import { sayError } from "./notes";
import { text } from "./shape";
import { debounce, load, save } from "./store";

export const ROOMS = ["fit", "map", "species", "gallery"] as const;
export type Room = (typeof ROOMS)[number];

export const room = signal<Room>("fit");

/** A part of the page with state for the link. Registered once by each part. */
export interface Linked {
  /** Reads signals, so that the link follows them. */
  write(fields: URLSearchParams): Promise<void> | void;
  read(fields: URLSearchParams): Promise<void> | void;
}

const parts: Linked[] = [];
export function register(part: Linked): void {
  parts.push(part);
}

export function go(to: Room): void {
  if (room.peek() === to) return;
  room.value = to;
  // A step that the browser's back button undoes; the fields follow shortly.
  history.pushState(OWN, "", `#${to}`);
  queueWrite();
}

/** The hash for what the page shows now. */
export async function link(): Promise<string> {
  const fields = new URLSearchParams();
  for (const part of parts) await part.write(fields);
  const query = fields.toString();
  return `#${room.value}${query ? `?${query}` : ""}`;
}

/** Marks the entries of the browser's history that the page made: going back to one changes the room only. */
const OWN = "own";

const queueWrite = debounce(250, () => {
  link()
    .then((hash) => {
      save("link", hash);
      history.replaceState(OWN, "", hash);
    })
    .catch(sayError);
});

async function read(hash: string): Promise<void> {
  const [, name = "", query = ""] = /^#([a-z]*)\??(.*)$/s.exec(hash) ?? [];
  const to = ROOMS.find((each) => each === name);
  if (to) room.value = to;
  const fields = new URLSearchParams(query);
  // A step back to a bare room name keeps all else.
  if (query) for (const part of parts) await part.read(fields);
}

/** False until the link has been read: what depends on it waits. */
export const restored = signal(false);

export async function startRouting(): Promise<void> {
  const last = load("link");
  const hash = location.hash.length > 1 || !text(last) ? location.hash : last;
  await read(hash).catch(sayError);
  restored.value = true;
  addEventListener("popstate", () => {
    const own = history.state === OWN;
    read(own ? location.hash.replace(/\?.*/s, "") : location.hash).catch(sayError);
  });
  // Any signal that a part reads while it writes queues the next write.
  effect(() => {
    room.value;
    for (const part of parts) void part.write(new URLSearchParams());
    queueWrite();
  });
}
