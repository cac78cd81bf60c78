// Draws the trees of a search away from the page's own thread, which a graphics card would hold up.
import type { FromGrowing, Growing, ToGrowing } from "./growing-protocol";
import { GrowingView } from "./growing-view";

let view: GrowingView | null = null;
let pictures: Growing["pictures"] | null = null;
/** Trees come one after the other, and each is drawn before the next. */
let last: Promise<void> = Promise.resolve();

const send = (message: FromGrowing) => self.postMessage(message);
const failed = (error: unknown) => send({ failed: error instanceof Error ? error.message : String(error) });

async function grow(message: Extract<ToGrowing, { tree: unknown }>): Promise<void> {
  pictures = message.pictures ?? pictures;
  if (!view || !pictures) return;
  const begun = performance.now();
  await view.grow({ tree: message.tree, pictures });
  send({ took: performance.now() - begun, programs: view.programs() });
}

function hear(message: ToGrowing): void {
  if ("canvas" in message) view = new GrowingView(message.canvas);
  else if ("tree" in message) last = last.then(() => grow(message)).catch(failed);
  else if ("dark" in message) view?.setTheme(message.dark);
  else if ("orbit" in message) view?.orbit(...message.orbit);
  else view?.resize(message.width, message.height, message.ratio);
}

self.onmessage = ({ data }: MessageEvent<ToGrowing>) => {
  try {
    hear(data);
  } catch (error) {
    failed(error);
  }
};
