// The service worker: the second start needs no network. A new build has another name and replaces the old files.
const version = 'VERSION';
const files = ['FILES'];

self.addEventListener('install', (event) =>
  event.waitUntil(
    caches
      .open(version)
      .then((store) => store.addAll(['./', ...files]))
      .then(() => self.skipWaiting()),
  ),
);
self.addEventListener('activate', (event) =>
  event.waitUntil(
    caches
      .keys()
      .then((names) => Promise.all(names.filter((name) => name !== version).map((name) => caches.delete(name))))
      .then(() => self.clients.claim()),
  ),
);
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || new URL(event.request.url).origin !== self.location.origin) return;
  event.respondWith(
    caches.match(event.request, { ignoreSearch: true }).then(async (kept) => {
      if (kept) return kept;
      const answer = await fetch(event.request);
      // samples and what few pages need join the store when they are asked for
      if (answer.ok && /\.glb$|\/(threads|draco|loaders)\//.test(new URL(event.request.url).pathname))
        (await caches.open(version)).put(event.request, answer.clone());
      return answer;
    }),
  );
});
