// The report's page in a browser without a window: it draws what is in sight, leads from figures to runs, sorts, folds,
// and leaves what the filter names; no table is cut, and no two series of a figure look alike.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { kArguments, kBrowser } from '../../harness/viewer/chromium.mjs';
import { script, tower } from './synthetic.mjs';
import { kPatience, visitor } from './visitor.mjs';

const kMostElements = 30000; // of a page of seventeen engines and six thousand rows, wherever one reads

const { PLUMB_VIEWER_FOLDER: folder, PLUMB_SOURCE: root, PLUMB_PROGRAM: program } = process.env;
if (!existsSync(kBrowser)) {
  console.log(`skipped: there is no browser at ${kBrowser}; install the package chromium or name one in PLUMB_CHROMIUM`);
  process.exit(0);
}
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');

let browser, visit, scratch, field, one, both;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-report-'));
  const [many, timed] = ['xeon-16-cores', 'h200'].map((machine) => join(root, 'harness/results', machine));
  const pageOf = (folders, name) => {
    const file = join(scratch, name);
    execFileSync(program, ['report', ...folders, '--html', file], { env: { ...process.env, PLUMB_SCENES: join(root, 'scenes') } });
    return pathToFileURL(file).href;
  };
  /** The same rows as if measured on a machine of another kind. */
  const elsewhere = (folder) => {
    const rows = execFileSync(program, ['report', folder, '--json'], { encoding: 'utf8', maxBuffer: 1 << 30 });
    const file = join(scratch, 'elsewhere.jsonl');
    writeFileSync(file, rows.replaceAll('"cpu":"', '"cpu":"Another '));
    return file;
  };
  field = pageOf([many], 'field.html'); // many engines and rows
  one = pageOf([timed], 'one.html'); // all kinds of sections
  both = pageOf([many, elsewhere(timed)], 'both.html');
  browser = await chromium.launch({ executablePath: kBrowser, args: kArguments, timeout: kPatience });
  visit = await visitor(browser, (page) => page.waitForFunction(() => 'ready' in document.documentElement.dataset));
});

after(async () => {
  await browser?.close();
  if (scratch) rmSync(scratch, { recursive: true });
});

/** Waits until all in sight is drawn. */
const settle = (page) =>
  page.waitForFunction(() => {
    const seen = (e) => e.getBoundingClientRect().top < innerHeight && e.getBoundingClientRect().bottom > 0 && e.offsetParent;
    return ![...document.querySelectorAll('.pending, .group[open] > .inside:empty')].some(seen);
  });

/** Reads from top to bottom with every group open, by what is drawn around a screen or by more, and calls look() each time. */
async function read(page, look, stride = 1900) {
  for (let top = 0; top < (await page.evaluate(() => document.documentElement.scrollHeight)); top += stride) {
    await page.evaluate((y) => scrollTo(0, y), top);
    await page.waitForTimeout(60);
    await page.evaluate(() => {
      for (const group of document.querySelectorAll('details.group')) group.open = true;
    });
    await settle(page);
    await look();
  }
}
const goTo = async (page, id) => {
  await page.evaluate((place) => {
    location.hash = place;
  }, id);
  await page.waitForFunction((place) => 'drawn' in document.getElementById(place).dataset, id);
};

/** Fails where the page has become too much for a browser, or where something does not fit. */
async function checkFit(page, width) {
  const { elements, cut, page: wide } = await page.evaluate(() => ({
    elements: document.querySelectorAll('*').length,
    cut: [...document.querySelectorAll('.scroll')].filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.getAttribute('aria-label')),
    page: document.documentElement.scrollWidth,
  }));
  assert.ok(elements < kMostElements, `${elements} elements`);
  assert.deepEqual(cut, [], `cut at ${width}`);
  assert.ok(wide <= width, `the page is ${wide} wide`);
}

