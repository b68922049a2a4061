// What the page, tests and the command line's stills may ask of the viewer: window.plumbViewer.
import { kLayers } from './layers/layers.js';
import { badgeOf } from './view.js';

export function apiOf(viewer) {
  return {
    /** A promise; asking for it begins what else begins when the reader comes near. */
    get ready() {
      return viewer.start();
    },
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
    /** Picks a body by name or number, and the camera goes with it. */
    follow: (name) => viewer.follow.find(`${name}`),
    letGo: () => viewer.letGo(),
    /** Names beside the bodies nearest to the reader. */
    showNames: (on) => viewer.showNames(on),
    /** Where a body is in a view as drawn last: [x, y] in 0..1 of its port, from the left and from the top. */
    onScreen: (name, view = 0) => viewer.onScreen(name, view),
    /** Number of the frame that is shown, of the replay with the most frames. */
    frame: () => viewer.frame(),
    /** Draws now; milliseconds that it took. */
    renderOnce: () => viewer.renderOnce(),
    /** Runs the scene in the page, below. */
    runHere: () => viewer.runHere(),
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
      following: viewer.follow.on,
      picked: viewer.views.map((view) => view.scene.selection.body),
      names: viewer.names,
      badges: viewer.views.map((view) => badgeOf(view.replay.header)),
      /** Metres: of the scale's bar, and between the lines of the grid where there is no ground, else null. */
      scale: viewer.views.map((view) => ({ bar: view.scale.length, grid: view.scene.grid?.step ?? null })),
      gapRange: viewer.context.gapRange,
      quality: viewer.pace.level,
    }),
  };
}
