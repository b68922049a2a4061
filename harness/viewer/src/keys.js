// The keyboard: every key that the viewer listens to while something in it has the focus.
import { kSpeeds } from './clock.js';
import { kLayers } from './layers.js';

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
  [`1 to ${kLayers.length}`, 'layers'],
  ['esc', 'let go of the body, leave the full view'],
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
    Escape: () => {
      if (viewer.place.classList.contains('pv-full')) viewer.present(false);
      else viewer.selectBody(null, null);
    },
  };
  kLayers.forEach((kind, i) => {
    actions[`${i + 1}`] = () => viewer.setLayer(kind.name, !viewer.on.has(kind.name));
  });
  viewer.place.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName, type } = event.target;
    if (tagName === 'SELECT' || (tagName === 'BUTTON' && (event.key === ' ' || event.key === 'Enter'))) return;
    if (tagName === 'INPUT' && type === 'checkbox' && event.key === ' ') return;
    const turn = event.shiftKey && turns[event.key],
      action = turn ? () => cameras.turn(...turn) : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