/** Fails where two series of a figure look alike, as drawn; counts in seen what there was to look at. */
async function checkLooks(page, seen) {
  const figures = await page.evaluate(() =>
    [...document.querySelectorAll('figure svg.plot')].map((plot) => {
      const looks = new Map(); // by series: its first line and its first marker, as they are painted
      for (const mark of plot.querySelectorAll('g[aria-label=line], g[aria-label=dot]')) {
        const name = mark.getAttribute('aria-description'),
          kind = mark.getAttribute('aria-label');
        if (!name || !mark.firstElementChild) continue;
        const look = looks.get(name) ?? looks.set(name, {}).get(name),
          style = getComputedStyle(mark.firstElementChild),
          hue = style.stroke === 'none' || mark.getAttribute('stroke') === 'var(--paper)' ? style.fill : style.stroke;
        look[kind] ??= kind === 'line' ? `${hue} ${style.strokeDasharray}` : `${hue} ${mark.firstElementChild.getAttribute('d') ?? mark.firstElementChild.getAttribute('r')}`;
      }
      // Of one method's points that no line joins, its shape says all there is to say.
      const keys = new Map();
      for (const [name, look] of looks) keys.set(look.line ? name : name.replace(/ along .*/, ''), JSON.stringify(look));
      return { title: plot.getAttribute('aria-label'), keys: [...keys.values()] };
    }),
  );
  for (const { title, keys } of figures) {
    assert.equal(new Set(keys).size, keys.length, `${title}: ${keys.join('\n')}`);
    seen.figures += 1;
    seen.series = Math.max(seen.series, keys.length);
  }
}

test('the first screen has the answers and a picture', () =>
  visit(one, async (page) => {
    await page.waitForSelector('#speed svg.plot');
    for (const id of ['answers', 'speed']) {
      const box = await page.locator(`#${id}`).boundingBox();
      assert.ok(box.y + Math.min(box.height, 300) < 900, `${id} is at ${box.y}`);
    }
  }));

test('one live replay stands on the first screen, and grows on request', () => {
  // As the report writes it where something was recorded.
  const section = `<section id="replays" class="part replays"><h2>Replays</h2><div id="plumb-viewer"></div>${['alpha', 'beta']
    .map((engine) => script('tower H=10', engine, tower(engine)))
    .join('')}<script>${readFileSync(join(folder, 'viewer.js'), 'utf8')}</script></section>`;
  const page = readFileSync(fileURLToPath(one), 'utf8'),
    at = page.lastIndexOf('</main>'),
    file = join(scratch, 'replay.html');
  writeFileSync(file, page.slice(0, at) + section + page.slice(at));
  return visit(pathToFileURL(file).href, async (opened) => {
    const port = opened.locator('#replays .pv-port').first();
    await port.waitFor();
    const small = await port.boundingBox();
    assert.ok(small.y + small.height < 1000, `the replay ends at ${small.y + small.height}`);
    assert.ok(!(await opened.locator('.pv-top').isVisible()));
    await opened.locator('#replays .grow').click();
    await opened.locator('.pv-top').waitFor();
    assert.ok((await port.boundingBox()).width > small.width);
  });
});

test('six thousand rows, every group open: few elements wherever one reads, nothing is cut, no two series look alike', async () => {
  const seen = { figures: 0, series: 0 };
  await visit(field, (page) =>
    read(page, async () => {
      await checkFit(page, 1400);
      await checkLooks(page, seen);
    }),
  );
  assert.ok(seen.figures > 100 && seen.series >= 12, JSON.stringify(seen));
  await visit(field, (page) => read(page, () => checkFit(page, 420), 5000), { width: 420 });
});

test('an engine has the same hue whatever is beside it', async () => {
  const huesOf = async (url) => {
    let hues;
    await visit(url, async (page) => {
      hues = await page.evaluate(() =>
        Object.fromEntries([...document.querySelectorAll('.switch')].map((s) => [s.textContent, getComputedStyle(s.querySelector('.backend'), '::before').backgroundColor])),
      );
    });
    return hues;
  };
  const [few, many] = [await huesOf(one), await huesOf(both)];
  assert.ok(Object.keys(many).length > 4 * Object.keys(few).length);
  for (const [engine, hue] of Object.entries(few)) assert.equal(many[engine], hue, engine);
  assert.equal(new Set(Object.values(many)).size, Object.keys(many).length, 'and none has another one\'s');
});

