// A live run as the viewer sees replays (data/replay.js): the frame that is shown is always the last step.
import { Replay } from '../data/replay.js';
import { History } from './history.js';

const kSeries = {
  energy: { unit: 'J', doc: 'kinetic and potential, from the poses, velocities and the referee\u2019s masses' },
  energy_drift: {
    unit: '1',
    doc: 'change of the energy since the start, of the largest kinetic energy and potential range, or of the energy',
  },
  kinetic_energy: { unit: 'J', doc: 'likewise, of the motion alone' },
  fastest: { unit: 'm/s', doc: 'speed of the fastest body' },
  joint_gap: { unit: 'm', doc: 'widest gap of any joint, from the poses' },
  overlap: { unit: 'm', doc: 'deepest of the contacts of the step, as the engine tells it' },
  contacts: { unit: '1', doc: 'points, by the engine\u2019s count' },
  momentum: { unit: 'kg m/s', doc: 'of all bodies together' },
  step_ms: { unit: 'ms', doc: 'time that the engine took for a step' },
};
const kBodiesLookedAt = 400; // each step: of more, contacts and joints are looked at every so many steps, as recordings do
const kWithout = {
  joints: 'the scene has no joints',
  positions: 'a run that goes on has no whole path',
};

/** 32 bits of a feature's 64, as recordings have them. */
const folded = (feature) => Number((feature ^ (feature >> 32n)) & 0xffffffffn);

export class LiveReplay extends Replay {
  constructor(run) {
    const { header } = run.form;
    super({
      header: {
        ...header,
        backend: 'impulse',
        label: `impulse ${run.engine.info.version}, live`,
        series: kSeries,
        recorded: { without: kWithout },
        bodies: header.bodies.map((body) => ({ ...body })),
      },
      sections: { times: new Float32Array(0) },
    });
    this.run = run;
    const kinds = Object.keys(kSeries).filter(
      (name) =>
        (name !== 'joint_gap' || header.joints.length) &&
        (name !== 'energy_drift' || !header.driven) &&
        ((name !== 'overlap' && name !== 'contacts') || run.form.needs.includes('collision')),
    );
    this.history = new History(kinds);
    this.spread = Math.max(1, Math.ceil(header.bodies.length / kBodiesLookedAt));
    this.began();
  }

  /** After a reset of the run: its bodies have other handles. */
  began() {
    this.index = new Map(this.run.bodies.map((handle, body) => [handle, body]));
    this.history.clear();
    this.reference = { first: null, kinetic: 0, low: Infinity, high: -Infinity, most: 0 };
    this.took = 0;
    this.look();
  }

  stepped(milliseconds) {
    this.took = milliseconds;
    this.look();
  }

  /** Takes what the step left into the sections and one row into the history. */
  look() {
    const { run, sections } = this;
    this.poses.set(run.poses);
    this.frame = run.steps;
    if (run.steps % this.spread === 0) {
      this.lookAtContacts();
      this.gap = this.lookAtJoints();
    }
    const accounts = run.accounts(),
      energy = accounts.kinetic + accounts.potential;
    this.history.add({
      time: run.time,
      energy,
      energy_drift: this.driftOf(accounts, energy),
      kinetic_energy: accounts.kinetic,
      fastest: this.moving.reduce((most, body) => Math.max(most, this.speed(body)), 0),
      joint_gap: this.gap,
      overlap: sections.penetration ? sections.penetration.reduce((a, b) => Math.max(a, b), 0) : 0,
      contacts: run.report?.contacts ?? 0,
      momentum: Math.hypot(...accounts.momentum),
      step_ms: this.took,
    });
    this.times = this.history.of('time');
    for (const name of this.history.names) sections[`series/${name}`] = this.history.of(name);
  }

  /** As a recording's (replay/bundle.cpp), of what was seen so far. */
  driftOf({ kinetic, potential }, energy) {
    const seen = this.reference;
    seen.first ??= energy;
    seen.kinetic = Math.max(seen.kinetic, kinetic);
    seen.low = Math.min(seen.low, potential);
    seen.high = Math.max(seen.high, potential);
    seen.most = Math.max(seen.most, Math.abs(energy));
    const scale = Math.max(seen.kinetic + seen.high - seen.low, seen.most);
    return scale > 0 ? (energy - seen.first) / scale : 0;
  }

  lookAtContacts() {
    const { run, sections, index } = this;
    if (!run.form.needs.includes('collision')) return;
    const deepest = new Float32Array(this.moving.length);
    const rows = (run.steps ? run.world.contacts() : []).filter(({ a, b }) => index.has(a) && index.has(b));
    const list = {
      body_a: new Uint32Array(rows.length),
      body_b: new Uint32Array(rows.length),
      point: new Float32Array(3 * rows.length),
      normal: new Float32Array(3 * rows.length),
      force: new Float32Array(rows.length),
      id: new Uint32Array(rows.length),
    };
    rows.forEach(({ a, b, position, normal, depth, normalImpulse, feature }, row) => {
      const ends = [index.get(a), index.get(b)];
      [list.body_a[row], list.body_b[row]] = ends;
      list.point.set(position, 3 * row);
      list.normal.set(normal, 3 * row);
      list.force[row] = normalImpulse / run.dt;
      list.id[row] = folded(feature);
      for (const body of ends) {
        const column = this.column[body];
        if (column >= 0) deepest[column] = Math.max(deepest[column], depth);
      }
    });
    sections['contacts/start'] = [0, rows.length];
    for (const [name, values] of Object.entries(list)) sections[`contacts/${name}`] = values;
    sections.penetration = deepest;
    if (run.needs.includes('sleeping'))
      sections.asleep = Uint8Array.from(
        run.world.read(
          'awake',
          Array.from(this.moving, (body) => run.bodies[body]),
        ),
        (awake) => (awake ? 0 : 1),
      );
  }

  /** The widest gap. */
  lookAtJoints() {
    const { run, sections } = this;
    if (!run.form.joints.length) return 0;
    const rows = run.jointErrors();
    sections['joints/start'] = [0, rows.length];
    sections['joints/joint'] = Uint32Array.from(rows, ({ joint }) => joint);
    sections['joints/gap'] = Float32Array.from(rows, ({ gap }) => gap);
    sections['joints/angle'] = Float32Array.from(rows, ({ angle }) => angle);
    return rows.reduce((most, { gap }) => (gap > most ? gap : most), 0);
  }

  // ---- what the viewer asks of a replay ----

  /** The run itself says what is shown. */
  sample() {}

  fillStarts() {}

  get row() {
    return this.history.rows - 1;
  }

  first(list, ahead = 0) {
    return this.sections[`${list}/start`]?.[ahead] ?? 0;
  }

  value(section, body) {
    const values = this.sections[section],
      column = this.column[body];
    return values === undefined || !(column >= 0) ? undefined : values[column];
  }

  velocity(body, out) {
    const { velocities } = this.run;
    for (let i = 0; i < 3; ++i) out[i] = velocities[body * 6 + i];
    return out;
  }
}
