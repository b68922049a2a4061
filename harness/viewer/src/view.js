// One engine's place in the viewer: its name and verdict, the window onto its scene, its curves.
import { Vector2 } from 'three';
import { Curves } from './curves.js';
import { element } from './basics/dom.js';
import { Labels } from './labels.js';
import { missing } from './layers/layers.js';
import { Names } from './names.js';
import { kPose } from './data/replay.js';
import { quantity } from './data/quantity.js';
import { metresOfPixel, ScaleBar } from './scale_bar.js';
import { SceneView } from './scene_view.js';

const kLabels = 24; // contact ids written beside their points, at most
const kLabelsUnasked = 14; // contacts of a scene whose ids are written although no body was picked

/** {verdict, words} of a run; older recordings tell no more than how they ended. */
export function badgeOf({ badge, status, reason }) {
  if (badge) return badge;
  return !status || status === 'ok' ? null : { verdict: status, words: reason ?? '' };
}

export class View {
  constructor(replay, frame, hue, callbacks) {
    this.replay = replay;
    this.scene = new SceneView(replay, frame);
    this.curves = new Curves(replay, callbacks.seek);
    this.notes = element('ul', { class: 'pv-notes', 'aria-live': 'polite' });
    this.card = element('dl', { class: 'pv-card', hidden: true });
    this.scale = new ScaleBar();
    const { backend, label, note } = replay.header,
      name = label || backend,
      badge = badgeOf(replay.header);
    this.port = element(
      'div',
      {
        class: 'pv-port',
        tabindex: 0,
        role: 'img',
        'aria-label': `${name}: 3D replay. Drag to turn, click a body for its numbers.`,
      },
      this.notes,
      this.card,
      this.scale.element,
    );
    this.labels = new Labels(this.port, kLabels);
    this.names = new Names(this.port, replay);
    this.element = element(
      'article',
      { class: 'pv-view', style: `--c:var(--hue${hue},#0072b2)`, 'aria-label': name },
      element(
        'header',
        {},
        element('i', { class: 'pv-engine' }),
        element('b', {}, name),
        badge &&
          element(
            'span',
            { class: `chip ${badge.verdict}`, title: badge.words || undefined },
            badge.verdict.replaceAll('_', ' '),
          ),
        badge?.words ? element('small', { title: badge.words }, badge.words) : null,
      ),
      this.port,
      this.curves.element,
      note ? element('p', { class: 'pv-note', title: note }, note) : null,
    );
    this.pressed = new Vector2();
    this.port.addEventListener('pointerdown', (event) => this.pressed.set(event.clientX, event.clientY));
    this.port.addEventListener('pointerup', (event) => {
      if (this.pressed.distanceTo(new Vector2(event.clientX, event.clientY)) < 4) callbacks.pick(this, event);
    });
  }

  get name() {
    return this.replay.header.label || this.replay.header.backend;
  }

  /** Writes into the view what of the layers that are on this replay does not have. */
  explain(kinds) {
    this.notes.replaceChildren(
      ...kinds
        .map((kind) => [kind, missing(kind, this.replay)])
        .filter(([, why]) => why)
        .map(([kind, why]) => element('li', {}, `${kind.label}: ${why}`)),
    );
  }

  select(body) {
    this.scene.selection.set(body);
    this.card.hidden = body === null;
    this.described = -1;
    if (body !== null) this.describe();
  }

  /** The picked body in numbers. */
  describe() {
    const { replay } = this,
      { body } = this.scene.selection;
    if (body === null || replay.frame === this.described) return;
    this.described = replay.frame;
    const { name, motion } = replay.bodies[body],
      p = body * kPose,
      facts = [];
    facts.push([
      'position',
      `${[0, 1, 2].map((i) => replay.poses[p + i].toFixed(2).replace('-', '\u2212')).join(' ')} m`,
    ]);
    if (motion !== 'static') facts.push(['speed', quantity(replay.speed(body), 'm/s')]);
    const overlap = replay.value('penetration', body),
      island = replay.value('islands', body);
    if (overlap !== undefined) facts.push(['overlap', quantity(overlap, 'm')]);
    const touching = this.contactsOf(body);
    if (touching)
      facts.push([
        'contacts',
        touching.force === null ? `${touching.count}` : `${touching.count}, ${quantity(touching.force, 'N')}`,
      ]);
    if (island !== undefined) facts.push(['island', island < 0 ? 'none' : `${island}`]);
    if (replay.has('asleep')) facts.push(['asleep', replay.value('asleep', body) ? 'yes' : 'no']);
    this.card.replaceChildren(
      element('dt', { class: 'pv-card-name' }, name || `body ${body}`),
      element('dd', {}, motion),
      ...facts.flatMap(([title, text]) => [element('dt', {}, title), element('dd', {}, text)]),
    );
  }

  /** {count, force: sum along the normals or null} of a body, or null where contacts were not recorded. */
  contactsOf(body) {
    const { replay } = this,
      { sections } = replay,
      a = sections['contacts/body_a'],
      b = sections['contacts/body_b'],
      forces = sections['contacts/force'];
    if (!a) return null;
    let count = 0,
      force = forces ? 0 : null;
    for (let row = replay.first('contacts'), end = replay.first('contacts', 1); row < end; ++row) {
      if (a[row] !== body && b[row] !== body) continue;
      ++count;
      if (forces) force += forces[row];
    }
    return { count, force: Number.isFinite(force) ? force : null };
  }

  /** Ids beside the contacts of the picked body, or of all where they are few. */
  placeIds(camera, on) {
    const { replay, labels } = this,
      { sections } = replay,
      ids = sections['contacts/id'],
      points = sections['contacts/point'],
      { body } = this.scene.selection;
    labels.begin(camera);
    if (on && ids && points) {
      const first = replay.first('contacts'),
        end = replay.first('contacts', 1);
      for (let row = first; row < end && !labels.isFull; ++row) {
        const known = ids[row] !== 0; // as the engines say
        const ofBody = sections['contacts/body_a'][row] === body || sections['contacts/body_b'][row] === body;
        if (!known || (body === null ? end - first > kLabelsUnasked : !ofBody)) continue;
        labels.add(ids[row].toString(16), points[row * 3], points[row * 3 + 1], points[row * 3 + 2]);
      }
    }
    labels.end();
  }

  /** What depends on where the camera stands: the smallest dots, the scale, and words beside places. */
  annotate(camera, distance, { ids, names }) {
    const { height } = this.box ?? { height: 1 };
    this.scene.materials.keepVisible(metresOfPixel(camera, 1, height));
    this.scale.update(camera, distance, height, this.scene.grid?.step ?? null);
    this.placeIds(camera, ids);
    this.names.place(camera, names);
  }

  dispose() {
    this.scene.dispose();
  }
}
