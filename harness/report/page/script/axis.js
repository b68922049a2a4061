// One axis of a diagram: the span of its values, where they are drawn, and its ticks.
import { tickLabel } from './numbers.js';

const kLabels = 6; // at most

export class Axis {
  /** Spans the values with some room; beyond `lowest` and `highest` they stand at the edge. */
  constructor({ title, log, lowest, highest }, values) {
    Object.assign(this, { title, log });
    let low = Infinity,
      high = -Infinity,
      zeros = false;
    for (const value of values) {
      if (value === null || !Number.isFinite(value)) continue;
      if (log && value <= 0) {
        zeros = true;
        continue;
      }
      const inside = Math.min(Math.max(value, lowest ?? -Infinity), highest ?? Infinity);
      low = Math.min(low, inside);
      high = Math.max(high, inside);
    }
    if (low > high) low = high = log ? 1e-3 : 0;
    let from = this.turned(low),
      to = this.turned(high);
    const least = log ? 0.8 : 1e-9 + 0.1 * Math.abs(to); // a single value still makes an axis
    if (to - from < least) [from, to] = [(from + to - least) / 2, (from + to + least) / 2];
    const room = 0.06 * (to - from);
    from -= room + (zeros ? 0.12 * (to - from) : 0); // zeros stand clear of the smallest value
    to += room;
    this.domain = log ? [10 ** from, 10 ** to] : [from, to];
  }

  turned(value) {
    return this.log ? Math.log10(value) : value;
  }

  /** Where a value is drawn: at its place, or at the edge that it lies beyond. Not finite is above. */
  place(value) {
    if (value === null || value === Infinity) return this.domain[1];
    return Math.min(Math.max(value, this.domain[0]), this.domain[1]);
  }

  /** -1 below the frame, 1 above it, else 0. */
  beyond(value) {
    if (value === null || value > this.domain[1] * (1 + 1e-9)) return 1;
    return value < this.domain[0] || (this.log && value <= 0) ? -1 : 0;
  }

  /** Values of grid lines, and of those that carry a label. */
  ticks() {
    const [low, high] = this.domain;
    if (!this.log) {
      const raw = (high - low) / kLabels,
        power = 10 ** Math.floor(Math.log10(raw)),
        step = [1, 2, 5, 10].find((s) => s * power >= raw) * power,
        all = [];
      for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-12); ++i) all.push(Number((i * step).toPrecision(12)));
      return { grid: all, labelled: all };
    }
    const powers = [],
      between = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
      for (let m = 1; m < 10; ++m) {
        const value = Number(`${m}e${e}`);
        if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) (m === 1 ? powers : between).push(value);
      }
    if (powers.length < 2) {
      const labelled = [...powers, ...between.filter((v) => /^[25]/.test(v.toExponential()))].sort((a, b) => a - b);
      return { grid: [...powers, ...between], labelled: labelled.length > 1 ? labelled : [...powers, ...between].slice(0, kLabels) };
    }
    const every = Math.ceil(powers.length / kLabels),
      first = Math.round(Math.log10(powers[0]));
    const labelled = powers.filter((_, i) => (first + i) % every === 0);
    return { grid: powers.length <= 5 ? [...powers, ...between] : powers, labelled };
  }

  get format() {
    return tickLabel;
  }
}
