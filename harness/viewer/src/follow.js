// The camera that goes with a body: in each view with its own engine's, all seen from the same side.
import { Vector3 } from 'three';
import { element } from './basics/dom.js';
import { Names } from './names.js';
import { kPose } from './data/replay.js';

const kMostListed = 2000; // names offered while one types; any body is found by its name or number

export class Follow {
  constructor(viewer) {
    this.viewer = viewer;
    this.on = false;
    this.offset = new Vector3();
    this.list = element('datalist', { id: `pv-bodies-${Math.random().toString(36).slice(2)}` });
    this.input = element('input', {
      class: 'pv-find',
      type: 'text',
      placeholder: 'find a body',
      'aria-label': 'find a body by its name or number',
      list: this.list.id,
      autocomplete: 'off',
      onchange: () => this.find(this.input.value.trim()),
    });
    this.button = element(
      'button',
      {
        type: 'button',
        class: 'pv-chip',
        'aria-pressed': 'false',
        title: 'the camera goes with the picked body; esc lets go (c)',
        onclick: () => this.toggle(),
      },
      'Follow',
    );
    this.element = element(
      'span',
      { class: 'pv-group', role: 'group', 'aria-label': 'bodies' },
      this.input,
      this.list,
      this.button,
    );
  }

  /** Of a scene that has just been opened. */
  show(replay) {
    this.stop();
    this.input.value = '';
    this.list.replaceChildren(
      ...Array.from(replay.moving.subarray(0, kMostListed), (body) =>
        element('option', { value: Names.of(replay, body) }),
      ),
    );
  }

  /** Of that name or number, else null. */
  bodyOf(replay, text) {
    const named = replay.bodies.findIndex((_, body) => Names.of(replay, body) === text),
      body = named >= 0 ? named : /^\d+$/.test(text) ? Number(text) : -1;
    return body >= 0 && body < replay.bodies.length ? body : null;
  }

  /** Picks the body of that name or number and goes with it. */
  find(text) {
    if (!text) return;
    const { replay } = this.viewer.views[0],
      body = this.bodyOf(replay, text);
    if (body === null) {
      this.viewer.controls.say(`there is no body "${text}" among ${replay.bodies.length}`);
      return;
    }
    this.viewer.selectBody(replay, body);
    this.start();
  }

  /** The body before or after the picked one, of those that move. */
  step(by) {
    const { viewer } = this,
      { replay, scene } = viewer.views[0],
      { length } = replay.moving;
    if (!length) return;
    const column = replay.column[scene.selection.body ?? -1] ?? -1,
      next = column < 0 ? (by > 0 ? 0 : length - 1) : (column + by + length) % length;
    viewer.selectBody(replay, replay.moving[next]);
  }

  start() {
    if (!this.viewer.views.some((view) => view.scene.selection.body !== null)) this.step(1);
    this.set(true);
  }

  /** The camera stays where it is. */
  stop() {
    if (!this.on) return;
    const view = this.viewer.shown()[0];
    if (view) this.viewer.cameras.move(this.offsetOf(view));
    this.set(false);
  }

  set(on) {
    this.on = on;
    this.button.setAttribute('aria-pressed', `${on}`);
    this.viewer.touch();
  }

  toggle() {
    if (this.on) this.stop();
    else this.start();
  }

  /** How far the view's camera stands from the shared one. */
  offsetOf({ scene, replay }) {
    const { body } = scene.selection,
      { offset } = this;
    if (!this.on || body === null) return offset.set(0, 0, 0);
    offset.fromArray(replay.poses, body * kPose).sub(this.viewer.cameras.target);
    return Number.isFinite(offset.x + offset.y + offset.z) ? offset : offset.set(0, 0, 0);
  }
}
