// What a build says: a line when a step begins, and one when it has ended.

/** Begins a step; the function that comes back ends it, with what there is to say then. */
export function step(what) {
  console.log(`· ${what}`);
  const begun = performance.now();
  return (result) => console.log(`  ${result}, ${((performance.now() - begun) / 1000).toFixed(1)} s`);
}

export const megabytes = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
