// A diagram by Observable Plot: lines, markers, bars and levels; the nearest point says what it is and leads to its run.
import * as Plot from '@observablehq/plot';
import { Axis } from './axis.js';
import { kDashes, kShapes, looksOf } from './looks.js';
import { short } from './numbers.js';

const kRadius = 4.2,
  kReach = 36; // px from the pointer to the nearest point
const kPaper = 'var(--paper)';
const kMargin = { marginLeft: 54, marginRight: 14, marginTop: 26, marginBottom: 42 },
  kAbove = 8, // px of the margin above the frame that a label may take
  kBetween = 8; // places that a line takes between two of its points

/** Points as they are drawn: px and py within the frame, beyond where they are not. */
function placed(series, x, y) {
  return series.points.map((point) => ({
    ...point,
    px: x.place(point.x),
    py: y.place(point.y),
    beyond: y.beyond(point.y),
  }));
}

function seriesMarks(one, look, points, x, y) {
  const at = { x: 'px', y: 'py', ariaDescription: one.name },
    { colour, dash } = look,
    symbol = kShapes[look.shape];
  const marks = [],
    add = (mark, some, options) => some.length && marks.push(mark(some, { ...at, ...options }));
  if (!one.loose && !(one.quiet && !one.stepped))
    add(Plot.line, points, {
      y: (p) => (p.failed ? NaN : p.py),
      stroke: colour,
      strokeWidth: 1.8,
      strokeDasharray: kDashes[dash],
      curve: one.stepped ? 'step-after' : 'linear',
    });
  if (one.fit)
    add(Plot.line, one.fit.map(([fx, fy]) => ({ px: x.place(fx), py: y.place(fy) })), {
      stroke: colour,
      strokeWidth: 1,
      strokeDasharray: '1.5 2.5',
    });
  if (one.stepped) return marks;
  if (one.quiet) {
    add(Plot.dot, points, { r: 2, symbol, fill: colour, fillOpacity: 0.55, stroke: 'none' });
    return marks;
  }
  const bar = { stroke: colour, strokeWidth: one.large ? 2 : 1.2, strokeOpacity: one.large ? 0.9 : 0.6 },
    between = (axis, band, side) => (p) => axis.place(p[band][side]);
  add(Plot.ruleY, points.filter((p) => p.xb), { x1: between(x, 'xb', 0), x2: between(x, 'xb', 1), ...bar, x: undefined });
  add(Plot.ruleX, points.filter((p) => p.yb), { y1: between(y, 'yb', 0), y2: between(y, 'yb', 1), ...bar, y: undefined });
  add(Plot.dot, points.filter((p) => p.marked), { r: 8, stroke: 'currentColor', strokeWidth: 1.2, ariaDescription: 'as it ships' });
  const runs = points.filter((p) => !p.failed),
    r = one.large ? 8 : kRadius;
  add(Plot.dot, runs.filter((p) => p.filled), { r, symbol, fill: colour, stroke: kPaper, strokeWidth: 1 });
  add(Plot.dot, runs.filter((p) => !p.filled), { r, symbol, fill: kPaper, stroke: colour, strokeWidth: 1.6 });
  const failed = points.filter((p) => p.failed);
  add(Plot.dot, failed, { r, symbol, fill: kPaper, stroke: colour, strokeWidth: 1, strokeOpacity: 0.6 });
  add(Plot.dot, failed, { r: kRadius, symbol: 'times', stroke: colour, strokeWidth: 1.8, ariaDescription: 'failed' });
  for (const side of [1, -1])
    add(Plot.dot, points.filter((p) => p.beyond === side), { r: 3, dy: -9 * side, symbol: kShapes[side > 0 ? 2 : 4], fill: colour, ariaDescription: 'beyond' });
  return marks;
}

