// Goals: reading pictures, and checking a mask that was painted.
import { Goal } from "../wasm/pleach_web.js";
import type { GoalInfo, GoalPixels, Look } from "./protocol";
import type { Handlers } from "./worker";

const info = (goal: Goal) => JSON.parse(goal.info()) as GoalInfo;

/** The goal of these pixels and lines. The caller frees it. */
export function makeGoal(pixels: GoalPixels): Goal {
  const inked = Goal.from_pixels(pixels.name, pixels.width, pixels.height, pixels.ink);
  const plain = pixels.colors === null ? inked : inked.with_colors(pixels.colors);
  if (pixels.ground === null && pixels.axis === null) return plain;
  const lined = plain.with_ground(pixels.ground ?? undefined, pixels.axis ?? undefined);
  plain.free();
  return lined;
}

export const goalHandlers: Handlers<"goalRead" | "goalCheck" | "goalLook"> = {
  goalRead({ name, bytes, mask, hints }) {
    const goal = Goal.read(name, bytes, mask, JSON.stringify(hints));
    const out = { info: info(goal), ink: goal.pixels().slice(), photo: goal.photo().slice() };
    goal.free();
    return out;
  },

  goalCheck(pixels) {
    const goal = makeGoal(pixels);
    const out = info(goal);
    goal.free();
    return out;
  },

  goalLook({ goal: pixels, photo, corrections }) {
    const goal = makeGoal(pixels);
    const out = JSON.parse(goal.look(photo ?? undefined, JSON.stringify(corrections))) as Look;
    goal.free();
    return out;
  },
};
