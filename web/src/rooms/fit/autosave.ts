// The goal and the last result survive a reload. Photographs do not: they would fill the browser's store.
import { effect } from "@preact/signals";
import type { FitResult } from "../../engine/protocol";
import { pack, packBits, unpack, unpackBits } from "../../state/codec";
import type { Linked } from "../../state/route";
import { debounce, load, save } from "../../state/store";
import { best, type CurvePoint, curve, phase, result, running, seconds } from "./fit-state";
import { masks, picture, restoreGoal, takeTarget, treeHeight } from "./goal-state";

interface SavedGoal {
  name: string;
  width: number;
  height: number;
  target: string | null;
  ink: string;
  ground: number | null;
  axis: number | null;
  treeHeight: number;
  seconds: number;
}
interface SavedResult {
  result: FitResult;
  curve: readonly CurvePoint[];
  width: number;
  height: number;
  ink: string;
  ownInk: string | null;
  goal: string;
}

/** Its number changes with the shape of what is saved. */
const RESULT = "result.2";
const OLD_RESULT = "result";

const packInk = (ink: Uint8Array) => pack(packBits(ink));
const unpackInk = async (text: string, length: number) => unpackBits(await unpack(text), length);

async function saveGoal(): Promise<void> {
  const shown = picture.peek();
  if (!shown) return;
  const { ink, ground, axis } = masks.peek();
  const { name, width, height, target } = shown;
  const saved: SavedGoal = {
    name,
    width,
    height,
    target,
    ink: await packInk(ink),
    ground,
    axis,
    treeHeight: treeHeight.peek(),
    seconds: seconds.peek(),
  };
  save("goal", saved);
}

async function saveResult(): Promise<void> {
  const fit = result.peek();
  const now = best.peek();
  if (!fit || !now) return;
  const { width, height } = now;
  const saved: SavedResult = {
    result: fit,
    curve: curve.peek(),
    width,
    height,
    ink: await packInk(now.ink),
    ownInk: now.ownInk && (await packInk(now.ownInk)),
    goal: await packInk(now.goal),
  };
  save(RESULT, saved);
}

export async function restoreFit(): Promise<void> {
  const goal = load<SavedGoal | null>("goal", null);
  if (goal) {
    const { name, width, height, target, ground, axis } = goal;
    treeHeight.value = goal.treeHeight;
    seconds.value = goal.seconds;
    const ink = await unpackInk(goal.ink, width * height);
    restoreGoal({ name, width, height, photo: null, target }, { ink, ground, axis });
  }
  save(OLD_RESULT, null);
  const last = load<SavedResult | null>(RESULT, null);
  if (goal && last) {
    const { width, height } = last;
    const pixels = width * height;
    best.value = {
      width,
      height,
      ink: await unpackInk(last.ink, pixels),
      ownInk: last.ownInk === null ? null : await unpackInk(last.ownInk, pixels),
      goal: await unpackInk(last.goal, pixels),
    };
    curve.value = last.curve;
    result.value = last.result;
    phase.value = "done";
  }
  const queueGoal = debounce(800, () => void saveGoal());
  const queueResult = debounce(200, () => void saveResult());
  effect(() => {
    picture.value;
    masks.value;
    treeHeight.value;
    seconds.value;
    queueGoal();
  });
  effect(() => {
    if (result.value && !running.value) queueResult();
  });
}

/** A goal that the page brings is part of the link; a picture of the user's own never leaves the page. */
export const fitLink: Linked = {
  write(fields) {
    const target = picture.value?.target;
    if (!target) return;
    fields.set("goal", target.replace(/\.png$/, ""));
    fields.set("height", String(treeHeight.value));
  },

  async read(fields) {
    const name = fields.get("goal");
    if (!name || !/^[a-z0-9_]+$/.test(name) || picture.peek()?.target === `${name}.png`) return;
    await takeTarget(`${name}.png`);
    const height = Number(fields.get("height"));
    if (height > 0 && height <= 200) treeHeight.value = height;
  },
};
