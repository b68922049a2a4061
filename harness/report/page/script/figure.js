// A figure: title, diagrams, legend and what stands below; there while it is in sight.
import { element } from '../../../viewer/src/basics/dom.js';
import { looksOf } from './looks.js';
import { drawPlot, seriesKey } from './plot.js';
import { whileInSight } from './sight.js';

const kWidest = 720,
  kShown = 12; // series that a legend names unasked

/** Series by name, once each, where there is more than one. */
function legendOf(figure, page) {
  const entries = new Map();
  for (const plot of figure.plots) {
    const looks = looksOf(plot.series, page.engines);
    plot.series.forEach((one, i) => {
      if (!one.quiet && !page.filter.hidden.has(one.engine) && !entries.has(one.name)) entries.set(one.name, [one, looks[i]]);
    });
  }
  if (entries.size < 2) return null;
  const list = element('ul', { class: 'series' }, ...[...entries.values()].map(([one, look]) => element('li', {}, seriesKey(one, look), one.name)));
  return entries.size <= kShown ? list : element('details', { class: 'how' }, element('summary', {}, `legend of ${entries.size} series`), list);
}

/** The configurations that are beaten, and by whom; made when it is opened. */
function beatenList(beaten, runs) {
  const link = (run) => element('a', { href: `#r${run}` }, runs.name(run));
  const list = element('details', { class: 'how' }, element('summary', {}, `${beaten.length} beaten, and by whom`));
  list.addEventListener(
    'toggle',
    () =>
      list.append(
        element('ul', {}, ...beaten.map(([run, by, times]) => element('li', {}, link(run), `, ${times} the cost of `, link(by)))),
      ),
    { once: true },
  );
  return list;
}

export function figureElement(figure, page) {
  const place = element('figure', { class: 'pending' });
  const draw = (inner) => {
    const options = {
      engines: page.engines,
      hidden: page.filter.hidden,
      width: Math.max(240, Math.min(kWidest, inner - 26)),
      describe: (run) => page.runs.describe(run),
      follow: (run) => page.follow(`r${run}`),
    };
    place.classList.remove('pending');
    const notes = element('div', { class: 'notes' });
    notes.innerHTML = figure.notes;
    place.replaceChildren(
      ...[
        figure.title ? element('figcaption', {}, figure.title) : null,
        ...figure.plots.map((plot) => drawPlot(plot, options)),
        figure.legend ? legendOf(figure, page) : null,
        notes,
        figure.beaten ? beatenList(figure.beaten, page.runs) : null,
      ].filter(Boolean),
    );
  };
  const redraw = whileInSight(place, draw);
  const sift = () => {
    place.hidden = !page.filter.passes(figure);
    redraw();
  };
  page.filter.watch(sift);
  page.resized(redraw);
  place.hidden = !page.filter.passes(figure);
  return place;
}