test('every tick of a diagram says its value', () =>
  visit(one, async (page) => {
    for (const id of ['precision', 'scaling']) {
      await goTo(page, id);
      await page.waitForSelector(`#${id} svg.plot`);
      const plots = await page.evaluate((name) =>
        [...document.querySelectorAll(`#${name} svg.plot`)].map((plot) => ({
          title: plot.getAttribute('aria-label'),
          ticks: plot.querySelectorAll('g[aria-label$="axis tick"] path').length,
          labels: [...plot.querySelectorAll('g[aria-label$="axis tick label"] text')].filter((label) => label.textContent).length,
        })), id);
      assert.ok(plots.length > 2);
      for (const { title, ticks, labels } of plots) assert.equal(labels, ticks, title);
    }
  }));

const checkRead = (url, sections) =>
  visit(url, async (page) => {
    for (const id of sections) {
      if (await page.locator(`#${id} script.packed`).count()) await goTo(page, id);
      await settle(page);
      for (const colorScheme of ['light', 'dark']) {
        await page.emulateMedia({ colorScheme });
        const faint = await page.evaluate((name) => {
          const pen = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
          const parts = (colour) => {
            pen.clearRect(0, 0, 1, 1);
            pen.fillStyle = colour;
            pen.fillRect(0, 0, 1, 1);
            const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
            return [r, g, b, a / 255];
          };
          const over = (top, below) => below.map((c, i) => top[i] * top[3] + c * (1 - top[3]));
          const light = (colour) => colour.reduce((sum, c, i) => sum + [0.2126, 0.7152, 0.0722][i] * (c <= 10 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4), 0);
          const found = new Set();
          for (const e of document.getElementById(name).querySelectorAll('*')) {
            if (e instanceof SVGElement || !e.offsetParent || ![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())) continue;
            const lineage = [];
            for (let at = e; at; at = at.parentElement) lineage.push(getComputedStyle(at));
            const ground = lineage.map((style) => parts(style.backgroundColor)).reduceRight((below, top) => over(top, below), [255, 255, 255]),
              ink = parts(lineage[0].color);
            ink[3] *= lineage.reduce((all, style) => all * Number(style.opacity), 1);
            const [a, b] = [light(over(ink, ground)), light(ground)],
              contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
            if (contrast < 4.5) found.add(`${contrast.toFixed(1)}: ${e.tagName} ${e.className} "${e.textContent.trim().slice(0, 20)}"`);
          }
          return [...found];
        }, id);
        assert.deepEqual(faint, [], `${id}, ${colorScheme}`);
      }
    }
  });

test('text can be read, in light and dark', async () => {
  await checkRead(one, ['answers', 'engines', 'cost', 'seeds', 'times', 'needs', 'runs']);
  await checkRead(field, ['answers', 'engines', 'matrix', 'runs']);
});

test('a long list is drawn when it is opened', () =>
  visit(field, async (page) => {
    const list = page.locator('#engines details.how', { has: page.locator(':scope > template') }).first();
    await list.evaluate((e) => e.querySelector('summary').click());
    await page.waitForFunction(() => document.querySelector('#engines details.how[open] > ul'));
    const { said, items } = await page.evaluate(() => {
      const open = document.querySelector('#engines details.how[open]');
      return { said: Number(open.querySelector('summary').textContent.match(/\d+/)[0]), items: open.querySelectorAll(':scope > ul > li').length };
    });
    assert.ok(said > 12);
    assert.equal(items, said);
  }));

