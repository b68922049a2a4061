// What the page, tests and the command line's stills may ask of the viewer: window.plumbViewer.
import { kLayers } from './layers.js';

export function apiOf(viewer) {
  return {
    ready: viewer.ready,
    /** Why there is nothing to see, in words, or null. */
    get failure() {
      return viewer.failure;
    },
    scenes: () => viewer.library.names,
    select: (scene) => viewer.select(scene),
    selectPair: (a, b) => viewer.pairs.select(a, b),
    play: () => viewer.play(),
    pause: () => viewer.pause(),
    /** Seconds of the scene. */
    seek: (seconds) => viewer.seek(seconds),
    /** False where no engine has what the layer shows. */
    setLayer: (name, on) => viewer.setLayer(name, on),
    /** Number of the frame that is shown, of the replay with the most frames. */
    frame: () => viewer.frame(),
    /** Draws now; milliseconds that it took. */
    renderOnce: () => viewer.renderOnce(),
    /** Fills the window with the views; bare: with nothing else. */
    present: (on, bare) => viewer.present(on, bare),
    describe: () => ({
      scene: viewer.sceneName,
      kind: viewer.kind,
      time: viewer.clock.shown,
      begin: viewer.clock.begin,
      end: viewer.clock.end,
      playing: viewer.clock.playing,
      backends: viewer.views.map((view) => view.replay.header.backend),
      bodies: viewer.views.map((view) => view.replay.bodies.length),
      layers: kLayers.map((kind) => ({
        name: kind.name,
        on: viewer.on.has(kind.name),
        available: viewer.available(kind),
      })),
      quality: viewer.pace.level,
    }),
  };
}
