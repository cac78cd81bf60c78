// Goals: reading pictures, and checking a mask that was painted.
import { Goal } from "../wasm/pleach_web.js";
import type { GoalData, GoalInfo, GoalPixels, Look } from "./protocol";
import { decoded, smallerInk, smallerPhoto, within } from "./smaller";
import type { Handlers } from "./worker";

const info = (goal: Goal) => JSON.parse(goal.info()) as GoalInfo;

/** The goal of these pixels and lines. The caller frees it. */
export function makeGoal(pixels: GoalPixels): Goal {
  const inked = Goal.from_pixels(pixels.name, pixels.width, pixels.height, pixels.ink);
  const plain = pixels.colors === null ? inked : inked.with_colors(pixels.colors.json, pixels.colors.layers);
  if (pixels.ground === null && pixels.axis === null) return plain;
  const lined = plain.with_ground(pixels.ground ?? undefined, pixels.axis ?? undefined);
  plain.free();
  return lined;
}

/**
 * Longest side of a goal in pixels. A fit looks at far fewer; the page paints and keeps this many. The mask of a larger
 * photograph is found at its own size.
 */
const LONGEST = 1280;

async function smaller({ info: whole, ink, photo, full }: GoalData, bytes: Uint8Array): Promise<GoalData> {
  const size = within(full, LONGEST);
  const less = smallerInk(ink, full, size);
  const shown = photo.length > 0 ? smallerPhoto(photo, full, size) : await decoded(bytes, full, size);
  const goal = Goal.from_pixels(whole.name, size.width, size.height, less);
  const { masked, confidence, warnings } = whole;
  const out = { ...info(goal), masked, confidence, warnings };
  goal.free();
  return { info: out, ink: less, photo: shown ?? new Uint8Array(0), full };
}

export const goalHandlers: Handlers<"goalRead" | "goalCheck" | "goalLook"> = {
  async goalRead({ name, bytes, mask, hints }) {
    const goal = Goal.read(name, bytes, mask, JSON.stringify(hints));
    const found = { info: info(goal), ink: goal.pixels().slice(), photo: goal.photo().slice() };
    goal.free();
    const { width, height } = found.info;
    const full = { width, height };
    return Math.max(width, height) > LONGEST ? smaller({ ...found, full }, bytes) : { ...found, full };
  },

  goalCheck(pixels) {
    const goal = makeGoal(pixels);
    const out = info(goal);
    goal.free();
    return out;
  },

  goalLook({ goal: pixels, photo, corrections }) {
    const goal = makeGoal(pixels);
    const found = goal.look(photo ?? undefined, JSON.stringify(corrections));
    const out = { ...(JSON.parse(found.json) as Look), layers: found.layers.slice() };
    found.free();
    goal.free();
    return out;
  },
};
