// Runs a scene of the recordings below their viewer, where the page has what it takes.
import { element } from '../basics/dom.js';
import { liveApiOf } from './live_api.js';
import { LiveLibrary } from './live_library.js';
import { LiveViewer } from './live_viewer.js';

export class Runner {
  /** place: of the viewer of recordings. */
  constructor(place) {
    this.place = place;
    this.library = new LiveLibrary();
  }

  can(scene) {
    return this.library.names.includes(scene);
  }

  /** Resolves when it is shown; then it is window.plumbLive. */
  open(scene) {
    if (this.viewer) this.viewer.select(scene).then(() => this.viewer.play());
    else {
      const place = element('div', { class: 'pv-below' });
      this.place.after(place);
      this.viewer = new LiveViewer(place, this.library, { scene });
      window.plumbLive = liveApiOf(this.viewer);
    }
    this.viewer.place.scrollIntoView({ block: 'nearest' });
    return this.viewer.start();
  }
}
