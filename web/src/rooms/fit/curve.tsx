// The curve of the score over the seconds of search.
import type { JSX } from "preact";
import { seconds } from "./fit-state";
import { type CurvePoint, curve } from "./record";

const WIDTH = 640;
const HEIGHT = 160;
const LEFT = 48;
const BOTTOM = 22;
const TICKS = [0, 0.25, 0.5, 0.75, 1];

export function Curve(): JSX.Element {
  const points = curve.value;
  const last = points.at(-1);
  const end = Math.max(seconds.value, last?.seconds ?? 0);
  const x = (time: number) => LEFT + ((WIDTH - LEFT - 8) * time) / end;
  const y = (score: number) => 8 + (HEIGHT - BOTTOM - 8) * (1 - Math.max(0, Math.min(1, score)));
  const path = (of: (point: CurvePoint) => number) =>
    points
      .map((point, at) => `${at ? "L" : "M"}${x(point.seconds).toFixed(1)} ${y(of(point)).toFixed(1)}`)
      .join("");
  const text = last
    ? `After ${last.seconds.toFixed(0)} seconds likeness ${last.likeness.toFixed(3)}, IoU ${last.iou.toFixed(3)}`
    : "No score yet";
  return (
    <figure class="curve">
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={`Curve of the score. ${text}`}>
        {TICKS.map((tick) => (
          <g key={tick}>
            <line class="grid" x1={LEFT} x2={WIDTH - 8} y1={y(tick)} y2={y(tick)} />
            <text x={LEFT - 6} y={y(tick) + 4} text-anchor="end">
              {tick}
            </text>
          </g>
        ))}
        {[0, end / 2, end].map((time) => (
          <text
            key={time}
            x={x(time)}
            y={HEIGHT - 5}
            text-anchor={time === end ? "end" : time ? "middle" : "start"}
          >
            {Math.round(time)} s
          </text>
        ))}
        <path class="iou" d={path((point) => point.iou)} />
        <path class="likeness" d={path((point) => point.likeness)} />
      </svg>
      <figcaption>
        <span class="key likeness">Likeness</span>
        <span class="key iou">IoU</span>
      </figcaption>
    </figure>
  );
}
