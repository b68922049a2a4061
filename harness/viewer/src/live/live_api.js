// What tests and the reader's console may ask of a run in the page: window.plumbLive.
import { apiOf } from '../api.js';

export function liveApiOf(viewer) {
  const api = apiOf(viewer);
  return Object.defineProperties(api, {
    /** The engine, the scene as it is run, and what was changed. */
    run: { get: () => viewer.run },
    step: { value: (count = 1) => viewer.stepFrames(count) },
    reset: { value: () => viewer.reset() },
    /** Of all poses and velocities: as in a row of `plumb run` after as many steps. */
    hash: { get: () => viewer.run.hash },
  });
}
