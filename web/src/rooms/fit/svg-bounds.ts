// What a drawing in SVG may have, checked before the browser paints it: a few hundred bytes can stand for any number of
// shapes. The bounds are those of the library, but for the number of shapes, since the page waits while they are painted.

/** Bytes of a drawing. */
export const MAX_BYTES = 1 << 22;
/** Elements once each `use` is what it names. */
const MAX_ELEMENTS = 20_000;
/** How deep they may lie in each other. */
const MAX_DEPTH = 500;
/** Elements times characters of style sheets: each rule is tried on each element. */
const MAX_STYLED = 1 << 27;
/** Characters that entities may become. */
const MAX_EXPANDED = 1 << 28;

/** Elements that are not read: some take any time, and the others would hide parts of the tree. */
const REFUSED = ["clipPath", "filter", "foreignObject", "marker", "mask", "pattern"];

/** What styles are called while the page reads a drawing: its policy allows none of their own in what it reads. */
const HIDDEN = "pleach-style";
export const withoutStyles = (text: string) =>
  text.replace(/(<\/?(?:[\w.-]+:)?)style\b/g, `$1${HIDDEN}`).replace(/(\s)style(\s*=)/g, `$1${HIDDEN}$2`);
export const withStyles = (text: string) => text.replaceAll(HIDDEN, "style");

/** A sentence with what is wrong with the text of a file; null if nothing is. */
export function entities(text: string): string | null {
  const from = text.indexOf("<!ENTITY");
  if (from < 0) return null;
  const to = text.lastIndexOf("]>");
  const declared = Math.max(0, (to < 0 ? text.length : to) - from);
  const references = text.split("&").length - 1;
  return declared * references * 256 > MAX_EXPANDED ? "It has too many entities." : null;
}

/** A sentence with what a drawing has that is not read; null if it has nothing of that. */
export function refused(drawing: Document): string | null {
  const found = [...drawing.querySelectorAll("*")].find(({ localName }) => REFUSED.includes(localName));
  if (found) return `It has the element ${found.localName}, which is not read. Save it without, or as PNG.`;
  let count: number;
  try {
    count = sizeOf(drawing);
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
  if (count > MAX_ELEMENTS) {
    return `It has more than ${MAX_ELEMENTS.toLocaleString("en")} shapes, counting each use as what it names. Save it as PNG.`;
  }
  const styles = [...drawing.getElementsByTagNameNS("*", HIDDEN)].reduce((sum, { textContent }) => {
    return sum + (textContent?.length ?? 0);
  }, 0);
  return styles * count > MAX_STYLED
    ? "Its style sheets are too long for so many shapes. Save it as PNG."
    : null;
}

/** Elements of a drawing, of which each `use` counts as what it names. Throws a sentence if they lie too deep. */
function sizeOf(drawing: Document): number {
  const sizes = new Map<Element, number>();
  const measure = (element: Element, depth: number): number => {
    const known = sizes.get(element);
    if (known !== undefined) return known;
    // What lies in itself has no end.
    if (depth > MAX_DEPTH) throw new Error(`Its elements are nested more than ${MAX_DEPTH} deep.`);
    let size = 1;
    for (const child of element.children) size += measure(child, depth + 1);
    const target = element.localName === "use" ? named(drawing, element) : null;
    if (target) size += measure(target, depth + 1);
    sizes.set(element, size);
    return size;
  };
  return measure(drawing.documentElement, 0);
}

/** What a `use` names in the same drawing. */
function named(drawing: Document, element: Element): Element | null {
  const link = [...element.attributes].find(({ localName }) => localName === "href")?.value.trim();
  return link?.startsWith("#") ? drawing.getElementById(link.slice(1)) : null;
}