test('every section folds, by keyboard', () =>
  visit(one, async (page) => {
    for (const fold of await page.locator('main section > details.fold').all()) {
      const summary = fold.locator(':scope > summary');
      await summary.focus();
      await page.keyboard.press('Enter');
      assert.equal(await fold.getAttribute('open'), null, await summary.textContent());
      await page.keyboard.press('Enter');
      assert.notEqual(await fold.getAttribute('open'), null);
    }
  }));

test('headers sort by keyboard, and say so', () =>
  visit(one, async (page) => {
    await goTo(page, 'runs');
    const header = page.locator('#runs thead th', { hasText: 'ms per step' }),
      times = async () => (await page.locator('#runs tbody[data-index] td[data-label="ms per step"]').allInnerTexts()).map((text) => Number(text.replace(/[()]/g, '')));
    await header.locator('button').focus();
    await page.keyboard.press('Enter');
    assert.equal(await page.locator('#runs th[aria-sort]').getAttribute('aria-sort'), 'ascending');
    assert.equal(await page.evaluate(() => document.activeElement.textContent), 'ms per step', 'the focus stays');
    const rising = await times();
    assert.deepEqual(rising, rising.slice().sort((a, b) => a - b));
    await page.keyboard.press('Enter');
    assert.equal(await page.locator('#runs th[aria-sort]').getAttribute('aria-sort'), 'descending');
    const falling = await times();
    assert.deepEqual(falling, falling.slice().sort((a, b) => b - a));
    assert.ok(falling[0] > rising[0]);
  }));

test('an address leads to a run, with the command that repeats it', () =>
  visit(`${one}#r3`, async (page) => {
    const details = page.locator('#r3 .details');
    await details.waitFor();
    assert.match(await details.innerText(), /plumb run \w+ --backend /);
    await page.locator('#r3 .opener').click();
    assert.equal(await details.count(), 0);
  }));

/**
 * Where a run's line is: how far below the head of its table, how far that table could still be moved up towards the top
 * of the screen, and whether one sees the line.
 */
const lineOf = (page, id) =>
  page.evaluate((name) => {
    const line = document.querySelector(`tbody#${name} > tr`),
      table = line.closest('.scroll'),
      box = line.getBoundingClientRect(),
      head = table.querySelector('thead').offsetHeight,
      seen = document.elementFromPoint(box.left + box.width / 2, box.top + 4);
    const { top } = table.getBoundingClientRect(),
      rest = document.documentElement.scrollHeight - innerHeight - scrollY;
    return { below: box.top - top - head, short: Math.min(top - 100, rest), seen: line.contains(seen) };
  }, id);

/** Where the line of a run comes to rest: at the head of its table, or elsewhere when drawing had all the time it needs. */
const restOf = async (page, run) => {
  let line;
  for (let before = null, looks = 0; looks < 40; ++looks) {
    await page.waitForTimeout(500);
    line = await lineOf(page, run);
    const arrived = Math.abs(line.below) < 3 && line.seen;
    if (looks >= 2 && arrived && before === line.below) break;
    before = line.below;
  }
  return line;
};

test('an address leads to exactly its run, however much is drawn on the way, and to the next one', async () => {
  for (const width of [1400, 420])
    await visit(
      field,
      async (page) => {
        // As in browsers that do not keep in place what one looks at.
        await page.evaluate(() => document.documentElement.style.setProperty('overflow-anchor', 'none'));
        for (const run of ['r4321', 'r17', 'r2500', 'r2510']) {
          await page.evaluate((place) => {
            location.hash = place;
          }, run);
          await page.locator(`tbody#${run}.open`).waitFor();
          const { below, short, seen } = await restOf(page, run);
          assert.ok(short < 3, `the table of ${run} is ${short} px too low at ${width}`);
          assert.ok(Math.abs(below) < 3 && seen, `${run} is ${below} px below the head of its table at ${width}${seen ? '' : ', out of sight'}`);
        }
      },
      { width },
    );
});

