// Pairs of shapes: choose two kinds from a matrix and see what each engine's narrow phase makes of them.
import { element } from './basics/dom.js';

const kName = /^pair (.+)-(.+)$/;

/** The two kinds that a scene of the page is about, or null for a scene of the other sort. */
export function pairOf(scene) {
  const parts = kName.exec(scene);
  return parts && [parts[1], parts[2]];
}

/** Kinds by how many others they come first with, fewest first, so that the matrix is a triangle. */
export function kindsOf(pairs) {
  const kinds = [...new Set(pairs.flat())],
    lead = (kind) => new Set(pairs.filter(([a, b]) => a === kind && b !== kind).map(([, b]) => b)).size;
  return kinds.sort((a, b) => lead(a) - lead(b));
}

export class PairPanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.scenes = new Map(); // "a b" and "b a": the scene's name
    const { library } = viewer,
      pairs = [];
    for (const scene of library.names) {
      const pair = pairOf(scene);
      if (!pair) continue;
      pairs.push(pair);
      this.scenes.set(pair.join(' '), scene).set([...pair].reverse().join(' '), scene);
    }
    this.kinds = kindsOf(pairs);
    this.element = element(
      'div',
      { class: 'pv-pairs', hidden: true, role: 'group', 'aria-label': 'pairs of shapes' },
      this.table(),
    );
  }

  /** The scene that stands for all pairs in the list of scenes, or undefined. */
  get first() {
    return this.scenes.values().next().value;
  }

  table() {
    const words = (kind) => kind.replaceAll('_', ' ');
    const at = (i, j) => (j <= i ? this.scenes.get(`${this.kinds[i]} ${this.kinds[j]}`) : undefined);
    const places = [...this.kinds.keys()];
    const columns = places.filter((j) => places.some((i) => at(i, j))),
      rows = places.filter((i) => places.some((j) => at(i, j)));
    const head = columns.map((j) => element('th', { scope: 'col' }, words(this.kinds[j])));
    const line = (i) =>
      columns.map((j) =>
        element(
          'td',
          {},
          at(i, j) ? this.button(at(i, j), `${words(this.kinds[i])} and ${words(this.kinds[j])}`) : null,
        ),
      );
    return element(
      'table',
      {},
      element('thead', {}, element('tr', {}, element('td'), ...head)),
      element(
        'tbody',
        {},
        ...rows.map((i) => element('tr', {}, element('th', { scope: 'row' }, words(this.kinds[i])), ...line(i))),
      ),
    );
  }

  /** A dot for each engine that answers for the pair. */
  button(scene, name) {
    const { library } = this.viewer,
      backends = library.backendsOf(scene);
    return element(
      'button',
      {
        type: 'button',
        'data-pair': scene,
        'aria-pressed': 'false',
        'aria-label': `${name}: ${backends.join(', ')}`,
        title: `${name}: ${backends.join(', ')}`,
        onclick: () => this.viewer.select(scene),
      },
      ...backends.map((backend) => element('i', { style: `--c:var(--hue${library.hue(backend)},#0072b2)` })),
    );
  }

  show(scene) {
    this.element.hidden = !pairOf(scene);
    this.viewer.place.classList.toggle('pv-of-pairs', !this.element.hidden);
    for (const button of this.element.querySelectorAll('button'))
      button.setAttribute('aria-pressed', `${button.dataset.pair === scene}`);
  }

  /** Shows a pair by its two kinds, in either order. */
  select(a, b) {
    const scene = this.scenes.get(`${a} ${b}`);
    if (!scene) throw new Error(`there is no pair of ${a} and ${b}; kinds are: ${this.kinds.join(', ')}`);
    return this.viewer.select(scene);
  }
}
