// One engine's run of one scene: poses at any time between frames, and the rows of a frame in the ragged lists.

/** Columns of a pose: x y z qx qy qz qw. */
export const kPose = 7;

export class Replay {
  constructor({ header, sections }) {
    this.header = header;
    this.sections = sections;
    this.times = sections.times;
    this.frames = this.times.length;
    this.bodies = header.bodies;
    this.moving = Int32Array.from(header.moving);
    this.column = new Int32Array(this.bodies.length).fill(-1);
    this.moving.forEach((body, column) => {
      this.column[body] = column;
    });
    this.quantised = sections.positions instanceof Uint16Array;
    this.lower = header.lower ?? [0, 0, 0];
    this.step = this.lower.map((low, i) => (header.upper ? (header.upper[i] - low) / 65535 : 0));
    /** Poses of all bodies at the time of the last sample(). */
    this.poses = new Float32Array(this.bodies.length * kPose);
    this.fillStarts();
    this.bodies.forEach((body, i) => this.poses.set(body.start, i * kPose));
    this.frame = 0;
    this.sample(this.times[0] ?? 0);
  }

  /** A bundle leaves out where bodies start that move: it is where the first frame has them. */
  fillStarts() {
    const { orientations } = this.sections;
    this.moving.forEach((body, column) => {
      this.bodies[body].start ??= [
        ...[0, 1, 2].map((axis) => this.coordinate(0, column, axis)),
        ...Array.from(orientations.subarray(column * 4, column * 4 + 4), (part) => part / 32767),
      ];
    });
  }

  get begin() {
    return this.frames ? this.times[0] : 0;
  }
  get end() {
    return this.frames ? this.times[this.frames - 1] : 0;
  }

  /** False for what stands still, and for a body that is not in the list. */
  moves(body) {
    return this.column[body] >= 0;
  }

  has(section) {
    return this.sections[section] !== undefined;
  }

  /** The last frame that is not after the time; times are stored in single precision. */
  frameAt(seconds) {
    const time = seconds + 1e-6;
    let low = 0,
      high = this.frames - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  coordinate(frame, column, axis) {
    const value = this.sections.positions[(frame * this.moving.length + column) * 3 + axis];
    return this.quantised ? this.lower[axis] + value * this.step[axis] : value;
  }

  /** Fills poses; between two frames positions go straight and orientations the short way round. Allocates nothing. */
  sample(time) {
    const count = this.moving.length,
      { positions, orientations } = this.sections;
    if (!this.frames) return;
    const frame = (this.frame = this.frameAt(time));
    const next = Math.min(frame + 1, this.frames - 1),
      span = this.times[next] - this.times[frame];
    const t = span > 0 ? Math.min(Math.max((time - this.times[frame]) / span, 0), 1) : 0;
    const { poses, lower, step, quantised } = this;
    for (let column = 0; column < count; ++column) {
      const out = this.moving[column] * kPose;
      const p = (frame * count + column) * 3,
        r = (next * count + column) * 3;
      for (let axis = 0; axis < 3; ++axis) {
        const value = positions[p + axis] * (1 - t) + positions[r + axis] * t;
        poses[out + axis] = quantised ? lower[axis] + value * step[axis] : value;
      }
      const a = (frame * count + column) * 4,
        b = (next * count + column) * 4;
      let dot = 0,
        norm = 0;
      for (let i = 0; i < 4; ++i) dot += orientations[a + i] * orientations[b + i];
      const to = dot < 0 ? -t : t;
      for (let i = 0; i < 4; ++i) {
        const value = orientations[a + i] * (1 - t) + orientations[b + i] * to;
        poses[out + 3 + i] = value;
        norm += value * value;
      }
      const scale = norm > 0 ? 1 / Math.sqrt(norm) : 0;
      for (let i = 3; i < kPose; ++i) poses[out + i] *= scale;
    }
  }

  /** Rows of the current frame in a ragged list are first(name) to first(name, 1), that one excluded. */
  first(list, ahead = 0) {
    const start = this.sections[`${list}/start`];
    return start ? start[this.frame + ahead] : 0;
  }

  /** A value of a moving body at the current frame, or undefined where the section or the column is missing. */
  value(section, body) {
    const values = this.sections[section],
      column = this.column[body];
    return values === undefined || !(column >= 0) ? undefined : values[this.frame * this.moving.length + column];
  }

  /** Of the current frame in the series. */
  get row() {
    return this.frame;
  }

  /** Metres a second between the frames around the current one, into out. */
  velocity(body, out) {
    const column = this.column[body];
    const a = Math.max(this.frame - 1, 0),
      b = Math.min(this.frame + 1, this.frames - 1),
      span = this.times[b] - this.times[a];
    for (let axis = 0; axis < 3; ++axis)
      out[axis] =
        column >= 0 && span > 0 ? (this.coordinate(b, column, axis) - this.coordinate(a, column, axis)) / span : 0;
    return out;
  }

  speed(body) {
    return Math.hypot(...this.velocity(body, [0, 0, 0]));
  }
}
