// Small pictures, drawn by the workers when they come into view.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { thumbnails } from "../engine/pool";
import type { Spec, TreeStats } from "../engine/protocol";
import { sentence } from "../state/notes";

interface ThumbProps {
  spec: Spec;
  seed: number;
  season: string;
  size: number;
  name: string;
  /** Milliseconds of quiet before it is drawn: the recipe may still be changing. */
  wait?: number;
}

const kept = new Map<string, { image: ImageData; stats: TreeStats }>();
/** About 40 MiB of pictures of 224 × 224. */
const KEPT = 200;

function keep(key: string, image: ImageData, stats: TreeStats): void {
  kept.set(key, { image, stats });
  const oldest = kept.keys().next().value;
  if (kept.size > KEPT && oldest !== undefined) kept.delete(oldest);
}

/** From the top down, as one reads. */
function rank(element: Element): number {
  const { top, left } = element.getBoundingClientRect();
  return Math.round(top) * 10_000 + left;
}

export function Thumb({ spec, seed, season, size, name, wait = 0 }: ThumbProps): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const state = useSignal<"waiting" | "drawn" | "failed">("waiting");
  const text = useSignal(name);
  const key = `${size} ${season} ${seed} ${JSON.stringify(spec)}`;

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const put = (image: ImageData, stats: TreeStats) => {
      element.getContext("2d")?.putImageData(image, 0, 0);
      state.value = "drawn";
      text.value = `${name}, ${stats.height.toFixed(1)} m high`;
    };
    const known = kept.get(key);
    if (known) {
      put(known.image, known.stats);
      return;
    }
    const stop = new AbortController();
    const draw = () =>
      thumbnails
        .call("picture", { spec, seed, season, size, azimuth: 20, elevation: 4 }, stop.signal, rank(element))
        .then((picture) => {
          const image = new ImageData(new Uint8ClampedArray(picture.rgba.buffer), size, size);
          keep(key, image, picture.stats);
          if (!stop.signal.aborted) put(image, picture.stats);
        })
        .catch((error: unknown) => {
          if (stop.signal.aborted) return;
          state.value = "failed";
          text.value = `${name}: ${sentence(error) ?? "not drawn"}`;
        });
    let timer: ReturnType<typeof setTimeout> | undefined;
    const watcher = new IntersectionObserver(
      (entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        watcher.disconnect();
        timer = setTimeout(() => void draw(), wait);
      },
      { rootMargin: "200px" },
    );
    watcher.observe(element);
    return () => {
      clearTimeout(timer);
      watcher.disconnect();
      stop.abort();
    };
  }, [key]);

  return (
    <canvas
      ref={canvas}
      class={`thumb ${state.value}`}
      width={size}
      height={size}
      role="img"
      aria-label={text.value}
    />
  );
}
