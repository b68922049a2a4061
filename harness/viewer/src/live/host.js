// The host of a scene at work, as simulation/host.hpp: before each step it moves, pushes, sets motors and cuts as the
// scene says.
import { expression } from './expressions.js';

const kFields = { motors: 'motor', targets: 'springRest' };
const kEarly = 1e-6; // of a step: so much before its time counts as on time

/** First b, then a. */
const product = ([ax, ay, az, aw], [bx, by, bz, bw]) => [
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by + ay * bw + az * bx - ax * bz,
  aw * bz + az * bw + ax * by - ay * bx,
  aw * bw - ax * bx - ay * by - az * bz,
];

export class Host {
  /** form: the world as the harness wrote it (replay/live_world.hpp). */
  constructor(form) {
    this.form = form;
    this.actors = form.host.map((action) => ({
      ...action,
      numbers: action.numbers.map((number) =>
        typeof number === 'string' ? expression(number, action.names) : () => number,
      ),
    }));
    this.reset();
  }

  reset() {
    this.cuts = [...this.form.cuts].sort(([, a], [, b]) => b - a);
    this.gone = new Set();
  }

  /** run: its world, bodies, joints, time and dt. */
  beforeStep(run) {
    const { world, joints, time, dt } = run;
    while (this.cuts.length && this.cuts.at(-1)[1] <= time + dt * kEarly) {
      const [joint] = this.cuts.pop();
      world.destroyJoint(joints[joint]);
      this.gone.add(joint);
    }
    for (const actor of this.actors) this.act(actor, run);
  }

  act({ kind, target, axis, begin, end, numbers }, { world, bodies, joints, time, dt }) {
    const at = (t) => numbers.map((number) => number(t)),
      middle = time + dt / 2;
    if (kind === 'path') {
      const to = at(time + dt),
        half = to[3] / 2,
        turn = [...axis.map((part) => part * Math.sin(half)), Math.cos(half)];
      const q = product(turn, this.form.bodies[target].orientation);
      world.write('kinematicTarget', bodies[target], [...to.slice(0, 3), ...q]);
    } else if (kind === 'impulse') {
      if (begin < time - dt * kEarly || begin >= time + dt * (1 - kEarly)) return;
      this.push(world, 'impulse', 'angularImpulse', bodies[target], at(begin));
    } else {
      if (middle < begin || middle > end) return;
      const row = at(middle);
      if (kind === 'force') this.push(world, 'force', 'torque', bodies[target], row);
      else if (!this.gone.has(target)) world.writeJoints(kFields[kind], joints[target], row);
    }
  }

  push(world, straight, turning, body, row) {
    for (const [field, part] of [
      [straight, row.slice(0, 3)],
      [turning, row.slice(3)],
    ])
      if (part.some((number) => number !== 0)) world.write(field, body, part);
  }
}
