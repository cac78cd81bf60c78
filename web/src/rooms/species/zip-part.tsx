// The button that saves several trees as one zip, what that costs, and how far it is.
import { useSignal } from "@preact/signals";
import type { ComponentChildren, JSX } from "preact";
import { useEffect } from "preact/hooks";
import { sayError } from "../../state/notes";
import { Bar, Button } from "../../ui/controls";
import { cancelZip, estimate, keyOf, measure, writeZip, writing, type ZipJob } from "./zip-state";

/** Milliseconds without a change before the first tree is written to see how large it is. */
const QUIET = 600;

export function ZipPart({ job, what }: { job: ZipJob; what: string }): JSX.Element {
  const key = keyOf(job);
  useEffect(() => {
    const timer = setTimeout(() => void measure(job).catch(sayError), QUIET);
    return () => clearTimeout(timer);
  }, [key]);
  const known = estimate.value?.key === key ? estimate.value.words : null;
  const now = writing.value;
  if (now) {
    return (
      <div class="zip">
        <p role="status">{now.text}</p>
        <div class="row">
          <Bar label="Progress of the zip" share={now.share} />
          <Button icon="stop" label="Cancel" onPress={cancelZip} testid="zip-cancel" />
        </div>
      </div>
    );
  }
  return (
    <div class="zip">
      <p class="hint">{what}</p>
      <Button
        icon="download"
        label={known ? `Zip of ${job.trees.length}, ${known}` : `Zip of ${job.trees.length}`}
        title={
          known
            ? "By the first tree; the others differ a little."
            : "The first tree is written to see how large it is."
        }
        testid="zip"
        onPress={() => void writeZip(job)}
      />
    </div>
  );
}

/** What is asked for eight trees; it is made once somebody wants to see it. */
export function ZipDetails({ children }: { children: () => ComponentChildren }): JSX.Element {
  const open = useSignal(false);
  return (
    <details
      class="eighttrees"
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary data-testid="zip-open">Eight trees in a zip</summary>
      {open.value && children()}
    </details>
  );
}
