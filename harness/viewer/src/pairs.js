// Pairs of shapes: choose two kinds from a matrix and see what each engine's narrow phase makes of them.
import { element } from './dom.js';
export class PairPanel {
  constructor(viewer) { this.viewer = viewer; this.element = element('div', { class: 'pv-pairs', hidden: true }); }
  show(replays) { this.element.hidden = !replays; }
  select() {}
  update() {}
}
