// The keyboard: every key that the viewer listens to while something in it has the focus.
import { kSpeeds } from './clock.js';
import { kLayers } from './layers/layers.js';

const kDigits = 10; // 1 to 9, then 0

export const kKeys = [
  ['space', 'play or pause'],
  ['\u2190 \u2192', 'a frame back or on'],
  ['shift + arrows', 'turn the camera'],
  ['+ \u2212', 'nearer, farther'],
  ['home, end', 'first, last frame'],
  ['[ ]', 'slower, faster'],
  ['l', 'loop'],
  ['r', 'reset the camera'],
  ['f', 'fill the window'],
  ['1 to 9, 0', 'layers'],
  [', .', 'pick the body before, after'],
  ['c', 'camera follows the picked body'],
  ['n', 'names of bodies'],
  ['esc', 'let go of the camera, of the body; leave the full view'],
];

export function listenToKeys(viewer) {
  const { clock, cameras } = viewer;
  const faster = (by) => {
    const at = kSpeeds.reduce(
      (best, speed, i) => (Math.abs(speed - clock.speed) < Math.abs(kSpeeds[best] - clock.speed) ? i : best),
      0,
    );
    viewer.setSpeed(kSpeeds[Math.min(Math.max(at + by, 0), kSpeeds.length - 1)]);
  };
  const turns = { ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
  const actions = {
    ' ': () => viewer.toggle(),
    k: () => viewer.toggle(),
    ArrowLeft: () => viewer.stepFrames(-1),
    ArrowRight: () => viewer.stepFrames(1),
    Home: () => viewer.seek(clock.begin),
    End: () => viewer.seek(clock.end),
    '[': () => faster(-1),
    ']': () => faster(1),
    l: () => viewer.controls.setLoop(!clock.loop),
    '+': () => cameras.turn(0, 0, 1 / 1.15),
    '=': () => cameras.turn(0, 0, 1 / 1.15),
    '-': () => cameras.turn(0, 0, 1.15),
    r: () => viewer.resetCamera(),
    f: () => viewer.present(),
    ',': () => viewer.follow.step(-1),
    '.': () => viewer.follow.step(1),
    c: () => viewer.follow.toggle(),
    n: () => viewer.showNames(!viewer.names),
    Escape: () => {
      const held = viewer.follow.on || viewer.views.some((view) => view.scene.selection.body !== null);
      if (!held && viewer.place.classList.contains('pv-full')) viewer.present(false);
      else viewer.letGo();
    },
  };
  kLayers.forEach((kind, i) => {
    if (i < kDigits) actions[`${(i + 1) % kDigits}`] = () => viewer.setLayer(kind.name, !viewer.on.has(kind.name));
  });
  viewer.place.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName, type } = event.target;
    if (tagName === 'INPUT' && (type === 'text' || type === 'number')) {
      if (event.key === 'Escape') viewer.letGo();
      return;
    }
    if (tagName === 'SELECT' || (tagName === 'BUTTON' && (event.key === ' ' || event.key === 'Enter'))) return;
    if (tagName === 'INPUT' && type === 'checkbox' && event.key === ' ') return;
    const turn = event.shiftKey && turns[event.key],
      action = turn ? () => cameras.turn(...turn) : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
