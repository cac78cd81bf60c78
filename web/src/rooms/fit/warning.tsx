// What is odd about a goal, with what the page can do about it.
import type { JSX } from "preact";
import type { GoalWarning } from "../../engine/protocol";
import { Button } from "../../ui/controls";
import { waysFor } from "./correct-mask";
import { running } from "./fit-state";
import { reading } from "./goal-state";

export function Warning({ of: { kind, message } }: { of: GoalWarning }): JSX.Element {
  const ways = waysFor(kind);
  const busy = running.value || reading.value !== null;
  return (
    <div class="warning" data-kind={kind}>
      <p>{message}.</p>
      {ways.length > 0 && (
        <div class="row wrap">
          {ways.map(({ label, run }) => (
            <Button key={label} label={label} disabled={busy} onPress={run} />
          ))}
        </div>
      )}
    </div>
  );
}
