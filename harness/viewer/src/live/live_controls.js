// What the reader handles of a run: as of a replay, but that its time only goes on, and it can begin anew.
import { element } from '../basics/dom.js';
import { button, Controls, kCamera, keyHelp, kFull, kOn, kPlay, speeds } from '../controls.js';
import { digits } from '../data/quantity.js';
import { kKeys } from '../keys.js';

const kAnew = 'M8 3V1L4 4.2 8 7.4V5a3.8 3.8 0 11-3.8 3.8H2.4A5.6 5.6 0 108 3z';
const kFirstSeries = ['energy', 'joint_gap', 'overlap'];
const kOfReplays = new Set(['\u2190 \u2192', 'home, end', 'l']);
const kOwn = [
  ['drag a body', 'pull it along'],
  ['\u2192', 'a step on'],
  ['home', 'begin anew'],
];

const counted = (count, what) => `${count} ${what}${count === 1 ? '' : 's'}`;

export class LiveControls extends Controls {
  get firstSeries() {
    return kFirstSeries;
  }

  makeTransport() {
    const { viewer } = this;
    this.playButton = button(kPlay, 'run', () => viewer.toggle(), { class: 'pv-button pv-play' });
    this.readout = element('output', { class: 'pv-now' });
    this.counts = element('output', { class: 'pv-counts' });
    this.speed = speeds(viewer);
    return element(
      'div',
      { class: 'pv-transport', role: 'group', 'aria-label': 'running' },
      this.playButton,
      button(kOn, 'a step on', () => viewer.stepFrames(1), { class: 'pv-button pv-step' }),
      button(kAnew, 'begin anew', () => viewer.reset(), { class: 'pv-button pv-anew' }),
      this.readout,
      this.counts,
      this.speed,
      button(kCamera, 'reset the camera', () => viewer.resetCamera()),
      button(kFull, 'fill the window', () => viewer.present()),
      keyHelp([...kOwn, ...kKeys.filter(([key]) => !kOfReplays.has(key))]),
    );
  }

  /** Of layers those that the scene has; one engine shares its scale with nobody. */
  show(viewer) {
    super.show(viewer);
    for (const chip of [...this.layers.children]) if (chip.getAttribute('aria-disabled')) chip.remove();
    this.scale.parentElement.hidden = true;
  }

  setLoop() {}

  showTime(time, { late }) {
    this.readout.textContent = `${time.toFixed(2)} s`;
    const { run, milliseconds } = this.viewer;
    const moving = this.viewer.views[0].replay.moving.length,
      { awake = moving, contacts = 0, joints = run.joints.length } = run.report ?? {};
    this.counts.textContent = [
      `step ${run.steps}`,
      `${moving === 1 ? '1 body' : `${moving} bodies`}, ${awake} awake`,
      counted(contacts, 'contact'),
      joints ? counted(joints, 'joint') : '',
      run.steps ? `${digits(milliseconds)} ms a step` : '',
      late ? 'slower than the wall\u2019s time' : '',
    ]
      .filter(Boolean)
      .join(' \u00b7 ');
  }
}
