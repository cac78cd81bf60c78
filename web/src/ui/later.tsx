// Parts of a room that are made one by one, after what stands before them is on the screen: made at once, a whole room
// would hold up the page.
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect } from "preact/hooks";

const due: (() => void)[] = [];

/** Each part is a task of its own, so that what a person does comes between. */
function makeNext(): void {
  due.shift()?.();
  if (due.length > 0) setTimeout(makeNext);
}

/** Calls `make` after what is on its way to the screen, and after the parts that came before. Returns how to call it off. */
function later(make: () => void): () => void {
  due.push(make);
  if (due.length === 1) requestAnimationFrame(() => setTimeout(makeNext));
  return () => {
    const at = due.indexOf(make);
    if (at >= 0) due[at] = () => {};
  };
}

export function Later({ children }: { children: ComponentChildren }): ComponentChildren {
  const isDue = useSignal(false);
  useEffect(
    () =>
      later(() => {
        isDue.value = true;
      }),
    [isDue],
  );
  return isDue.value ? children : null;
}
