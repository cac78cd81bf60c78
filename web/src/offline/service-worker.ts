// Keeps all files of one build of the page, so that it opens without a network. A page and its module are always of the
// same build: a newer build waits until no tab has the older one open, or until the only tab asks for it.

interface Build {
  version: string;
  /** Path below the page's folder, and the hash of the file as browsers check it (`sha256-…`). */
  files: readonly (readonly [path: string, integrity: string])[];
}
/** Replaced by the list of files once the page is built: see tools/offline.mjs. */
declare const __BUILD__: Build;

export type ToServiceWorker =
  /** From a page that no service worker serves yet, with the address of its script. */
  | { kind: "serve"; script: string }
  /** Is every file here? The answer is a boolean. */
  | { kind: "complete" }
  /** Take the place of the older build. False is answered if other tabs have it open. */
  | { kind: "replace" };

const worker = self as unknown as ServiceWorkerGlobalScope;
const { version, files } = __BUILD__;
const scope = new URL(worker.registration.scope);
/** Several copies of the page may be on one host: the caches of each are told apart by its path. */
const PREFIX = `pleach-studio ${scope.pathname} `;
const CACHE = PREFIX + version;

const INDEX = "index.html";
/** Some hosts redirect from `index.html` to its folder, and a page must not be a redirected answer. */
const address = (path: string) => new URL(path === INDEX ? "./" : path, scope).href;
const PAGES = [address(INDEX), new URL(INDEX, scope).href];
const known = new Map(files.map(([path, integrity]) => [address(path), integrity]));
/** Names of these files change with what is in them. */
const isHashed = (url: string) => url.startsWith(new URL("assets/", scope).href);

/** A request for exactly the file of this build: a host in the middle of an update gives an error. */
function request(url: string, integrity: string): Request {
  return new Request(url, { integrity, cache: isHashed(url) ? "default" : "no-cache" });
}

async function install(): Promise<void> {
  const cache = await caches.open(CACHE);
  await cache.addAll([...known].map(([url, integrity]) => request(url, integrity)));
}

async function removeOlder(): Promise<void> {
  for (const name of await caches.keys()) {
    if (name.startsWith(PREFIX) && name !== CACHE) await caches.delete(name);
  }
}

async function isComplete(): Promise<boolean> {
  if (!(await caches.has(CACHE))) return false;
  const cache = await caches.open(CACHE);
  const held = new Set((await cache.keys()).map((each) => each.url));
  return [...known.keys()].every((url) => held.has(url));
}

/** Null for what is not a file of the page. */
function fileOf({ url, mode }: Request): string | null {
  const { origin, pathname } = new URL(url);
  const plain = origin + pathname;
  if (mode === "navigate" && plain === new URL(INDEX, scope).href) return address(INDEX);
  return known.has(plain) ? plain : null;
}

async function answer(url: string): Promise<Response> {
  const kept = await (await caches.open(CACHE)).match(url);
  return kept ?? fetch(request(url, known.get(url) ?? ""));
}

/** Takes over pages of this very build. A page of another one keeps to the network until it is loaded again. */
async function serve(script: string): Promise<void> {
  if (known.has(script)) await worker.clients.claim();
}

async function replace(): Promise<boolean> {
  // Other copies of the page may be below this one's path.
  const isPage = (url: string) => PAGES.includes(url.replace(/[?#].*$/, ""));
  const windows = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
  const tabs = windows.filter(({ url }) => isPage(url));
  if (tabs.length > 1) return false;
  await worker.skipWaiting();
  return true;
}

worker.addEventListener("install", (event) => event.waitUntil(install()));
worker.addEventListener("activate", (event) => event.waitUntil(removeOlder()));
worker.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET") return;
  const url = fileOf(event.request);
  if (url) event.respondWith(answer(url));
});
worker.addEventListener("message", (event) => {
  const message = event.data as ToServiceWorker;
  const [port] = event.ports;
  if (message.kind === "serve") event.waitUntil(serve(message.script));
  else {
    const reply = message.kind === "complete" ? isComplete() : replace();
    event.waitUntil(reply.then((yes) => port?.postMessage(yes)));
  }
});
