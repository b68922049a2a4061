// The replays in the page: scenes by name, each with its engines; a bundle is opened when its scene is first shown.
import { decodeBundle } from './data/bundle.js';
import { Replay } from './data/replay.js';

const kNamed = 12; // scenes that an error lists
const kHues = 48; // --hue0 to --hue47 in the page's style: twelve hues in four shades

export class Library {
  constructor(scripts) {
    this.scenes = new Map();
    this.hues = new Map();
    for (const script of scripts) {
      const { scene = 'scene', backend = 'engine', hue } = script.dataset;
      if (!this.scenes.has(scene)) this.scenes.set(scene, []);
      if (!this.hues.has(backend)) this.hues.set(backend, Number(hue ?? this.hues.size) % kHues);
      this.scenes.get(scene).push({ script, backend, replay: null });
    }
  }

  /** Backends of a scene. */
  backendsOf(scene) {
    return this.scenes.get(scene).map(({ backend }) => backend);
  }

  get names() {
    return [...this.scenes.keys()];
  }

  /** Number of the page's colour of a backend: what its script says in data-hue, else by order. */
  hue(backend) {
    return this.hues.get(backend);
  }

  /** Replays of a scene, kept until another one is opened. Throws an Error that names what cannot be opened. */
  async open(scene) {
    const entries = this.scenes.get(scene);
    if (!entries)
      throw new Error(
        `there is no replay of the scene "${scene}"; there are: ${this.names.slice(0, kNamed).join(', ')}`,
      );
    for (const [other, kept] of this.scenes) {
      if (other !== scene) for (const entry of kept) entry.replay = null; // they are large
    }
    return Promise.all(
      entries.map(async (entry) => {
        try {
          entry.replay ??= new Replay(await decodeBundle(entry.script.textContent));
        } catch (error) {
          throw new Error(`the replay of ${scene} in ${entry.backend} cannot be opened: ${error.message}`);
        }
        return { backend: entry.backend, replay: entry.replay };
      }),
    );
  }
}
