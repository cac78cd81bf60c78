// The map's state: layout, point, pins and path; and the tree under the point.
import { effect, signal } from "@preact/signals";
import { Client } from "../../engine/client";
import { mapClient } from "../../engine/clients";
import { Latest } from "../../engine/latest";
import type { Ink, Layout, Plane, PointAbout } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import type { Linked } from "../../state/route";

export type Place = readonly [number, number];

export const layout = signal<Layout>("numbers");
export const planes = signal<Partial<Record<Layout, Plane>>>({});
/** The point whose tree is shown. */
export const point = signal<Place | null>(null);
/** True after a click: the pointer no longer moves the point. */
export const held = signal(false);
export const pins = signal<readonly Place[]>([]);
export const path = signal<readonly Place[]>([]);
export const showSwitches = signal(true);

export const tree = signal<Ink | null>(null);
export const about = signal<PointAbout | null>(null);
export const row = signal<readonly { at: Place; ink: Ink }[]>([]);
/** Milliseconds from the wish to the picture: coarse, full. For the test of quickness. */
export const times = { coarse: [] as number[], full: [] as number[] };

export const NAME = "blend";
const COARSE_SIZE = 128;
const FULL_SIZE = 320;
const ROW = 8;

/** Four figures behind the point are finer than a pixel, and short in links and files. */
export const tidy = (value: number) => Number(value.toFixed(4));

export async function loadPlane(): Promise<void> {
  const wanted = layout.peek();
  if (planes.peek()[wanted]) return;
  const plane = await mapClient.call("mapPlane", wanted);
  planes.value = { ...planes.peek(), [wanted]: plane };
}

/** A picture of a screen, in milliseconds. */
const FRAME = 16;
/** How long leafy trees take here, a running mean. Where that is too long, the first answer has no leaves. */
let leafyTime = FRAME + 1;

interface Wish {
  layout: Layout;
  x: number;
  y: number;
  since: number;
}

const grower = new Latest<Wish>(async ({ layout: of, x, y, since }, isStale) => {
  const at = { layout: of, x, y };
  const detail = leafyTime > FRAME ? "bare" : "coarse";
  tree.value = await mapClient.call("mapTree", { ...at, size: COARSE_SIZE, detail });
  times.coarse.push(performance.now() - since);
  about.value = await mapClient.call("mapAbout", at);
  if (isStale()) return;
  const begun = performance.now();
  tree.value = await mapClient.call("mapTree", { ...at, size: FULL_SIZE, detail: "full" });
  times.full.push(performance.now() - since);
  leafyTime += (performance.now() - begun - leafyTime) * 0.3;
}, sayError);

effect(() => {
  const at = point.value;
  if (at) grower.ask({ layout: layout.value, x: at[0], y: at[1], since: performance.now() });
});

export function moveTo(x: number, y: number): void {
  const next: Place = [tidy(x), tidy(y)];
  const now = point.peek();
  if (!now || now[0] !== next[0] || now[1] !== next[1]) point.value = next;
}

function forgetPoint(): void {
  point.value = null;
  held.value = false;
  tree.value = null;
  about.value = null;
}

/** Another layout is another plane: points of one mean nothing on the other. */
export function setLayout(next: Layout): void {
  if (next === layout.peek()) return;
  layout.value = next;
  pins.value = [];
  path.value = [];
  forgetPoint();
}

export const tomlAt = ([x, y]: Place): Promise<string> =>
  mapClient.call("mapToml", { layout: layout.peek(), x, y, name: NAME });

export function pin(place: Place): void {
  if (!pins.peek().some((each) => each[0] === place[0] && each[1] === place[1]))
    pins.value = [...pins.peek(), place];
}

/** Places at equal steps along a drawn line. */
export function spread(line: readonly Place[], count: number): Place[] {
  const first = line[0];
  if (!first) return [];
  const lengths = [0];
  line.slice(1).forEach((to, at) => {
    const from = line[at] ?? to;
    lengths.push((lengths[at] ?? 0) + Math.hypot(to[0] - from[0], to[1] - from[1]));
  });
  const whole = lengths.at(-1) ?? 0;
  return Array.from({ length: count }, (_, step) => {
    const wanted = (whole * step) / Math.max(1, count - 1);
    const next = Math.max(
      1,
      lengths.findIndex((length) => length >= wanted - 1e-12),
    );
    const [from, to] = [line[next - 1] ?? first, line[next] ?? line[next - 1] ?? first];
    const before = lengths[next - 1] ?? 0;
    const share = (wanted - before) / Math.max((lengths[next] ?? before) - before, 1e-12);
    const part = Math.max(0, Math.min(1, share));
    return [tidy(from[0] + (to[0] - from[0]) * part), tidy(from[1] + (to[1] - from[1]) * part)] as const;
  });
}

// A worker of its own: the row must not hold up the tree under the pointer.
const rowClient = new Client("the row of trees");
let rows = 0;

effect(() => {
  const line = path.value;
  const of = layout.value;
  const mine = ++rows;
  row.value = [];
  if (line.length < 2) return;
  void (async () => {
    for (const at of spread(line, ROW)) {
      const ink = await rowClient.call("mapTree", {
        layout: of,
        x: at[0],
        y: at[1],
        size: COARSE_SIZE,
        detail: "full",
      });
      if (mine !== rows) return;
      row.value = [...row.peek(), { at, ink }];
    }
  })().catch(sayError);
});

const write = (places: readonly Place[]) => places.map((place) => place.map(tidy).join(",")).join(";");

function read(text: string | null): Place[] {
  return (text ?? "")
    .split(";")
    .map((each) => each.split(",").map(Number))
    .filter((pair) => pair.length === 2 && pair.every(Number.isFinite))
    .map(([x = 0, y = 0]) => [x, y] as const);
}

export const mapLink: Linked = {
  write(fields) {
    if (layout.value !== "numbers") fields.set("layout", layout.value);
    if (held.value && point.value) fields.set("at", write([point.value]));
    if (pins.value.length > 0) fields.set("pins", write(pins.value));
    if (path.value.length > 1) fields.set("path", write(path.value));
  },

  read(fields) {
    layout.value = fields.get("layout") === "looks" ? "looks" : "numbers";
    const [at] = read(fields.get("at"));
    if (at) {
      point.value = at;
      held.value = true;
    } else forgetPoint();
    pins.value = read(fields.get("pins"));
    path.value = read(fields.get("path"));
  },
};