test('a link leads to its run through sections that are folded, and none unfolds by itself', () =>
  visit(`${one}#cost`, async (page) => {
    const isOpen = (id) => page.evaluate((name) => document.querySelector(`#${name} > details.fold`).open, id);
    await goTo(page, 'runs');
    for (const id of ['runs', 'fronts']) {
      await page.locator(`#${id} > details.fold > summary`).press('Enter');
      await page.waitForFunction((name) => new RegExp(`folded=[^&]*${name}`).test(location.hash), id);
    }
    await page.locator('.links a[href="#cost"]').click();
    await page.evaluate(() => document.documentElement.style.setProperty('overflow-anchor', 'none'));
    const link = page.locator('#cost tbody a[href^="#r"]').first();
    await link.waitFor();
    const run = (await link.getAttribute('href')).slice(1);
    await link.click();
    await page.locator(`tbody#${run}.open`).waitFor();
    const { below, seen } = await restOf(page, run);
    assert.ok(Math.abs(below) < 3 && seen, `${run} is ${below} px below the head of its table${seen ? '' : ', out of sight'}`);
    assert.deepEqual([await isOpen('runs'), await isOpen('fronts')], [true, false]);
  }));

test('sections that are folded stay folded for whoever is sent the address', async () => {
  let address;
  await visit(one, async (page) => {
    // By keyboard: what is drawn meanwhile may move the page between a mouse's down and up, and that is no click.
    await page.locator('#matrix > details.fold > summary').press('Enter');
    await page.waitForFunction(() => /folded=matrix/.test(location.hash));
    address = await page.evaluate(() => location.hash);
  });
  await visit(one + address, async (page) => {
    const folded = await page.evaluate(() => [...document.querySelectorAll('section > details.fold:not([open])')].map((fold) => fold.parentElement.id));
    assert.deepEqual(folded, ['matrix']);
  });
});

test('a point of a diagram leads to its run, by keyboard, too', () =>
  visit(one, async (page) => {
    const plot = page.locator('#speed svg.plot');
    await plot.focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => /^#r\d+/.test(location.hash));
    await page.locator('#runs tbody.open').waitFor();
  }));

test('a figure leads to its run, on either machine', () =>
  visit(`${both}#cost-1`, async (page) => {
    assert.equal(await page.locator('.machine:visible').count(), 1);
    const link = page.locator('#cost-1 tbody a[href^="#r"]').first();
    await link.waitFor();
    const row = await link.getAttribute('href');
    await link.hover();
    assert.match(await link.getAttribute('title'), / ms per step/);
    await link.click();
    await page.locator(`tbody${row}.open`).waitFor();
  }));

test('a filter leaves what it names, and its address brings it back', async () => {
  let address;
  const linesOf = async (page) => {
    await page.waitForSelector('#runs tbody[data-index]');
    return page.locator('#runs tbody[data-index]').allInnerTexts();
  };
  const isLeft = (texts) => texts.length > 0 && texts.every((text) => /^\s*D1/.test(text) && /gold/.test(text));
  await visit(one, async (page) => {
    await goTo(page, 'runs');
    await page.locator('.filter > summary').click();
    await page.locator('#filter').fill('D1 ');
    await page.locator('#result').selectOption('gold');
    const engine = page.locator('.switch').first(),
      name = await engine.textContent();
    await engine.click();
    await page.waitForFunction(() => /filter=D1/.test(location.hash) && /hide=/.test(location.hash));
    const texts = await linesOf(page);
    assert.ok(isLeft(texts) && texts.every((text) => !text.split(/\s+/).includes(name)), texts[0]);
    address = await page.evaluate(() => location.hash);
  });
  await visit(one + address, async (page) => {
    assert.ok(isLeft(await linesOf(page)));
    assert.match(await page.locator('.filter > summary').textContent(), /D1/);
    await page.locator('.filter > summary').click();
    await page.locator('#clear').click();
    assert.ok(!/filter=/.test(await page.evaluate(() => location.hash)));
  });
});
