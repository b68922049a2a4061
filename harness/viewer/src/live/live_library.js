// The scenes that the page can run, and the engine that runs them: both unpacked when first asked for.
import { load } from '../../../../api/web/plumb.mjs';
import { bytesOfBase64, inflate } from '../data/bundle.js';
import { LiveReplay } from './live_replay.js';
import { LiveRun } from './run.js';

const unpacked = (script) => inflate(bytesOfBase64(script.textContent));

export class LiveLibrary {
  constructor(root = document) {
    this.engineScript = root.querySelector('script.plumb-engine');
    this.scripts = new Map(
      Array.from(root.querySelectorAll('script.plumb-world'), (script) => [script.dataset.scene, script]),
    );
  }

  get names() {
    return this.engineScript ? [...this.scripts.keys()] : [];
  }

  hue() {
    return 0;
  }

  engine() {
    this.loaded ??= unpacked(this.engineScript).then((bytes) => load(bytes));
    return this.loaded;
  }

  /** The world as the harness wrote it. */
  async form(scene) {
    const script = this.scripts.get(scene);
    if (!script) throw new Error(`this page cannot run "${scene}"; it can run ${this.names.join(', ')}`);
    return JSON.parse(new TextDecoder().decode(await unpacked(script)));
  }

  async open(scene) {
    const [engine, form] = await Promise.all([this.engine(), this.form(scene)]);
    this.run?.world.destroy();
    this.run = new LiveRun(engine, form);
    return [{ backend: 'impulse', replay: new LiveReplay(this.run) }];
  }
}
