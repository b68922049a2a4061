// What the colours of the layers that are on mean, in words and units.
import { ColourMap, cssColour, forceMap, gapMap, penetrationMap } from '../basics/colour.js';
import { element } from '../basics/dom.js';
import { kApart, kOverlap } from './layer_axes.js';
import { kSpring } from './layer_joints.js';
import { quantity } from '../data/quantity.js';

const depthMap = new ColourMap([
  [0.62, 0.2, 20],
  [0.78, 0.16, 75],
  [0.82, 0.15, 140],
  [0.74, 0.12, 205],
  [0.62, 0.16, 275],
]);
const depthCache = new Map();

/** Linear colour of a depth in the tree; what hangs in no tree is grey. */
export function depthColour(depth, deepest) {
  const key = depth * 1024 + deepest;
  if (!depthCache.has(key)) {
    const rgb = [0.5, 0.5, 0.5];
    if (depth >= 0) depthMap.write(depth / Math.max(deepest, 1), rgb, 0);
    depthCache.set(key, rgb);
  }
  return depthCache.get(key);
}

function ramp(title, gradient, low, high) {
  return element(
    'div',
    { class: 'pv-legend' },
    element('span', { class: 'pv-legend-title' }, title),
    element('span', {}, low),
    element('i', {
      class: 'pv-ramp',
      style: `background:${gradient}`,
      role: 'img',
      'aria-label': `${title} from ${low} to ${high}`,
    }),
    element('span', {}, high),
  );
}

function kinds(title, entries) {
  return element(
    'div',
    { class: 'pv-legend' },
    element('span', { class: 'pv-legend-title' }, title),
    ...entries.map(([colour, text]) =>
      element('span', {}, element('i', { class: 'pv-dot', style: `background:${colour}` }), text),
    ),
  );
}

/** Legends of the layers that are on. */
export function legends(names, { penetrationRange, forceRange, gapRange, hasSprings, deepestBox }) {
  const all = {
    penetration: () =>
      ramp('deepest overlap of a body', penetrationMap.gradient(), '0', `\u2265 ${quantity(penetrationRange, 'm')}`),
    forces: () =>
      ramp('contact force along the normal', forceMap.gradient(), '0', `\u2265 ${quantity(forceRange, 'N')}`),
    joints: () => {
      const legend = ramp('gap of a joint', gapMap.gradient(), '0', `\u2265 ${quantity(gapRange, 'm')}`);
      if (hasSprings)
        legend.append(
          element('span', {}, element('i', { class: 'pv-dot', style: `background:${cssColour(kSpring)}` }), 'spring'),
        );
      return legend;
    },
    boxes: () => ramp('depth in the tree', depthMap.gradient(), 'root', `${deepestBox}`),
    axes: () =>
      kinds('axis', [
        [cssColour(kOverlap), 'of least overlap'],
        [cssColour(kApart), 'that separates'],
      ]),
    sleep: () => kinds('asleep', [['#55585c', 'dark bodies']]),
    islands: () =>
      kinds('islands', [['conic-gradient(#d66, #cb4, #5b8, #59d, #c6b, #d66)', 'one colour each; grey: in none']]),
    contacts: () => kinds('contacts', [['conic-gradient(#d66, #cb4, #5b8, #59d, #c6b, #d66)', 'a colour for each id']]),
    constraints: () =>
      kinds('constraint graph', [
        ['conic-gradient(#d66, #cb4, #5b8, #59d, #c6b, #d66)', 'solved at once'],
        ['#808080', 'one by one'],
      ]),
  };
  return names.filter((name) => all[name]).map((name) => all[name]());
}
