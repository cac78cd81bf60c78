// The map on a canvas: hull, lines where choices switch, species, path, pins, point.
import type { Plane } from "../../engine/protocol";
import type { Place } from "./map-state";

/** From the plane to the canvas, in CSS pixels; +y goes up. */
export interface Frame {
  scale: number;
  left: number;
  top: number;
}

const THUMB = 56;

export function frameOf(plane: Plane, width: number, height: number): Frame {
  const [x0, y0, x1, y1] = plane.box;
  const margin = Math.min(56, width * 0.09);
  const scale = Math.min((width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y1 - y0));
  return { scale, left: width / 2 - ((x0 + x1) / 2) * scale, top: height / 2 + ((y0 + y1) / 2) * scale };
}

export const toCanvas = (frame: Frame, [x, y]: Place): [number, number] => [
  frame.left + x * frame.scale,
  frame.top - y * frame.scale,
];

export const toPlane = (frame: Frame, x: number, y: number): Place => [
  (x - frame.left) / frame.scale,
  (frame.top - y) / frame.scale,
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
  context.setLineDash([3, 4]);
  for (const { lines } of scene.plane.switches) {
    for (const [from, to] of lines) {
      trace(context, [toCanvas(frame, from), toCanvas(frame, to)]);
      context.stroke();
    }
  }
  context.setLineDash([]);
}

function drawSpecies(
  context: Context,
  scene: MapScene,
  frame: Frame,
  colors: MapColors,
  width: number,
): void {
  const side = width < 480 ? THUMB * 0.7 : THUMB;
  context.textAlign = "center";
  context.font = `500 ${width < 480 ? 10 : 11}px system-ui, sans-serif`;
  for (const { name, x, y } of scene.plane.dots) {
    const [left, top] = toCanvas(frame, [x, y]);
    const picture = scene.thumbs.get(name);
    if (picture) context.drawImage(picture, left - side / 2, top - side, side, side);
    context.fillStyle = colors.ink;
    context.beginPath();
    context.arc(left, top, 2.5, 0, 7);
    context.fill();
    const label = name.replaceAll("_", " ");
    const half = context.measureText(label).width / 2 + 3;
    const center = Math.min(Math.max(left, half), width - half);
    context.lineWidth = 3;
    context.strokeStyle = colors.paper;
    context.strokeText(label, center, top + 15);
    context.fillText(label, center, top + 15);
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
