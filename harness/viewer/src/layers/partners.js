// Where a pair of bodies meets: their contact of this frame where there is one, else between their centres.
import { kPose } from '../data/replay.js';
import { shapeRadius } from '../basics/shapes.js';

const kWide = 4; // as many times the other's radius: the centre of such a body is nowhere near the place

export class Partners {
  constructor(replay) {
    this.replay = replay;
    this.rows = new Map();
    this.point = new Float64Array(3);
    this.frame = -1;
    const { shapes } = replay.header;
    this.radii = Float64Array.from(replay.bodies, (body) => shapeRadius(shapes[body.shape], shapes) || Infinity);
  }

  /** Whether the centre of a body says where it is, beside the other. */
  compact(body, other) {
    return this.replay.moves(body) || this.radii[body] < kWide * this.radii[other];
  }

  index() {
    const { replay, rows } = this,
      a = replay.sections['contacts/body_a'],
      b = replay.sections['contacts/body_b'];
    rows.clear();
    this.frame = replay.frame;
    if (!a || !replay.has('contacts/point')) return;
    for (let row = replay.first('contacts'), end = replay.first('contacts', 1); row < end; ++row) {
      rows.set(Math.min(a[row], b[row]) * replay.bodies.length + Math.max(a[row], b[row]), row);
    }
  }

  /** The point in this.point. */
  meet(a, b) {
    const { replay, point } = this,
      { poses } = replay;
    if (this.frame !== replay.frame) this.index();
    const row = this.rows.get(Math.min(a, b) * replay.bodies.length + Math.max(a, b));
    for (let i = 0; i < 3; ++i) {
      if (row !== undefined) point[i] = replay.sections['contacts/point'][row * 3 + i];
      else if (!this.compact(a, b)) point[i] = poses[b * kPose + i];
      else if (!this.compact(b, a)) point[i] = poses[a * kPose + i];
      else point[i] = 0.5 * (poses[a * kPose + i] + poses[b * kPose + i]);
    }
    return point;
  }
}
