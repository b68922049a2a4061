// A table of any length, of which only the lines in sight are there (TanStack Virtual). Headers sort, by mouse and
// keyboard; where the columns do not fit beside each other, every line becomes a card.
import { elementScroll, observeElementOffset, observeElementRect, Virtualizer } from '@tanstack/virtual-core';
import { element } from '../../../viewer/src/basics/dom.js';

const kLine = 33, // px, before it is measured
  kPadding = 20; // px, of a cell

const collator = new Intl.Collator(undefined, { numeric: true });
const htmlOf = (cell) => (Array.isArray(cell) ? cell[0] : cell);
const textOf = (html) => html.replace(/<[^>]*>/g, '').trim();

/** What a cell is sorted by: its value, else its number, else its text. */
function sortKey(cell) {
  if (Array.isArray(cell) && cell[1] !== null) return { number: cell[1], text: '' };
  const text = textOf(htmlOf(cell)),
    number = text === '' ? NaN : Number(text);
  return { number, text };
}

/** Lines without a number stay below, up or down. */
function compare(a, b, up) {
  const missing = Number.isNaN(a.number) - Number.isNaN(b.number);
  if (missing) return missing;
  const order = Number.isNaN(a.number) ? collator.compare(a.text, b.text) : a.number - b.number;
  return up ? order : -order;
}

