// What to do after a fit: the library says which steps, and each is a button that does it.
import type { JSX } from "preact";
import { sayError } from "../../state/notes";
import { go } from "../../state/route";
import { start } from "../../state/species";
import { Button } from "../../ui/controls";
import { anyWay, type Way } from "./correct-mask";
import { BUDGETS, generator, leafiness, running, seconds, startFit } from "./fit-state";
import { PART_ID } from "./look-part";
import { lookShown } from "./look-state";
import { result } from "./record";
import { HEIGHT_ID, timeText } from "./search-part";

/** Trees that each kind is scored by, so that no single seed decides. */
const SEVERAL = 4;

/** The next longer time to search; null where there is none. */
const longer = (): number | null => BUDGETS.find((time) => time > seconds.value) ?? null;

function growMore(): void {
  const fit = result.peek();
  if (!fit) return;
  start({ toml: fit.toml, name: fit.report.species }, { season: "" })
    .then(() => go("species"))
    .catch(sayError);
}

function searchLonger(time: number): void {
  seconds.value = time;
  void startFit();
}

function leaves(how: "on" | "off"): void {
  leafiness.value = how;
  void startFit();
}

function everySeed(): void {
  const time = longer();
  if (time !== null) seconds.value = time;
  void startFit({ robust: SEVERAL });
}

function anyFamily(): void {
  generator.value = "auto";
  void startFit();
}

function showReading(): void {
  lookShown.value = true;
  document.querySelector('[data-testid="goal"]')?.scrollIntoView({ block: "nearest", behavior: "smooth" });
  document.querySelector<HTMLElement>(`#${PART_ID} input`)?.focus({ preventScroll: true });
}

function tellHeight(): void {
  const field = document.getElementById(HEIGHT_ID);
  field?.scrollIntoView({ block: "center", behavior: "smooth" });
  field?.focus({ preventScroll: true });
}

/** What the page does for a word of the library; nothing for a word that it does not know. */
function waysOf(step: string): readonly Way[] {
  switch (step) {
    case "grow-more":
      return [{ label: "Grow more of its kind", run: growMore }];
    case "every-seed":
      return [{ label: `Search a kind that ${SEVERAL} seeds agree on`, run: everySeed }];
    case "correct-mask":
      return anyWay();
    case "leafy":
      return [{ label: "Fit it with leaves", run: () => leaves("on") }];
    case "bare":
      return [{ label: "Fit it without leaves", run: () => leaves("off") }];
    case "correct-reading":
      return [{ label: "Correct what was read", run: showReading }];
    case "any-family":
      return generator.value === "auto" ? [] : [{ label: "Try all families", run: anyFamily }];
    case "search-longer": {
      const time = longer();
      return time === null ? [] : [{ label: `Search for ${timeText(time)}`, run: () => searchLonger(time) }];
    }
    case "tell-height":
      return [{ label: "Say how tall it is", run: tellHeight }];
    default:
      return [];
  }
}

export function NextSteps({ of }: { of: readonly string[] }): JSX.Element | null {
  const ways = of.flatMap(waysOf);
  if (ways.length === 0) return null;
  return (
    <div class="next" data-testid="next">
      <h4>What to do next</h4>
      <div class="row wrap">
        {ways.map(({ label, run }) => (
          <Button key={label} label={label} disabled={running.value} onPress={run} />
        ))}
      </div>
    </div>
  );
}
