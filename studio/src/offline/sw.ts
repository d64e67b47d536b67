// Keeps the static page for use without a network: all its files when it is installed, the kept ones when they are asked for.
// `build.sh` puts the list of files and their version in.

/** What of a service worker's world is used here. */
interface Extendable extends Event {
  waitUntil(work: Promise<unknown>): void;
}
interface Fetched extends Extendable {
  readonly request: Request;
  respondWith(answer: Promise<Response>): void;
}
interface World {
  addEventListener(kind: "install" | "activate", does: (event: Extendable) => void): void;
  addEventListener(kind: "fetch", does: (event: Fetched) => void): void;
  skipWaiting(): Promise<void>;
  clients: { claim(): Promise<void> };
}

declare const FILES: string[];
declare const VERSION: string;

const world = globalThis as unknown as World;
const cacheName = `ncc-studio-${VERSION}`;

world.addEventListener("install", (event) => {
  const kept = caches.open(cacheName).then((cache) => cache.addAll(FILES.map((file) => new Request(file, { cache: "reload" }))));
  event.waitUntil(kept.then(() => world.skipWaiting()));
});

world.addEventListener("activate", (event) => {
  const others = caches.keys().then((names) => names.filter((name) => name.startsWith("ncc-studio-") && name !== cacheName));
  event.waitUntil(others.then((names) => Promise.all(names.map((name) => caches.delete(name)))).then(() => world.clients.claim()));
});

world.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET" || new URL(event.request.url).origin !== location.origin) return;
  const kept = caches.open(cacheName).then((cache) => cache.match(event.request, { ignoreSearch: true }));
  event.respondWith(kept.then((answer) => answer ?? fetch(event.request)));
});
