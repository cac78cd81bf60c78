// Keys that a room listens to, and where the focus goes when what had it is gone.
import type { RefObject } from "preact";
import { useEffect } from "preact/hooks";

interface Undoable {
  undo(): void;
  redo(): void;
}

/** Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y, but for text fields, which have an undo of their own. */
export function useUndoKeys(steps: Undoable): void {
  useEffect(() => {
    const listen = (event: KeyboardEvent) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const inText =
        event.target instanceof HTMLTextAreaElement ||
        (event.target instanceof HTMLInputElement && /^(search|text|number)$/.test(event.target.type));
      if (inText) return;
      const key = event.key.toLowerCase();
      if (key === "z" && !event.shiftKey) steps.undo();
      else if ((key === "z" && event.shiftKey) || key === "y") steps.redo();
      else return;
      event.preventDefault();
    };
    addEventListener("keydown", listen);
    return () => removeEventListener("keydown", listen);
  }, [steps]);
}

/** What has the focus, or lost it by being taken away or disabled; null where the user left it. */
let last: EventTarget | null = null;
addEventListener("focusin", (event) => {
  last = event.target;
});
addEventListener("focusout", (event) => {
  const left = event.target;
  // Browsers tell of an element that is just being taken away too: a moment later it is seen which it was.
  queueMicrotask(() => {
    if (last === left && document.activeElement !== left && !isLost(left)) last = null;
  });
});

/** Whether it cannot have the focus any more. */
function isLost(element: EventTarget | null): boolean {
  return element instanceof Element && (!element.isConnected || element.matches(":disabled"));
}

/** If a button that had the focus is gone or disabled since `now` changed, the first button in `place` gets it. */
export function useFocusAfter(place: RefObject<HTMLElement | null>, now: unknown): void {
  useEffect(() => {
    if (document.activeElement !== document.body || !isLost(last)) return;
    place.current?.querySelector<HTMLElement>("button:enabled")?.focus({ preventScroll: true });
  }, [now]);
}
