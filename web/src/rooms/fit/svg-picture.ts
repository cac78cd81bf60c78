// Drawings in SVG as pictures: the browser paints them. In an image element it runs no script and loads nothing from
// elsewhere.
import { canvasPng } from "../../ui/files";
import { entities, MAX_BYTES, refused, withoutStyles, withStyles } from "./svg-bounds";

/** The longer side of the picture, in pixels: as the library paints drawings. */
const SIDE = 1024;

export const isSvg = ({ name, type }: File) => type === "image/svg+xml" || /\.svg$/i.test(name);

const SVG = "http://www.w3.org/2000/svg";

/** Pixels of one CSS unit. */
const UNITS: Record<string, number> = {
  "": 1,
  px: 1,
  pt: 4 / 3,
  pc: 16,
  mm: 96 / 25.4,
  cm: 96 / 2.54,
  in: 96,
  em: 16,
  ex: 8,
};

/** A length in pixels; null for none, and for a part of what is around the drawing. */
function length(text: string | null): number | null {
  const [, value, unit] = /^\s*\+?([\d.]+(?:e[+-]?\d+)?)\s*([a-z]*)\s*$/i.exec(text ?? "") ?? [];
  const pixels = Number(value) * (UNITS[(unit ?? "").toLowerCase()] ?? Number.NaN);
  return pixels > 0 && Number.isFinite(pixels) ? pixels : null;
}

interface Size {
  width: number;
  height: number;
}

/** Of the root: its sides, or those of its view box; null if it has neither. */
function sizeOf(root: Element): Size | null {
  const box = (root.getAttribute("viewBox") ?? "")
    .trim()
    .split(/[\s,]+/)
    .map(Number);
  const [, , across = Number.NaN, down = Number.NaN] = box;
  const [width, height] = [length(root.getAttribute("width")), length(root.getAttribute("height"))];
  const hasBox = box.length === 4 && across > 0 && down > 0 && Number.isFinite(across / down);
  if (width && height) return { width, height };
  if (!hasBox) return null;
  if (width) return { width, height: (width * down) / across };
  if (height) return { width: (height * across) / down, height };
  return { width: across, height: down };
}

/** The file as the browser reads it. Throws a sentence if it is not read. */
function parse(text: string): Document {
  const tooMany = entities(text);
  if (tooMany) throw new Error(tooMany);
  const drawing = new DOMParser().parseFromString(withoutStyles(text), "image/svg+xml");
  const wrong = drawing.querySelector("parsererror");
  if (wrong) {
    const where = /line (\d+)/i.exec(wrong.textContent ?? "");
    throw new Error(`It is no complete XML${where ? `: see its line ${where[1]}` : ""}.`);
  }
  const root = drawing.documentElement;
  if (root.localName !== "svg") throw new Error("It is XML, but no drawing.");
  if (root.namespaceURI !== SVG) throw new Error(`Its first element does not say xmlns="${SVG}".`);
  const why = refused(drawing);
  if (why) throw new Error(why);
  return drawing;
}

/** The text of the drawing with sides in pixels: without them, browsers do not agree on how large it is. */
function scaled(drawing: Document): { text: string; size: Size } {
  const root = drawing.documentElement;
  const own = sizeOf(root);
  if (!own) throw new Error("It does not say how large it is: neither width and height nor a viewBox.");
  const scale = SIDE / Math.max(own.width, own.height);
  const side = (of: number) => Math.max(1, Math.round(of * scale));
  const size = { width: side(own.width), height: side(own.height) };
  if (!root.hasAttribute("viewBox")) root.setAttribute("viewBox", `0 0 ${own.width} ${own.height}`);
  root.setAttribute("width", String(size.width));
  root.setAttribute("height", String(size.height));
  return { text: withStyles(new XMLSerializer().serializeToString(drawing)), size };
}

async function painted({ text, size }: { text: string; size: Size }): Promise<HTMLCanvasElement> {
  const address = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
  try {
    const image = new Image(size.width, size.height);
    image.src = address;
    await image.decode().catch(() => {
      throw new Error("The browser cannot paint it.");
    });
    const canvas = document.createElement("canvas");
    canvas.width = size.width;
    canvas.height = size.height;
    canvas.getContext("2d")?.drawImage(image, 0, 0, size.width, size.height);
    return canvas;
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** The drawing as a PNG file, transparent where nothing is painted. Throws with the name of the file and a sentence. */
export async function paintSvg(file: File): Promise<Uint8Array> {
  try {
    if (file.size > MAX_BYTES)
      throw new Error(`It has ${file.size} bytes, and at most ${MAX_BYTES} are read.`);
    const canvas = await painted(scaled(parse(await file.text())));
    return new Uint8Array(await (await canvasPng(canvas)).arrayBuffer());
  } catch (error) {
    throw new Error(`${file.name}: ${error instanceof Error ? error.message : error}`);
  }
}
