// Every run: what a hover says of it, its line in the table of all, and its details.
import { element } from '../../../viewer/src/basics/dom.js';
import { limit, short } from './numbers.js';

const kMetricColumns = ['metric', 'value', 'unit', 'truth', 'error', 'without known bias', 'threshold', 'gold', ''];

function plainTable(head, lines, className) {
  return element(
    'table',
    { class: className },
    head ? element('thead', {}, element('tr', {}, ...head.map((title) => element('th', { scope: 'col' }, title)))) : null,
    element('tbody', {}, ...lines),
  );
}
const line = (cells, attributes = {}) => element('tr', attributes, ...cells.map((cell) => element('td', {}, cell)));
const pane = (title, content, className) => element('div', { class: className }, element('h4', {}, title), content);
const chip = (verdict) => element('span', { class: `chip ${verdict.replaceAll(' ', '_')}` }, verdict);

function pairs(object, changed = []) {
  return plainTable(
    null,
    Object.entries(object).map(([name, value]) =>
      line([name, typeof value === 'object' ? JSON.stringify(value) : String(value)], { class: changed.includes(name) ? 'changed' : null }),
    ),
  );
}

/** The runs of one machine. */
export class Runs {
  constructor(data, engines) {
    Object.assign(this, data, { engines });
  }

  has(index) {
    return index >= this.first && index < this.first + this.rows.length;
  }
  at(index) {
    return this.rows[index - this.first];
  }
  /** "impulse 1/60 s, iterations 40" */
  name(index) {
    const run = this.at(index);
    return run ? `${this.engines[run.engine].name} ${run.configuration}` : '';
  }

  metricsOf(run) {
    return run.metrics.map(([shared, value, error, unbiased, verdict]) => {
      const [name, unit, truth, threshold, gold, note] = this.metrics[shared];
      return { name, unit, truth, threshold, gold, note, value, error, unbiased, verdict };
    });
  }

  /** One line: which run it is. */
  describe(index) {
    const run = this.at(index);
    return run ? `${run.title}, ${run.configuration}` : '';
  }

  /** All that a hover has room for. */
  hover(index) {
    const run = this.at(index);
    if (!run) return '';
    const [median, least, most] = run.times,
      lines = [`${run.title} on ${this.engines[run.engine].name}, ${run.verdict}`, run.configuration];
    if (median !== null) lines.push(`${short(median)} ms per step${least === null ? '' : ` (${short(least)} to ${short(most)})`}`);
    if (run.reason) lines.push(run.reason);
    for (const m of this.metricsOf(run)) {
      const unit = m.unit && m.unit !== '1' ? ` ${m.unit}` : '';
      lines.push(
        `${m.name}: ${m.value === null ? 'not finite' : short(m.value, 6) + unit}` +
          (m.truth === null ? '' : `, truth ${short(m.truth, 6)}`) +
          `, error ${m.error === null ? 'not finite' : short(m.error)}` +
          (m.threshold === null ? '' : `, threshold ${limit(m.threshold)}`) +
          (m.verdict ? `: ${m.verdict}` : ''),
      );
    }
    return lines.filter(Boolean).join('\n');
  }

  /** The table of all. */
  table(escape) {
    const column = (title, width, kind = 'text') => ({ title, width, kind });
    return {
      label: 'every run',
      style: 'runs',
      columns: [column('scene', 9, 'name'), column('backend', 7, 'name'), column('configuration', 12), column('result', 6), column('ms per step', 5, 'number'), column('decided by', 12)],
      rows: this.order.map((at) => {
        const run = this.rows[at],
          { name } = this.engines[run.engine],
          [median] = run.times,
          verdict = run.verdict.replaceAll(' ', '_');
        return {
          id: `r${this.first + at}`,
          index: this.first + at,
          k: `${run.k} ${name} ${run.verdict}`.toLowerCase(),
          e: run.engine,
          verdict: run.verdict,
          c: [
            escape(run.title),
            `<span class="backend e${run.engine}">${escape(name)}</span>`,
            escape(run.configuration),
            `<span class="chip ${verdict}">${run.verdict}</span>`,
            [run.contended ? `(${short(median)})` : short(median), median, ''],
            escape(run.decided),
          ],
        };
      }),
    };
  }

  details(index) {
    const run = this.at(index),
      panes = element('div', { class: 'panes' });
    panes.append(pane('Run it again', element('code', {}, run.command), 'whole'));
    if (run.contended) panes.append(pane('Contended: its times stand in no diagram', element('div', {}, run.contended), 'whole'));
    if (run.restarted)
      panes.append(pane('Begun again', element('div', {}, `${run.restarted} of its repetitions: somebody killed the worker, and it ran once more`), 'whole'));
    if (run.reason) panes.append(pane('Reason', element('div', {}, run.reason), 'whole'));
    const metrics = this.metricsOf(run);
    if (metrics.length)
      panes.append(
        pane(
          'Metrics',
          plainTable(
            kMetricColumns,
            metrics.map((m) =>
              line([m.note ? `${m.name} (${m.note})` : m.name, short(m.value, 7), m.unit, short(m.truth, 7), short(m.error), short(m.unbiased), limit(m.threshold), limit(m.gold), m.verdict ? chip(m.verdict) : '']),
            ),
            'metrics',
          ),
          'whole',
        ),
      );
    const [median, least, most, p99, setup, steps, windowFirst, windowLast] = run.times,
      [bodies, contacts, dropped, nonfinite, memory] = run.counts;
    const facts = [
      ['ms per step, median', median === null ? null : short(median)],
      ['fastest to slowest', least === null ? null : `${short(least)} to ${short(most)}`],
      ['99th percentile', p99 === null ? null : short(p99)],
      ['95 % interval', run.band ? `${short(run.band[0])} to ${short(run.band[1])}` : null],
      ['set-up, ms', setup === null ? null : short(setup)],
      ['steps', steps],
      ['timed steps', windowFirst === null ? null : `${windowFirst} to ${windowLast}`],
      ...run.phases.map(([name, ms]) => [`phase ${name}, ms`, short(ms)]),
      ['bodies', bodies],
      ['most contacts', contacts],
      ['dropped contacts', dropped],
      ['bodies not finite', nonfinite],
      ['peak memory, MB', memory === null ? null : short(memory)],
      ['state hash', run.hash],
      ['ran', run.date],
    ];
    const known = facts.filter(([, value]) => value !== null && value !== '');
    panes.append(
      pane('Times and counts', plainTable(null, known.map(([name, value]) => line([name, String(value)])))),
      pane(`Settings in force${run.changed.length ? ' (changed ones bold)' : ''}`, pairs(this.settings[run.settings], run.changed)),
      pane('Machine', pairs(this.machines[run.machine])),
    );
    return panes;
  }
}
