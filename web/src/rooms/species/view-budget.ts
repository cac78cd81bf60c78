// How many vertices the view gets: as many as this machine draws in a moment. Without a graphics card that is far fewer, and
// what is drawn too slowly holds up the page.

/** Telephones have less memory. */
const MOST = matchMedia("(max-width: 820px)").matches ? 700_000 : 2_500_000;
const LEAST = 100_000;
/** Until something was drawn. */
const FIRST = 150_000;
/** Milliseconds that a tree may take to be drawn. */
const MOMENT = 250;
/** Fewer vertices say little: most of the time goes into other things. */
const MANY = 50_000;
/** Milliseconds that a graphics card needs at most for a tree of fewer. */
const QUICK = 60;
/** Milliseconds after which a tree that is not drawn yet is not waited for. */
const LATE = 2500;

let budget = FIRST;
let settle = () => {};
let isOpen = false;

export const vertexBudget = () => budget;

/** Without a view there is nothing to wait for. */
export function viewIsOpen(open: boolean): void {
  isOpen = open;
  if (!open) settle();
}

/** A tree was drawn. */
export function tookToDraw(vertices: number, milliseconds: number): void {
  const could = (vertices * MOMENT) / Math.max(1, milliseconds);
  if (vertices >= MANY) budget = Math.round(Math.min(MOST, Math.max(LEAST, could)));
  else if (milliseconds < QUICK) budget = MOST;
  settle();
}

/** Ends once the view has drawn what it was given. */
export function treeIsDrawn(): Promise<void> {
  if (!isOpen) return Promise.resolve();
  return new Promise((done) => {
    const timer = setTimeout(done, LATE);
    settle = () => {
      clearTimeout(timer);
      done();
    };
  });
}
