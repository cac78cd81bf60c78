// What survives a reload. localStorage may be full or forbidden: then the page works without it.

const PREFIX = "pleach-studio.";

/** Undefined where nothing is stored, or no JSON. The caller checks the shape: an older page may have written it. */
export function load(key: string): unknown {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + key) ?? "");
  } catch {
    return undefined;
  }
}

/** False if it could not be kept. */
export function save(key: string, value: unknown): boolean {
  try {
    if (value === null) localStorage.removeItem(PREFIX + key);
    else localStorage.setItem(PREFIX + key, JSON.stringify(value));
    return true;
  } catch {
    return false;
  }
}

/** What is stored under keys that begin so. */
export function keysFrom(start: string): string[] {
  try {
    const all = Object.keys(localStorage).filter((key) => key.startsWith(PREFIX + start));
    return all.map((key) => key.slice(PREFIX.length));
  } catch {
    return [];
  }
}

/** Calls `changed` when another tab has stored something under this key. */
export function onStored(key: string, changed: () => void): void {
  window.addEventListener("storage", (event) => {
    // Without a key, all was cleared.
    if (event.key === PREFIX + key || event.key === null) changed();
  });
}

/** The same call, at most once per `wait` milliseconds, the last one always. */
export function debounce(wait: number, run: () => void): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(run, wait);
  };
}