/** From the upper left corner downwards: error falls with the first and second power of the cost. */
function slopeMarks(x, y) {
  const [x0, x1] = x.domain.map(Math.log10),
    [y0, y1] = y.domain.map(Math.log10),
    left = x0 + 0.04 * (x1 - x0),
    top = y1 - 0.04 * (y1 - y0);
  return [1, 2].flatMap((slope) => {
    const decades = 0.92 * Math.min(x1 - left, (top - y0) / slope),
      end = { x: 10 ** (left + decades), y: 10 ** (top - slope * decades) };
    return [
      Plot.line([{ x: 10 ** left, y: 10 ** top }, end], { x: 'x', y: 'y', stroke: 'var(--frame)', strokeDasharray: '1 3' }),
      Plot.text([end], { x: 'x', y: 'y', text: () => (slope === 1 ? 'slope 1' : '2'), textAnchor: 'end', dy: -4, fill: 'var(--quiet)' }),
    ];
  });
}

/** Places within the frame, from 0 to 1 across and upwards, that points and the lines between them take. */
function takenBy(drawn, x, y) {
  const share = (axis, value) => (axis.turned(value) - axis.turned(axis.domain[0])) / (axis.turned(axis.domain[1]) - axis.turned(axis.domain[0]));
  return drawn.flatMap(({ one, points }) => {
    const at = points.map((p) => [share(x, p.px), share(y, p.py)]);
    if (one.loose || one.quiet) return at;
    return at.flatMap((to, i) => {
      const from = at[Math.max(i - 1, 0)];
      return Array.from({ length: i ? kBetween : 1 }, (_, k) => to.map((end, axis) => end + ((from[axis] - end) * k) / kBetween));
    });
  });
}

/** The label of a level stands where least lies below it: at either end, above or below its line. */
function levelLabel([value, label], taken, y, width, height) {
  const level = (y.turned(value) - y.turned(y.domain[0])) / (y.turned(y.domain[1]) - y.turned(y.domain[0])),
    wide = (8 + 6.5 * label.length) / width,
    high = 16 / height;
  let best = null;
  for (const right of [false, true])
    for (const under of [false, true]) {
      if (under ? level < high : level + high > 1 + kAbove / height) continue;
      const covered = taken.filter(([px, py]) => (right ? px > 1 - wide : px < wide) && (under ? py < level && py > level - high : py > level && py < level + high)).length;
      if (!best || covered < best.covered) best = { right, under, covered };
    }
  const { right, under } = best ?? { right: false, under: true };
  return Plot.text([label], { y: [value], frameAnchor: right ? 'right' : 'left', dx: right ? -4 : 4, dy: under ? 8 : -7, text: (d) => d, fill: 'var(--quiet)', stroke: kPaper, strokeWidth: 3 });
}

function axisMarks(x, y) {
  const [tx, ty] = [x.ticks(), y.ticks()],
    grid = { stroke: 'var(--grid)', strokeOpacity: 1 },
    // As text: what is given as a format goes through the scale's own, which leaves out labels of a logarithmic one.
    label = { text: x.format, tickSize: 3, label: null, color: 'var(--quiet)', fill: 'var(--quiet)' };
  return [
    Plot.gridX(tx.grid, grid),
    Plot.gridY(ty.grid, grid),
    Plot.axisX(tx.labelled, label),
    Plot.axisY(ty.labelled, label),
    Plot.frame({ anchor: 'left', stroke: 'var(--frame)' }),
    Plot.frame({ anchor: 'bottom', stroke: 'var(--frame)' }),
  ];
}

/** What a hover says of a point. */
function said(one, point, axes, describe) {
  const lines = [one.name];
  if (point.r !== undefined) lines.push(describe(point.r));
  lines.push(`${axes[1].title} ${point.y === null ? 'not finite' : short(point.y)}`, `${short(point.x)} ${axes[0].title}`);
  if (point.marked) lines.push('as it ships');
  if (point.failed) lines.push(`failed: ${point.failed}`);
  return lines.filter(Boolean).join('\n');
}

/** Arrow keys go from point to point, Enter to the run. */
function listen(drawn, points, follow) {
  const order = points.slice().sort((a, b) => a.px - b.px || a.py - b.py);
  let at = -1;
  const go = () => drawn.value?.r !== undefined && follow(drawn.value.r);
  drawn.addEventListener('click', go);
  drawn.addEventListener('input', () => drawn.classList.toggle('leads', drawn.value?.r !== undefined));
  drawn.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') go();
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step || !order.length) return;
    event.preventDefault();
    at = (at + step + order.length) % order.length;
    const box = drawn.getBoundingClientRect(),
      scale = box.width / drawn.viewBox.baseVal.width,
      place = { clientX: box.left + scale * drawn.scale('x').apply(order[at].px), clientY: box.top + scale * drawn.scale('y').apply(order[at].py) };
    drawn.dispatchEvent(new PointerEvent('pointermove', { ...place, pointerType: 'mouse', bubbles: true }));
  });
}

