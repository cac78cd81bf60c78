// A canvas of the page that a worker draws the trees of a search on.
import type { FromGrowing, Growing, ToGrowing } from "./growing-protocol";

export interface GrowingEvents {
  /** A tree is on the screen, after so many milliseconds. */
  drawn(took: number, programs: number): void;
  /** Nothing can be drawn in three dimensions. */
  failed(): void;
}

export class GrowingCanvas {
  private readonly worker = new Worker(new URL("./growing-worker.ts", import.meta.url), { type: "module" });
  private readonly watcher = new ResizeObserver(() => this.resize());
  private pictures: Growing["pictures"] | null = null;

  /** Throws where the browser lets no worker draw. A canvas can be given away once. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    dark: boolean,
    events: GrowingEvents,
  ) {
    this.worker.onmessage = ({ data }: MessageEvent<FromGrowing>) => {
      if ("failed" in data) events.failed();
      else events.drawn(data.took, data.programs);
    };
    this.worker.onerror = () => events.failed();
    const away = canvas.transferControlToOffscreen();
    this.send({ canvas: away }, [away]);
    this.resize();
    this.watcher.observe(canvas);
    this.setTheme(dark);
  }

  /** The tree is given away: its arrays are empty then. */
  show({ tree, pictures }: Growing): void {
    const isKnown = this.pictures === pictures;
    this.pictures = pictures;
    const { positions, normals, uv, indices } = tree;
    const arrays = [positions, normals, uv, indices].map(({ buffer }) => buffer);
    this.send({ tree, pictures: isKnown ? null : pictures }, arrays);
  }

  setTheme(dark: boolean): void {
    this.send({ dark });
  }

  orbit(around: number, up: number, factor: number): void {
    this.send({ orbit: [around, up, factor] });
  }

  dispose(): void {
    this.watcher.disconnect();
    this.worker.terminate();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width > 0 && height > 0) this.send({ width, height, ratio: Math.min(devicePixelRatio, 2) });
  }

  private send(message: ToGrowing, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }
}
