// The page's side of the service worker: whether the page opens without a network, and newer builds of it.
import { signal } from "@preact/signals";
import { offer, say, sayError } from "../state/notes";
import type { ToServiceWorker } from "./service-worker";

/** True once this tab is served from the browser's own copy, and nothing of that is missing. */
export const worksOffline = signal(false);

/** At the root of this machine's addresses, the next program that uses the port would get this page instead. */
function isLocalRoot(): boolean {
  const { hostname, pathname } = new URL("./", document.baseURI);
  return pathname === "/" && ["localhost", "127.0.0.1", "[::1]"].includes(hostname);
}

function ask(worker: ServiceWorker, message: ToServiceWorker): Promise<boolean> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    const end = (yes: boolean) => {
      worker.removeEventListener("statechange", changed);
      resolve(yes);
    };
    // One that a newer build has replaced gives no answer.
    const changed = () => {
      if (worker.state === "redundant") end(false);
    };
    worker.addEventListener("statechange", changed);
    port1.onmessage = (event) => end(event.data === true);
    worker.postMessage(message, [port2]);
    changed();
  });
}

async function look(): Promise<void> {
  const { controller } = navigator.serviceWorker;
  worksOffline.value = controller !== null && (await ask(controller, { kind: "complete" }));
}

/** Loads the page again with the build that waits. */
async function replaceBy(waiting: ServiceWorker): Promise<void> {
  const { serviceWorker } = navigator;
  const reload = () => location.reload();
  serviceWorker.addEventListener("controllerchange", reload, { once: true });
  if (await ask(waiting, { kind: "replace" })) {
    // After a reload without the cache the page has no controller, and none comes.
    if (!serviceWorker.controller) reload();
    return;
  }
  serviceWorker.removeEventListener("controllerchange", reload);
  // The newer build that replaced it is offered too.
  if (waiting.state === "redundant") return;
  say("The page is open in other tabs too. Close them first, then load the new version.");
  offerBuild(waiting);
}

function offerBuild(waiting: ServiceWorker): void {
  const run = () => void replaceBy(waiting).catch(sayError);
  offer("There is a new version of this page.", { label: "Load it", run }, true);
}

/** Tells of each newer build once all of its files are here. */
function watch(registration: ServiceWorkerRegistration): void {
  const { waiting } = registration;
  if (waiting) offerBuild(waiting);
  const changed = ({ target }: Event) => {
    const worker = target as ServiceWorker;
    // The first build has nothing to replace.
    if (worker.state === "installed" && registration.active) offerBuild(worker);
  };
  // The event may have come already, or may still come for the same worker: a listener is not added twice.
  const follow = () => registration.installing?.addEventListener("statechange", changed);
  follow();
  registration.addEventListener("updatefound", follow);
}

async function start(): Promise<void> {
  const { serviceWorker } = navigator;
  serviceWorker.addEventListener("controllerchange", () => void look());
  const address = new URL("service-worker.js", document.baseURI);
  const registration = await serviceWorker.register(address, { updateViaCache: "none" });
  watch(registration);
  const { active } = await serviceWorker.ready;
  if (serviceWorker.controller) await look();
  else active?.postMessage({ kind: "serve", script: import.meta.url } satisfies ToServiceWorker);
}

/** Begins once the page is loaded: the copy of its files must not delay the first tree. */
export function startOffline(): void {
  if (!import.meta.env.PROD || !("serviceWorker" in navigator) || isLocalRoot()) return;
  // Without a copy the page works as ever, with a network.
  const begin = () => void start().catch(() => {});
  if (document.readyState === "complete") begin();
  else addEventListener("load", begin, { once: true });
}
