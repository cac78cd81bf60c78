// The one view in three dimensions that is open, for those who need its picture.
import type { SceneView } from "./scene-view";

let current: SceneView | null = null;

export const view = () => current;

/** Null when its room closes: what the graphics card holds is released. */
export function setView(next: SceneView | null): void {
  if (current !== next) current?.dispose();
  current = next;
}

type Step = [around: number, up: number, factor: number];

const KEYS: Record<string, Step> = {
  ArrowLeft: [-0.15, 0, 1],
  ArrowRight: [0.15, 0, 1],
  ArrowUp: [0, 0.1, 1],
  ArrowDown: [0, -0.1, 1],
  "+": [0, 0, 0.87],
  "=": [0, 0, 0.87],
  "-": [0, 0, 1.15],
};

/** What the keys of a view are called, for those who do not see it. */
export const KEYS_IN_WORDS = "Arrow keys turn it, plus and minus come nearer and go back.";

/** Calls `turn` if the key is one of those that turn a view. */
export function onTurningKey(event: KeyboardEvent, turn: (...step: Step) => void): void {
  const step = KEYS[event.key];
  if (!step || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  turn(...step);
}

/** Turns the open view if the key is one of its own. */
export const turnByKey = (event: KeyboardEvent) => onTurningKey(event, (...step) => current?.orbit(...step));
