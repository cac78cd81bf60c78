// What the library says of a fit, in words, and what to do next.
import type { JSX } from "preact";
import { NextSteps } from "./next-steps";
import { result } from "./record";
import { meaning } from "./score-card";

/** So many differences are shown. */
const SHOWN = 3;

export function Verdict(): JSX.Element | null {
  const fit = result.value;
  if (!fit) return null;
  const { readings, next = [], likeness } = fit.report;
  const differences = readings.differences.slice(0, SHOWN);
  return (
    <section class="verdict" aria-label="Verdict" data-testid="verdict">
      <p>{fit.verdict ?? meaning(likeness)}.</p>
      {differences.length > 0 && (
        <ul class="differences" data-testid="differences">
          {differences.map(({ words }) => (
            <li key={words}>{words}</li>
          ))}
        </ul>
      )}
      <NextSteps of={next} />
    </section>
  );
}
