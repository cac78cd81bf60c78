// The clipboard, which a browser may refuse.
import { say } from "../state/notes";

/** Copies `text` and says `done`. Where that is not allowed, `otherwise` says what to do, or shows the text. */
export async function copyText(text: string, done: string, otherwise?: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    say(done);
  } catch {
    say(otherwise ?? `The browser does not allow copying. This is the link: ${text}`);
  }
}