/** Plot.plot(), whose rules page.css has once for all: a browser styles the whole page anew for each <style> that comes or goes. */
function bare(options) {
  const svg = Plot.plot(options);
  svg.querySelector('style').remove();
  return svg;
}

/** An <svg> as wide as asked for. describe(run): what a run is, in words; follow(run): goes there. */
export function drawPlot(plot, { engines, hidden, width, describe, follow }) {
  const looks = looksOf(plot.series, engines),
    shown = plot.series.map((one, i) => ({ one, look: looks[i] })).filter(({ one }) => !hidden.has(one.engine)),
    all = shown.flatMap(({ one }) => one.points);
  const x = new Axis(plot.x, all.flatMap((p) => [p.x, ...(p.xb ?? [])])),
    y = new Axis(plot.y, [...all.flatMap((p) => [p.y, ...(p.yb ?? [])]), ...(plot.levels ?? []).map(([value]) => value)]);
  const drawn = shown.map(({ one, look }) => ({ one, look, points: placed(one, x, y) })),
    pointed = drawn.flatMap(({ one, points }) => (one.stepped ? [] : points.map((p) => ({ ...p, said: said(one, p, [x, y], describe) }))));
  const levels = (plot.levels ?? []).filter(([value]) => !y.beyond(value)),
    taken = takenBy(drawn, x, y),
    height = Math.round(Math.min(0.74 * width, 420));
  const scale = (axis) => ({ type: axis.log ? 'log' : 'linear', domain: axis.domain });
  const svg = bare({
    width,
    height,
    ...kMargin,
    ariaLabel: plot.description,
    className: 'plot',
    style: { fontFamily: 'inherit', fontSize: '11.5px', background: 'none' },
    x: { ...scale(x), label: null },
    y: { ...scale(y), label: null },
    marks: [
      ...axisMarks(x, y),
      ...levels.map(([value]) => Plot.ruleY([value], { stroke: 'var(--frame)', strokeDasharray: '4 3' })),
      ...(plot.slopes && x.log && y.log ? slopeMarks(x, y) : []),
      ...drawn.flatMap(({ one, look, points }) => seriesMarks(one, look, points, x, y)),
      ...levels.map((level) => levelLabel(level, taken, y, width - kMargin.marginLeft - kMargin.marginRight, height - kMargin.marginTop - kMargin.marginBottom)),
      Plot.text([plot.y.title], { frameAnchor: 'top-left', dx: -46, dy: -22, text: (d) => d, textAnchor: 'start', fill: 'var(--quiet)' }),
      Plot.text([plot.x.title], { frameAnchor: 'bottom', dy: 36, text: (d) => d, fill: 'var(--quiet)' }),
      pointed.length ? Plot.tip(pointed, Plot.pointer({ x: 'px', y: 'py', title: 'said', maxRadius: kReach, fill: kPaper, stroke: 'var(--frame)', lineWidth: 24 })) : null,
    ],
  });
  svg.setAttribute('tabindex', '0');
  svg.setAttribute('role', 'img');
  listen(svg, pointed, follow);
  return svg;
}

/** The key of a series: a piece of its line with its marker. */
export function seriesKey(one, look) {
  const joined = !one.loose && !one.quiet;
  return bare({
    width: 30,
    height: 12,
    margin: 0,
    axis: null,
    className: 'key',
    x: { domain: [0, 30] },
    y: { domain: [0, 12] },
    marks: [
      joined || one.stepped ? Plot.line([[1, 6], [29, 6]], { stroke: look.colour, strokeWidth: 1.8, strokeDasharray: kDashes[look.dash] }) : null,
      one.stepped ? null : Plot.dot([[15, 6]], { r: kRadius, symbol: kShapes[look.shape], fill: look.colour }),
    ],
  });
}
