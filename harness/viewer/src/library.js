// The replays in the page: scenes by name, each with its engines; a bundle is opened when its scene is first shown.
import { decodeBundle } from './bundle.js';
import { Replay } from './replay.js';

export class Library {
  constructor(scripts) {
    this.scenes = new Map();
    this.backends = [];
    for (const script of scripts) {
      const { scene = 'scene', backend = 'engine' } = script.dataset;
      if (!this.scenes.has(scene)) this.scenes.set(scene, []);
      if (!this.backends.includes(backend)) this.backends.push(backend);
      this.scenes.get(scene).push({ script, backend, replay: null });
    }
  }

  get names() { return [...this.scenes.keys()]; }

  /** The page's colour of a backend. */
  hue(backend) { return Math.max(this.backends.indexOf(backend), 0) % 8; }

  /** Replays of a scene. Throws an Error that names the bundle which cannot be opened. */
  async open(scene) {
    const entries = this.scenes.get(scene);
    if (!entries) throw new Error(`there is no replay of the scene "${scene}"; there are: ${this.names.join(', ')}`);
    return Promise.all(entries.map(async (entry) => {
      try {
        entry.replay ??= new Replay(await decodeBundle(entry.script.textContent));
      } catch (error) {
        throw new Error(`the replay of ${scene} in ${entry.backend} cannot be opened: ${error.message}`);
      }
      return { backend: entry.backend, replay: entry.replay };
    }));
  }
}
