// Curves under a view, running along with the replay: a strip a series, a cursor at the time, its value in words.
import { element, svg } from './basics/dom.js';
import { digits, quantity } from './data/quantity.js';

export const kSeries = {
  energy: 'energy',
  energy_drift: 'energy drift',
  momentum_drift: 'momentum drift',
  max_penetration: 'deepest overlap',
  distance: 'distance',
  true_distance: 'true distance',
  depth_error: 'error of the depth',
  contacts: 'contacts',
  fastest: 'speed of the fastest',
  joint_gap: 'widest gap of a joint',
  overlap: 'deepest contact',
  step_ms: 'time of a step',
};
const kUnits = {
  energy: 'J',
  energy_drift: '1',
  momentum_drift: '1',
  max_penetration: 'm',
  contacts: '1',
  distance: 'm',
  true_distance: 'm',
  depth_error: 'm',
};
const kWidth = 400,
  kHeight = 40; // of the drawing, stretched to the strip
const kColumns = 400; // beyond so many frames a column shows the least and the most of its frames

export const seriesName = (name) => kSeries[name] ?? name.replaceAll('_', ' ');
export const seriesUnit = (replay, name) => replay.header.series?.[name]?.unit ?? kUnits[name] ?? '';

/** {low, high} of the finite values. */
export function valueRange(values) {
  let low = Infinity,
    high = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}

/** A path over the times; values that are not finite leave gaps. */
export function curvePath(times, values, span, { low, high }) {
  const parts = [],
    stride = Math.max(1, Math.ceil(values.length / kColumns)),
    height = high - low || 1;
  const x = (frame) => (((times[frame] - span.begin) / (span.end - span.begin || 1)) * kWidth).toFixed(1);
  const y = (value) => ((1 - (value - low) / height) * kHeight).toFixed(2);
  let pen = 'M';
  for (let begin = 0; begin < values.length; begin += stride) {
    const { low: least, high: most } = valueRange(values.subarray(begin, begin + stride));
    if (!Number.isFinite(values[begin]) && least === 0 && most === 0) {
      pen = 'M';
      continue;
    }
    parts.push(`${pen}${x(begin)} ${y(stride === 1 ? values[begin] : least)}`);
    if (stride > 1 && most !== least) parts.push(`L${x(begin)} ${y(most)}`);
    pen = 'L';
  }
  return parts.join('');
}

export class Curves {
  /** seek: called with the time where the reader presses a curve. */
  constructor(replay, seek) {
    this.replay = replay;
    this.element = element('div', { class: 'pv-curves' });
    this.strips = [];
    const follow = (event) => {
      const drawing = event.target.closest('.pv-plot svg');
      if (!drawing || !(event.buttons & 1)) return;
      const { left, width } = drawing.getBoundingClientRect();
      seek(this.span.begin + ((event.clientX - left) / width) * (this.span.end - this.span.begin));
    };
    for (const name of ['pointerdown', 'pointermove']) this.element.addEventListener(name, follow);
  }

  /** ranges: {name: {low, high}} where all engines share a scale, else null. */
  build(names, span, ranges) {
    this.span = span;
    this.strips = names.map((name) => this.strip(name, ranges?.[name]));
    this.element.replaceChildren(...this.strips.map((strip) => strip.element));
    this.shown = -1;
  }

  strip(name, sharedRange) {
    const values = this.replay.sections[`series/${name}`],
      title = seriesName(name),
      unit = seriesUnit(this.replay, name);
    const readout = element('output', { class: 'pv-value' });
    const caption = element('div', { class: 'pv-caption' }, element('span', {}, title), readout);
    if (!values) {
      readout.textContent = 'not recorded';
      return { element: element('div', { class: 'pv-strip missing' }, caption) };
    }
    const range = sharedRange ?? valueRange(values),
      { low, high } = range,
      cursor = svg('line', { y1: 0, y2: kHeight, class: 'pv-cursor' });
    const zero =
      low < 0 && high > 0
        ? [
            svg('line', {
              x1: 0,
              x2: kWidth,
              y1: (high / (high - low)) * kHeight,
              y2: (high / (high - low)) * kHeight,
              class: 'pv-zero',
            }),
          ]
        : [];
    const drawing = svg(
      'svg',
      {
        viewBox: `0 -2 ${kWidth} ${kHeight + 4}`,
        preserveAspectRatio: 'none',
        role: 'img',
        'aria-label': `${title} over time, ${quantity(low, unit)} to ${quantity(high, unit)}`,
      },
      ...zero,
      svg('path', { d: curvePath(this.replay.times, values, this.span, range), class: 'pv-line' }),
      cursor,
    );
    const scale = element(
      'div',
      { class: 'pv-scale', 'aria-hidden': 'true' },
      element('span', {}, quantity(high, unit)),
      element('span', {}, quantity(low, unit)),
    );
    return {
      element: element('div', { class: 'pv-strip' }, caption, element('div', { class: 'pv-plot' }, drawing, scale)),
      cursor,
      readout,
      values,
      unit,
    };
  }

  update(time) {
    if (!this.span) return;
    const x = Math.min(Math.max((time - this.span.begin) / (this.span.end - this.span.begin || 1), 0), 1) * kWidth;
    const { frame, row } = this.replay;
    for (const { cursor, readout, values, unit } of this.strips) {
      if (!values) continue;
      cursor.setAttribute('transform', `translate(${Math.min(x, kWidth - 1).toFixed(1)} 0)`);
      if (frame !== this.shown)
        readout.textContent = unit === '1' ? digits(values[row]) : quantity(values[row], unit);
    }
    this.shown = frame;
  }
}
