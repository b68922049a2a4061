// Finds the replays of the page and plays them in #plumb-viewer, handed out as window.plumbViewer, and in whatever other
// places a page has for one. What the page can run by itself runs in #plumb-live, handed out as window.plumbLive.
//
// A place is any element: <div data-plumb-replay="E1 L=10"></div> shows that scene (or, where it is empty or was not
// recorded, the first one) without the rows of layers, bodies and curves; with data-at="2.5" it stands at that second
// instead of playing. A script makes one by window.plumbReplays.mount(element, {scene, at, compact}), which returns what
// api.js has. Nothing is unpacked and no graphics begin before a place is near the window, or somebody asks for its
// `ready`.
import { apiOf } from './api.js';
import { Library } from './library.js';
import { liveApiOf } from './live/live_api.js';
import { LiveLibrary } from './live/live_library.js';
import { LiveViewer } from './live/live_viewer.js';
import { Runner } from './live/runner.js';
import css from './viewer.css';
import { Viewer } from './viewer.js';

let styled = false;

function addStyle() {
  if (styled) return;
  const style = document.createElement('style');
  style.textContent = css;
  document.head.append(style);
  styled = true;
}

function mount(place, options = {}) {
  addStyle();
  // Each with a library of its own: a replay knows the time that it shows.
  const viewer = new Viewer(place, new Library(document.querySelectorAll('script.plumb-replay')), options);
  return apiOf(viewer);
}

function mountLive(place) {
  addStyle();
  return liveApiOf(new LiveViewer(place, new LiveLibrary()));
}

function start() {
  if (window.plumbReplays) return;
  window.plumbReplays = { mount };
  for (const place of document.querySelectorAll('[data-plumb-replay]'))
    mount(place, { scene: place.dataset.plumbReplay, at: place.dataset.at, compact: true });
  const place = document.getElementById('plumb-viewer');
  if (place) window.plumbViewer = mount(place, { runner: new Runner(place) });
  const live = document.getElementById('plumb-live');
  if (live) window.plumbLive = mountLive(live);
}

if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', start);
else start();
