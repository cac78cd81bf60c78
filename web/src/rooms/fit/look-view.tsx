// What was read in the goal, drawn over it, with handles for what a person may see better.
import type { JSX } from "preact";
import { correct, picture } from "./goal-state";
import { Handle } from "./handle";
import { type At, degrees, type Found, mainFoot, measure, Places, radians, trunkAt } from "./look-measures";
import { look, lookShown } from "./look-state";

/** Part of the height at which the handle of the lean is. */
const LEAN_AT = 0.3;
/** Half the length of the line of the bare height, in heights. */
const BAR = 0.1;
const ARM = 0.1;
/** The lean by which a trunk is still one. */
const MAX_LEAN = 60;
/** The handles at the picture's edges are so far inside. */
const INSET = 0.02;

const hundredths = (value: number) => value.toFixed(2);

export function LookView(): JSX.Element | null {
  const seen = look.value;
  const shown = picture.value;
  if (!seen?.anchor || !shown || !lookShown.value) return null;
  const { width, height } = shown;
  const places = new Places(seen.anchor, width, height);
  return (
    <>
      <svg
        class="reading-lines"
        viewBox={`0 0 ${width} ${height}`}
        preserveAspectRatio="none"
        aria-hidden="true"
      >
        <Drawn found={seen.found} places={places} />
      </svg>
      <Handles found={seen.found} places={places} />
    </>
  );
}

interface Props {
  found: Found;
  places: Places;
}

/** Crown, trunk, feet, forks, and the lines that the handles move. */
function Drawn({ found, places }: Props): JSX.Element {
  const outline = (sides: number[], sign: number) =>
    sides.map((reach, at): At => [sign * reach, at / (sides.length - 1)]);
  const edge = (side: number) => found.trunk.map(([x, y, wide]): At => [x + side * wide, y]);
  const bare = measure("bare_height", found);
  const fork = measure("first_fork", found);
  const lean = measure("lean_deg", found);
  const line = (kind: string, ...points: At[]) => (
    <>
      <polyline class="under" points={places.line(points)} />
      <polyline class={kind} points={places.line(points)} />
    </>
  );
  const forkAt = fork === null ? 0 : (found.fork_x ?? trunkAt(found, fork));
  return (
    <>
      {line("crown", ...outline(found.crown.left, -1))}
      {line("crown", ...outline(found.crown.right, 1))}
      {line("trunk", ...edge(-0.5))}
      {line("trunk", ...edge(0.5))}
      {found.feet.map(({ x, width: wide }) => (
        <g key={x}>{line("foot", [x - wide / 2, 0.006], [x + wide / 2, 0.006])}</g>
      ))}
      {lean !== null && line("lean", [trunkAt(found, 0), 0], leaning(found, lean))}
      {bare !== null && (
        <>
          <polyline
            class="lead bare"
            points={places.line([places.edges(bare)[0], [trunkAt(found, bare), bare]])}
          />
          {line("bare", [trunkAt(found, bare) - BAR, bare], [trunkAt(found, bare) + BAR, bare])}
        </>
      )}
      {fork !== null && (
        <>
          <polyline class="lead fork" points={places.line([[forkAt, fork], places.edges(fork)[1]])} />
          {found.fork_arms_deg.map((angle) => (
            <g key={angle}>
              {line(
                "fork",
                [forkAt, fork],
                [forkAt + ARM * Math.sin(radians(angle)), fork + ARM * Math.cos(radians(angle))],
              )}
            </g>
          ))}
        </>
      )}
    </>
  );
}

/** Where the handle of the lean is. */
const leaning = (found: Found, lean: number): At => [
  trunkAt(found, 0) + LEAN_AT * Math.tan(radians(lean)),
  LEAN_AT,
];

function Handles({ found, places }: Props): JSX.Element {
  const bare = measure("bare_height", found);
  const fork = measure("first_fork", found);
  const lean = measure("lean_deg", found);
  const wide = measure("trunk_width", found);
  const foot = mainFoot(found)?.x ?? 0;
  const row = (y: number) => places.part([0, y])[1];
  return (
    <>
      {lean !== null && (
        <Handle
          name="Lean"
          label="lean"
          kind="measure at-side"
          way="horizontal"
          at={places.part(leaning(found, lean))}
          value={Math.round(lean)}
          range={[-MAX_LEAN, MAX_LEAN]}
          text={`${Math.abs(Math.round(lean))}° to the ${lean < 0 ? "left" : "right"}`}
          step={1}
          valueAt={(place) => degrees(Math.atan2(places.tree(place)[0] - trunkAt(found, 0), LEAN_AT))}
          onValue={(to) => correct({ lean_deg: to }, "measure lean")}
        />
      )}
      {wide !== null && (
        <Handle
          name="Trunk width"
          label="width"
          kind="measure below"
          way="horizontal"
          at={places.part([foot + wide / 2, 0])}
          value={Number(wide.toFixed(3))}
          range={[0.005, 0.5]}
          text={`${wide.toFixed(3)} of the height`}
          step={0.005}
          valueAt={(place) => 2 * (places.tree(place)[0] - foot)}
          onValue={(to) => correct({ trunk_width: to }, "measure width")}
        />
      )}
      {bare !== null && (
        <Handle
          name="Bare"
          label="bare"
          kind="measure at-left"
          way="vertical"
          at={[INSET, row(bare)]}
          value={Number(hundredths(bare))}
          range={[0, 1]}
          text={`up to ${hundredths(bare)} of the height`}
          step={0.01}
          valueAt={(place) => places.tree(place)[1]}
          onValue={(to) => correct({ bare_height: to }, "measure bare")}
        />
      )}
      {fork !== null && (
        <Handle
          name="Fork"
          label="fork"
          kind="measure at-right"
          way="vertical"
          at={[1 - INSET, row(fork)]}
          value={Number(hundredths(fork))}
          range={[0, 1]}
          text={`at ${hundredths(fork)} of the height`}
          step={0.01}
          valueAt={(place) => places.tree(place)[1]}
          onValue={(to) => correct({ first_fork: to }, "measure fork")}
        />
      )}
    </>
  );
}
