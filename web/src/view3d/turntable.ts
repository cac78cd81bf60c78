// A view that turns once around its tree, picture by picture: as a video where the browser records one.
import { canvasPng } from "../ui/files";
import type { SceneView } from "./scene-view";

/** Pictures of one turn as files, and as a video with so many a second. */
const PICTURES = 36;
const RATE = 24;
const SECONDS = 5;

const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

/** What the browser records; null where it records nothing. */
export function videoType(): string | null {
  if (typeof MediaRecorder === "undefined" || !("captureStream" in HTMLCanvasElement.prototype)) return null;
  return TYPES.find((type) => MediaRecorder.isTypeSupported(type)) ?? null;
}

export interface Turn {
  readonly view: SceneView;
  /** The share of the turn that is done. */
  readonly progress: (share: number) => void;
  readonly signal: AbortSignal;
}

/**
 * Turns the view once. `use` gets each picture on a canvas of its own, and says which share of the turn the next one is at;
 * from 1 on there is none.
 */
async function turn(
  { view, progress, signal }: Turn,
  use: (canvas: HTMLCanvasElement) => Promise<number>,
): Promise<void> {
  const canvas = document.createElement("canvas");
  const stop = view.beginTurn();
  try {
    let share = 0;
    while (share < 1) {
      signal.throwIfAborted();
      view.turnTo(2 * Math.PI * share, canvas);
      share = await use(canvas);
      progress(Math.min(1, share));
    }
  } finally {
    stop();
  }
}

/** PNG files, one for each picture. */
export async function pictures(of: Turn): Promise<{ name: string; bytes: Uint8Array<ArrayBuffer> }[]> {
  const files: { name: string; bytes: Uint8Array<ArrayBuffer> }[] = [];
  await turn(of, async (canvas) => {
    const png = await canvasPng(canvas);
    const name = `${String(files.length).padStart(2, "0")}.png`;
    files.push({ name, bytes: new Uint8Array(await png.arrayBuffer()) });
    return files.length / PICTURES;
  });
  return files;
}

/** A video in real time: what cannot be drawn in time is left out, and the turn takes as long. */
export async function video(of: Turn, type: string): Promise<Blob> {
  const parts: Blob[] = [];
  let recorder: MediaRecorder | undefined;
  let ended: Promise<void> | undefined;
  let wrong: Error | null = null;
  const begin = (canvas: HTMLCanvasElement) => {
    recorder = new MediaRecorder(canvas.captureStream(RATE), { mimeType: type, videoBitsPerSecond: 8e6 });
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const made = recorder;
    ended = new Promise((done) => {
      made.onstop = () => done();
      made.onerror = () => {
        wrong = new Error("The browser could not record the video.");
        done();
      };
    });
    recorder.start();
  };
  let begun = 0;
  try {
    await turn(of, async (canvas) => {
      if (!recorder) {
        begin(canvas);
        begun = performance.now();
      }
      await new Promise((go) => setTimeout(go, 1000 / RATE));
      return (performance.now() - begun) / (1000 * SECONDS);
    });
  } finally {
    if (recorder && recorder.state !== "inactive") recorder.stop();
    for (const track of recorder?.stream.getTracks() ?? []) track.stop();
  }
  await ended;
  if (wrong) throw wrong;
  const whole = new Blob(parts, { type });
  if (whole.size === 0) throw new Error("The browser has recorded nothing.");
  return whole;
}
