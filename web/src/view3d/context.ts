// The graphics context of a canvas, and how work with it is cut into tasks. No view is loaded for it.

/** As views ask for it: a canvas has one context, the first that was asked for. */
const ATTRIBUTES: WebGLContextAttributes = { alpha: true, antialias: true, depth: true, stencil: false };

/** Opens the graphics context that a view of this canvas will use. */
export function openContext(canvas: HTMLCanvasElement): void {
  canvas.getContext("webgl2", ATTRIBUTES);
}

/** What comes after it is a task of its own. */
export const nextTask = () => new Promise<void>((go) => setTimeout(go));
