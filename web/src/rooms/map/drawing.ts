// The map on a canvas: hull, lines where choices switch, species, path, pins, point.
import type { Plane } from "../../engine/protocol";
import type { Place } from "./map-state";

/** From the plane to the canvas, in CSS pixels; +y goes up. */
export interface Frame {
  x: number;
  y: number;
  left: number;
  top: number;
}

const THUMB = 56;
/** How much one axis may be stretched against the other, to use a tall or wide canvas. */
const MAX_STRETCH = 1.5;

export function frameOf(plane: Plane, width: number, height: number): Frame {
  const places = [...plane.hull, ...plane.dots.map(({ x, y }) => [x, y] as const)];
  const across = places.map(([x]) => x);
  const up = places.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...across), Math.max(...across), Math.min(...up), Math.max(...up)];
  // Room for names and thumbnails at the rim, and for trees beyond the hull.
  const side = Math.min(96, width * 0.14);
  const x = (width - 2 * side) / Math.max(x1 - x0, 1e-9);
  const y = (height - THUMB - 72) / Math.max(y1 - y0, 1e-9);
  const least = Math.min(x, y);
  const [scaleX, scaleY] = [Math.min(x, least * MAX_STRETCH), Math.min(y, least * MAX_STRETCH)];
  return {
    x: scaleX,
    y: scaleY,
    left: width / 2 - ((x0 + x1) / 2) * scaleX,
    top: (height + THUMB - 16) / 2 + ((y0 + y1) / 2) * scaleY,
  };
}

export const toCanvas = (frame: Frame, [x, y]: Place): [number, number] => [
  frame.left + x * frame.x,
  frame.top - y * frame.y,
];

export const toPlane = (frame: Frame, x: number, y: number): Place => [
  (x - frame.left) / frame.x,
  (frame.top - y) / frame.y,
];

export interface MapColors {
  ink: string;
  soft: string;
  line: string;
  hull: string;
  accent: string;
  warn: string;
  paper: string;
}

export interface MapScene {
  plane: Plane;
  thumbs: ReadonlyMap<string, CanvasImageSource>;
  point: Place | null;
  held: boolean;
  pins: readonly Place[];
  path: readonly Place[];
  switches: boolean;
}

type Context = CanvasRenderingContext2D;

function trace(context: Context, points: readonly (readonly [number, number])[]): void {
  context.beginPath();
  points.forEach(([x, y], at) => {
    if (at) context.lineTo(x, y);
    else context.moveTo(x, y);
  });
}

function drawSwitches(context: Context, scene: MapScene, frame: Frame, colors: MapColors): void {
  context.strokeStyle = colors.line;
  context.lineWidth = 1;
  for (const [from, to, count] of scene.plane.switches) {
    // Where many choices switch at once, trees change most.
    context.globalAlpha = Math.min(1, 0.25 + 0.15 * count);
    trace(context, [toCanvas(frame, from), toCanvas(frame, to)]);
    context.stroke();
  }
  context.globalAlpha = 1;
}

type Box = readonly [number, number, number, number];

const meet = (a: Box, b: Box) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

function drawSpecies(
  context: Context,
  scene: MapScene,
  frame: Frame,
  colors: MapColors,
  width: number,
): void {
  const small = width < 480;
  const side = small ? THUMB * 0.75 : THUMB;
  context.textAlign = "center";
  context.font = `500 ${small ? 10 : 11}px system-ui, sans-serif`;
  const places = scene.plane.dots.map((dot) => ({ dot, at: toCanvas(frame, [dot.x, dot.y]) }));
  for (const { dot, at } of places) {
    const [left, top] = at;
    const picture = scene.thumbs.get(dot.name);
    if (picture) context.drawImage(picture, left - side / 2, top - side, side, side);
    context.fillStyle = colors.ink;
    context.beginPath();
    context.arc(left, top, 2.5, 0, 7);
    context.fill();
  }
  // A name that would lie on another one is left out: the panel names the nearest species.
  const taken: Box[] = [];
  for (const { dot, at } of places) {
    const label = dot.name.replaceAll("_", " ");
    const half = context.measureText(label).width / 2 + 3;
    const center = Math.min(Math.max(at[0], half), width - half);
    const box: Box = [center - half, at[1] + 5, center + half, at[1] + 19];
    if (taken.some((other) => meet(box, other))) continue;
    taken.push(box);
    context.lineWidth = 3;
    context.strokeStyle = colors.paper;
    context.strokeText(label, center, at[1] + 15);
    context.fillStyle = colors.ink;
    context.fillText(label, center, at[1] + 15);
  }
}

export function drawMap(canvas: HTMLCanvasElement, scene: MapScene, colors: MapColors): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  const ratio = Math.min(devicePixelRatio, 2);
  const { clientWidth: width, clientHeight: height } = canvas;
  const size = [Math.round(width * ratio), Math.round(height * ratio)] as const;
  if (canvas.width !== size[0]) canvas.width = size[0];
  if (canvas.height !== size[1]) canvas.height = size[1];
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  const frame = frameOf(scene.plane, width, height);
  trace(
    context,
    scene.plane.hull.map((place) => toCanvas(frame, place)),
  );
  context.closePath();
  context.fillStyle = colors.hull;
  context.fill();
  context.strokeStyle = colors.line;
  context.lineWidth = 1;
  context.stroke();
  if (scene.switches) drawSwitches(context, scene, frame, colors);
  drawSpecies(context, scene, frame, colors, width);
  if (scene.path.length > 1) {
    trace(
      context,
      scene.path.map((place) => toCanvas(frame, place)),
    );
    context.strokeStyle = colors.accent;
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.stroke();
  }
  for (const [at, place] of scene.pins.entries())
    drawPin(context, toCanvas(frame, place), String(at + 1), colors);
  if (scene.point) drawPoint(context, toCanvas(frame, scene.point), scene.held, colors);
}

function drawPin(context: Context, [x, y]: [number, number], label: string, colors: MapColors): void {
  context.fillStyle = colors.accent;
  context.beginPath();
  context.arc(x, y - 16, 10, Math.PI * 0.85, Math.PI * 2.15);
  context.lineTo(x, y);
  context.fill();
  context.fillStyle = colors.paper;
  context.textAlign = "center";
  context.font = "600 11px system-ui, sans-serif";
  context.fillText(label, x, y - 12);
}

function drawPoint(context: Context, [x, y]: [number, number], held: boolean, colors: MapColors): void {
  context.strokeStyle = colors.accent;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(x, y, 8, 0, 7);
  context.stroke();
  if (!held) return;
  context.fillStyle = colors.accent;
  context.beginPath();
  context.arc(x, y, 3.5, 0, 7);
  context.fill();
}
