// What a section is made of: words, tables, figures, every run, and groups of them that fold.
import { element } from '../../../viewer/src/basics/dom.js';
import { figureElement } from './figure.js';
import { onceInSight } from './sight.js';
import { TableView } from './table.js';

function escape(text) {
  return element('p', {}, text).innerHTML;
}

function wordsElement(html) {
  const place = element('div', { class: 'words' });
  place.innerHTML = html;
  return place;
}

/** Keys of all that a group holds, by which the filter knows whether something is left of it. */
function itemsOf(blocks) {
  return blocks.flatMap(({ table, figures }) => table?.rows ?? figures ?? []);
}

function groupElement({ group, small, open, blocks }, page) {
  const inside = element('div', { class: 'inside' }),
    place = element('details', { class: 'group', open }, element('summary', {}, group, ' ', element('small', {}, small)), inside),
    items = itemsOf(blocks);
  onceInSight(inside, () => inside.replaceChildren(...blocks.map((block) => blockElement(block, page))));
  const sift = () => {
    place.hidden = items.length > 0 && !items.some((item) => page.filter.passes(item));
  };
  page.filter.watch(sift);
  sift();
  return place;
}

function runsElement(page) {
  const table = page.runs.table(escape);
  const view = new TableView(table, page, (row) => page.runs.details(row.index));
  page.showsRuns(view);
  return view.element;
}

export function blockElement(block, page) {
  if (block.words !== undefined) return wordsElement(block.words);
  if (block.table) return new TableView(block.table, page).element;
  if (block.figures) return element('div', { class: 'figures' }, ...block.figures.map((figure) => figureElement(figure, page)));
  if (block.runs) return runsElement(page);
  return groupElement(block, page);
}