export class TableView {
  /** data: {label, style, columns, rows}; details(row): an element, where lines open. */
  constructor(data, page, details = null) {
    Object.assign(this, { data, page, details });
    this.open = new Set();
    this.drawn = new Map(); // <tbody> by row
    this.sorted = null; // {column, up}
    this.head = element('thead', { role: 'rowgroup' });
    this.columnWidths = element('colgroup');
    this.above = this.spacer();
    this.below = this.spacer();
    this.table = element('table', { role: 'table', class: data.style || null }, this.columnWidths, this.head, this.above, this.below);
    this.count = element('p', { class: 'count', 'aria-live': 'polite' });
    this.scroll = element('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': data.label }, this.table);
    this.element = element('div', { class: 'grid' }, this.scroll, this.count);
    this.virtual = new Virtualizer({
      ...this.options(0),
      observeElementRect,
      observeElementOffset,
      scrollToFn: elementScroll,
      getScrollElement: () => this.scroll,
    });
    this.virtual._didMount();
    page.filter.watch(() => this.sift());
    new ResizeObserver(() => this.fit()).observe(this.element);
    this.sift();
  }

  options(count) {
    return {
      ...this.virtual?.options,
      count,
      overscan: 6,
      estimateSize: () => (this.stacked ? kLine * this.columns.length * 0.7 : kLine),
      getItemKey: (i) => this.data.rows.indexOf(this.rows[i]),
      onChange: () => this.draw(),
    };
  }

  spacer() {
    return element('tbody', { 'aria-hidden': 'true', class: 'spacer' }, element('tr', {}, element('td')));
  }

  /** Columns and lines that the filter leaves, in order. */
  sift() {
    const { filter } = this.page,
      { columns, rows } = this.data;
    this.columns = columns.map((column, at) => ({ ...column, at })).filter(({ engine }) => !filter.hidden.has(engine));
    this.rows = rows.filter((row) => filter.passes(row));
    if (this.sorted) {
      const { column, up } = this.sorted,
        keys = new Map(this.rows.map((row) => [row, sortKey(row.c[column])]));
      this.rows.sort((a, b) => compare(keys.get(a), keys.get(b), up));
    }
    this.drawHead();
    this.restart();
    const all = rows.length;
    this.count.textContent = this.rows.length < all ? `${this.rows.length} of ${all} lines` : all > 20 ? `${all} lines` : '';
    this.table.setAttribute('aria-rowcount', this.rows.length + 1);
  }

  /** Draws all lines anew. */
  restart() {
    for (const body of this.drawn.values()) body.remove();
    this.drawn.clear();
    this.keys ??= new Map(this.data.rows.map((row, i) => [row, i]));
    this.virtual.setOptions({ ...this.options(this.rows.length), getItemKey: (i) => this.keys.get(this.rows[i]) });
    this.virtual._willUpdate();
    this.virtual.measure();
    this.fit();
    this.draw();
  }

  drawHead() {
    const sorted = this.sorted;
    this.head.replaceChildren(
      element(
        'tr',
        { role: 'row', 'aria-rowindex': 1 },
        ...this.columns.map((column) => {
          const up = sorted?.column === column.at ? sorted.up : null;
          const button = element('button', { type: 'button', title: column.about || null, onclick: () => this.sort(column.at) });
          button.innerHTML = column.title;
          return element(
            'th',
            { role: 'columnheader', scope: 'col', class: column.kind, 'aria-sort': up === null ? null : up ? 'ascending' : 'descending' },
            button,
          );
        }),
      ),
    );
    const all = this.columns.reduce((sum, { width }) => sum + width, 0);
    this.columnWidths.replaceChildren(
      ...this.columns.map(({ width }) => element('col', { style: `width:${((100 * width) / all).toFixed(2)}%` })),
    );
  }

  sort(column) {
    this.sorted = { column, up: this.sorted?.column === column ? !this.sorted.up : true };
    const at = this.columns.findIndex((c) => c.at === column);
    this.sift();
    this.scroll.scrollTop = 0;
    this.head.querySelectorAll('button')[at]?.focus();
  }

  /** Columns beside each other where they fit, else cards. */
  fit() {
    const width = this.element.clientWidth;
    if (!width) return;
    const em = parseFloat(getComputedStyle(this.table).fontSize),
      wanted = this.columns.reduce((sum, column) => sum + column.width * em + kPadding, 0),
      stacked = wanted > width;
    if (stacked === this.stacked) return;
    this.stacked = stacked;
    this.element.classList.toggle('stacked', stacked);
    this.restart();
  }

  lineOf(row, index, before) {
    const cells = this.columns.map((column) => {
      const content = row.c[column.at],
        html = htmlOf(content),
        again = column.repeats && before && htmlOf(before.c[column.at]) === html;
      const cell = element('td', {
        role: 'cell',
        class: [column.kind, Array.isArray(content) ? content[2] : '', again ? 'again' : ''].filter(Boolean).join(' '),
        'data-label': textOf(column.title).replace('&times;', '\u00d7'),
      });
      cell.innerHTML = html;
      return cell;
    });
    const line = element('tr', { role: 'row', 'aria-rowindex': index + 2, class: row.e === undefined ? null : `e${row.e}` }, ...cells);
    const body = element('tbody', { role: 'rowgroup', 'data-index': index }, line);
    if (this.details) {
      if (row.id) body.id = row.id;
      const opened = this.open.has(row);
      body.classList.toggle('open', opened);
      cells[0].prepend(
        element('button', { type: 'button', class: 'opener', 'aria-expanded': `${opened}`, 'aria-label': 'details', onclick: () => this.toggle(row) }),
      );
      if (opened)
        body.append(element('tr', { role: 'row', class: 'details' }, element('td', { role: 'cell', colspan: this.columns.length }, this.details(row))));
    }
    return body;
  }

  /** The lines in sight. */
  draw() {
    const items = this.virtual.getVirtualItems(),
      wanted = new Set(items.map(({ index }) => this.rows[index]));
    for (const [row, body] of this.drawn) {
      if (wanted.has(row)) continue;
      body.remove();
      this.drawn.delete(row);
    }
    let last = this.above;
    for (const { index } of items) {
      const row = this.rows[index];
      let body = this.drawn.get(row);
      if (!body) {
        body = this.lineOf(row, index, this.rows[index - 1]);
        this.drawn.set(row, body);
      }
      if (last.nextSibling !== body) last.after(body);
      last = body;
    }
    const end = items.length ? items[items.length - 1].end : 0;
    this.above.rows[0].style.height = `${items[0]?.start ?? 0}px`;
    this.below.rows[0].style.height = `${this.virtual.getTotalSize() - end}px`;
    for (const body of this.drawn.values()) this.virtual.measureElement(body);
  }

  toggle(row, on = !this.open.has(row)) {
    if (on) this.open.add(row);
    else this.open.delete(row);
    const body = this.drawn.get(row);
    if (!body) return;
    const index = Number(body.dataset.index),
      focused = body.contains(document.activeElement);
    const fresh = this.lineOf(row, index, this.rows[index - 1]);
    body.replaceWith(fresh);
    this.drawn.set(row, fresh);
    this.virtual.measureElement(fresh);
    if (focused) fresh.querySelector('.opener').focus();
  }

  /** Opens the line, in sight or not. */
  unfold(row) {
    this.toggle(row, true);
  }

  /** The line as it is drawn; undefined out of sight. */
  lineIn(row) {
    return this.drawn.get(row);
  }

  /** Scrolls the table to the line: to where it ought to be, and once it is drawn to where it is. */
  bring(row) {
    const body = this.drawn.get(row);
    if (!body) return this.virtual.scrollToIndex(this.rows.indexOf(row), { align: 'start' });
    this.scroll.scrollTop += body.getBoundingClientRect().top - this.scroll.getBoundingClientRect().top - this.head.offsetHeight;
  }
}
