// The report's page: opens what is packed when it comes into sight, keeps filter, folds and place in the address, and
// leads from every figure to its run.
import { element } from '../../../viewer/src/basics/dom.js';
import { changeAddress, readAddress } from './address.js';
import { blockElement } from './blocks.js';
import { Filter } from './filter.js';
import { readFolds, unfoldLists, watchFolds } from './folds.js';
import { landOn } from './land.js';
import { enginesOfPage } from './looks.js';
import { Runs } from './runs.js';
import { onceInSight } from './sight.js';
import { unpack } from './unpack.js';

const root = document.documentElement;
const replays = document.getElementById('replays');
const all = (selector, where = document) => [...where.querySelectorAll(selector)];

/** What the parts of one machine's half of the page share. */
class MachinePage {
  constructor(place, filter, engines) {
    Object.assign(this, { place, filter, engines });
    this.onResize = [];
    this.table = new Promise((resolve) => {
      this.showsRuns = resolve;
    });
    const runs = place.querySelector('section[id^=runs] script.packed');
    // The data of all runs: what hovers say, wherever one begins to read.
    this.opened = unpack(runs).then(([{ runs: data }]) => {
      this.runs = new Runs(data, engines);
    });
    for (const script of all('script.packed', place)) this.drawInSight(script);
  }

  drawInSight(script) {
    const section = script.closest('section'),
      place = element('div', { class: 'drawn pending' });
    script.after(place);
    const draw = async () => {
      try {
        const [blocks] = await Promise.all([unpack(script), this.opened]);
        place.replaceChildren(...blocks.map((block) => blockElement(block, this)));
      } catch (error) {
        place.replaceChildren(element('p', { class: 'about', role: 'alert' }, `This cannot be drawn: ${error.message}`));
      }
      place.classList.remove('pending');
      section.dataset.drawn = '';
    };
    onceInSight(place, draw);
  }

  resized(callback) {
    this.onResize.push(callback);
  }

  follow(place) {
    go(place);
  }

  /** Opens a run in the table of all; false where it is another machine's. */
  async reveal(index) {
    await this.opened;
    if (!this.runs.has(index)) return false;
    choose(this);
    const section = this.place.querySelector('section[id^=runs]');
    section.querySelector('details.fold').open = true;
    section.scrollIntoView();
    const table = await this.table,
      row = table.data.rows.find((other) => other.index === index);
    if (!this.filter.passes(row)) this.filter.set({});
    table.unfold(row);
    await landOn(
      () => table.lineIn(row),
      () => {
        table.element.scrollIntoView({ block: 'start' });
        table.bring(row);
      },
    );
    return true;
  }
}

const filter = new Filter(),
  engines = enginesOfPage();
const machines = all('.machine').map((place) => new MachinePage(place, filter, engines));

// ---- machines: one at a time ----
const picker = document.getElementById('machine');

// The one live replay stands small on the first screen, until one wants all that the viewer has.
if (replays) {
  const grow = element('button', { type: 'button', class: 'grow', 'aria-expanded': 'false' }, 'All scenes, layers and curves');
  grow.addEventListener('click', () => {
    const on = replays.classList.toggle('large');
    grow.setAttribute('aria-expanded', `${on}`);
    grow.textContent = on ? 'Smaller' : 'All scenes, layers and curves';
    if (on) replays.scrollIntoView();
  });
  // What runs in the page takes room.
  replays.addEventListener('click', ({ target }) => {
    if (target.closest('.pv-run') && !replays.classList.contains('large')) grow.click();
  });
  replays.querySelector('h2').after(grow);
}

function choose(machine) {
  const index = machines.indexOf(machine);
  machines.forEach((other) => {
    other.place.hidden = other !== machine;
  });
  if (replays) machine.place.querySelector('.first').append(replays);
  for (const link of all('.links a')) {
    const base = link.getAttribute('href').replace(/-\d+$/, ''),
      at = index && document.querySelector(`${base}-${index}`) ? `${base}-${index}` : base,
      section = document.querySelector(at);
    link.hidden = !section || Boolean(section.closest('.machine')?.hidden);
    if (!link.hidden) link.href = at;
  }
  if (!picker) return;
  picker.value = String(index);
  changeAddress({ machine: index ? String(index) : '' });
}
picker?.addEventListener('change', () => choose(machines[Number(picker.value)]));

// ---- places ----
async function go(place, { push = true } = {}) {
  if (push) changeAddress({ place });
  const run = /^r(\d+)$/.exec(place);
  if (run) {
    for (const machine of machines) if (await machine.reveal(Number(run[1]))) return;
    return;
  }
  const target = document.getElementById(place);
  if (!target) return;
  const machine = machines.find((other) => other.place.contains(target));
  if (machine) choose(machine);
  const fold = target.querySelector('details.fold');
  if (fold) fold.open = true;
  await landOn(
    () => target,
    () => target.scrollIntoView(),
  );
}

document.addEventListener('click', (event) => {
  const link = event.target.closest?.('a[href^="#"]');
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  if (link.dataset.show !== undefined) filter.set({ filter: link.dataset.show });
  go(link.getAttribute('href').slice(1));
});
function arrive() {
  const { machine, place } = readAddress();
  filter.read();
  readFolds();
  choose(machines[Number(machine)] ?? machines[0]);
  if (place) go(place, { push: false });
}
window.addEventListener('hashchange', arrive);

// ---- what a hover says of a run ----
function sayRun(event) {
  const link = event.target.closest?.('a[href^="#r"]'),
    run = link && /^#r(\d+)$/.exec(link.getAttribute('href'));
  if (!run || link.title) return;
  for (const { runs } of machines) if (runs?.has(Number(run[1]))) link.title = runs.hover(Number(run[1]));
}
document.addEventListener('pointerover', sayRun);
document.addEventListener('focusin', sayRun);

// ---- theme, width ----
document.getElementById('theme').addEventListener('click', () => {
  const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  root.dataset.theme = dark ? 'light' : 'dark';
  try {
    localStorage.setItem('plumb-theme', root.dataset.theme);
  } catch {
    // A page in a sandbox keeps nothing.
  }
});
let width = innerWidth,
  pending = 0;
window.addEventListener('resize', () => {
  if (innerWidth === width) return;
  width = innerWidth;
  clearTimeout(pending);
  pending = setTimeout(() => machines.forEach((machine) => machine.onResize.forEach((callback) => callback())), 150);
});

document.querySelector('.controls').hidden = false;
arrive();
watchFolds();
unfoldLists();
Promise.all(machines.map((machine) => machine.opened)).then(() => {
  root.dataset.ready = '';
});
