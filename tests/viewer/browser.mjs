// The viewer in a browser without a window: loads without a word of complaint, plays, scrubs, draws, shows every layer.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { kArguments, kBrowser as executablePath } from '../../harness/viewer/chromium.mjs';
import { page as makePage } from './page.mjs';
import { crowd, linkage, pairScripts, room, script, specks, tower, zoo } from './synthetic.mjs';
import { kPatience, visitor } from './visitor.mjs';

const folder = process.env.PLUMB_VIEWER_FOLDER,
  root = process.env.PLUMB_SOURCE;
if (!existsSync(executablePath)) {
  console.log(
    `skipped: there is no browser at ${executablePath}; install the package chromium or name one in PLUMB_CHROMIUM`,
  );
  process.exit(0);
}
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');

let browser, visitPage, scratch, file;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-viewer-'));
  file = join(scratch, 'page.html');
  writeFileSync(
    file,
    makePage(root, join(folder, 'viewer.js'), [
      script('tower H=10', 'alpha', tower('alpha')),
      script('tower H=10', 'beta', tower('beta', { lean: 3, layers: false, status: 'failed', reason: 'it leans' })),
      script('shapes', 'alpha', zoo('alpha')),
      script('crowd 5000', 'alpha', crowd('alpha', { frames: 8 })),
      script('room', 'alpha', room('alpha')),
      script(
        'linkage',
        'alpha',
        linkage('alpha', { gap: 0.01, header: { badge: { verdict: 'gold', words: 'nearest to its limit' } } }),
      ),
      script(
        'linkage',
        'beta',
        linkage('beta', { gap: 0.25, header: { badge: { verdict: 'failed', words: 'gap 0.25 > 0.05' } } }),
      ),
      script('specks', 'alpha', specks('alpha')),
      ...pairScripts(['alpha', 'beta']),
    ]),
  );
  browser = await chromium.launch({ executablePath, args: kArguments, timeout: kPatience });
  visitPage = await visitor(browser, isReady);
});

after(async () => {
  await browser?.close();
  if (scratch) rmSync(scratch, { recursive: true });
});

const isReady = (page) => page.evaluate(() => window.plumbViewer.ready);
const address = () => pathToFileURL(file).href;
const visit = (use, settings) => visitPage(address(), use, { width: 900, height: 700, ...settings });

/** A sum over the pixels of the canvas that tells pictures apart, taken from a fresh frame. */
const picture = (page) =>
  page.evaluate(() => {
    window.plumbViewer.renderOnce();
    const canvas = document.querySelector('.pv-canvas'),
      copy = document.createElement('canvas');
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    const pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height),
      colours = new Set();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const rgb = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.add(rgb);
      sum = (Math.imul(sum, 31) + rgb) | 0;
    }
    return { sum, colours: colours.size };
  });

test('a scene is drawn, and scrubbing moves it', () =>
  visit(async (page) => {
    const first = await picture(page);
    assert.ok(first.colours > 200, `${first.colours} colours are no picture of lit boxes`);
    assert.deepEqual(await picture(page), first);
    await page.evaluate(() => window.plumbViewer.seek(1));
    assert.equal(await page.evaluate(() => window.plumbViewer.frame()), 60);
    assert.notEqual((await picture(page)).sum, first.sum);
    await page.evaluate(() => window.plumbViewer.seek(0));
    assert.deepEqual(await picture(page), first);
    await page.locator('.pv-time').fill('1000');
    const { time, begin, end } = await page.evaluate(() => window.plumbViewer.describe());
    assert.ok(Math.abs(time - (begin + end) / 2) < 1e-6);
    await page
      .locator('.pv-plot svg')
      .first()
      .click({ position: { x: 1, y: 20 } });
    assert.ok(
      (await page.evaluate(() => window.plumbViewer.describe())).time < 0.05 * end,
      'a curve leads to its time',
    );
  }));

test('it plays, and pauses', () =>
  visit(async (page) => {
    await page.evaluate(() => window.plumbViewer.play());
    await page.waitForFunction(() => window.plumbViewer.frame() > 3);
    await page.evaluate(() => window.plumbViewer.pause());
    const frame = await page.evaluate(() => window.plumbViewer.frame());
    await page.waitForTimeout(200);
    assert.equal(await page.evaluate(() => window.plumbViewer.frame()), frame);
  }));

test('the first sight of a replay moves by itself, unless the reader wants calm', async () => {
  await visit((page) => page.waitForFunction(() => window.plumbViewer.frame() > 2), {
    reducedMotion: 'no-preference',
  });
  await visit(async (page) => {
    await page.waitForTimeout(500);
    assert.equal((await page.evaluate(() => window.plumbViewer.describe())).playing, false);
  });
});

test('a screenshot differs from an empty one', () =>
  visit(async (page) => {
    const port = page.locator('.pv-port').first(),
      full = await port.screenshot();
    await page.evaluate(() => {
      document.querySelector('.pv-canvas').style.visibility = 'hidden';
    });
    assert.notDeepEqual(await port.screenshot(), full);
  }));

test('every layer changes the picture and comes off again', () =>
  visit(async (page) => {
    await page.evaluate(() => window.plumbViewer.seek(1.3));
    const bare = await picture(page),
      layers = (await page.evaluate(() => window.plumbViewer.describe())).layers;
    assert.ok(layers.length >= 9);
    for (const { name, available } of layers) {
      if (name === 'joints') continue; // of which a tower has none
      assert.ok(available, `the tower was made with ${name}`);
      assert.equal(await page.evaluate((layer) => window.plumbViewer.setLayer(layer, true), name), true);
      assert.notEqual((await picture(page)).sum, bare.sum, `${name} changes nothing`);
      await page.evaluate((layer) => window.plumbViewer.setLayer(layer, false), name);
      assert.deepEqual(await picture(page), bare, `${name} leaves something behind`);
    }
  }));

test('a layer that nobody recorded is grey and says why', () =>
  visit(async (page) => {
    await page.evaluate(() => window.plumbViewer.setLayer('contacts', true));
    assert.match(await page.locator('.pv-notes').nth(1).textContent(), /beta did not record contacts/);
    await page.evaluate(() => window.plumbViewer.select('shapes'));
    const chip = page.locator('[data-layer=islands]');
    assert.equal(await chip.getAttribute('aria-disabled'), 'true');
    await chip.click({ force: true });
    assert.match(await page.locator('.pv-message').textContent(), /Islands: alpha did not record islands/);
  }));

test('a wall does not hide what happens behind it', () =>
  visit(async (page) => {
    await page.evaluate(() => window.plumbViewer.select('room'));
    await page.evaluate(() => window.plumbViewer.setLayer('paths', false));
    const first = await picture(page);
    await page.evaluate(() => window.plumbViewer.seek(0.2));
    assert.notEqual((await picture(page)).sum, first.sum);
  }));

test('picking a body shows its name and its numbers in every view', () =>
  visit(
    async (page) => {
      const box = await page.locator('.pv-port').first().boundingBox();
      await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
      const cards = await page.locator('.pv-card').allTextContents();
      assert.equal(cards.length, 2);
      for (const card of cards) assert.match(card, /^box \d+dynamicposition/);
    },
    { height: 900 },
  ));

test('the keyboard plays, steps and turns', () =>
  visit(async (page) => {
    await page.locator('.pv-port').first().focus();
    const before = await picture(page);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.evaluate(() => window.plumbViewer.frame()), 2);
    await page.keyboard.press('Home');
    await page.keyboard.press('Shift+ArrowLeft');
    assert.notEqual((await picture(page)).sum, before.sum);
    await page.keyboard.press(' ');
    assert.equal((await page.evaluate(() => window.plumbViewer.describe())).playing, true);
  }));

test('all shapes, five thousand bodies, both themes and a telephone', async () => {
  const visitByTelephone = await visitor(browser, isReady, { hasTouch: true, isMobile: true });
  for (const colorScheme of ['light', 'dark']) {
    await visitByTelephone(
      address(),
      async (page) => {
        for (const scene of ['shapes', 'crowd 5000']) {
          await page.evaluate((name) => window.plumbViewer.select(name), scene);
          assert.ok((await picture(page)).colours > 200, scene);
        }
        assert.equal((await page.evaluate(() => window.plumbViewer.describe())).bodies[0], 5001);
        assert.ok(
          await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth),
          'the page is wider than the window',
        );
      },
      { width: 390, height: 780, colorScheme },
    );
  }
});

const describe = (page) => page.evaluate(() => window.plumbViewer.describe());
const select = (page, scene) => page.evaluate((name) => window.plumbViewer.select(name), scene);

/** Pixels of the canvas that are nearly of a CSS colour, in the left half and in the right. */
const pixelsOf = (page, colour) =>
  page.evaluate(([r, g, b]) => {
    window.plumbViewer.renderOnce();
    const canvas = document.querySelector('.pv-canvas'),
      copy = document.createElement('canvas');
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    const pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height),
      halves = [0, 0];
    for (let i = 0; i < data.length; i += 4) {
      if (Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) > 40) continue;
      ++halves[(i / 4) % copy.width < copy.width / 2 ? 0 : 1];
    }
    return halves;
  }, colour);

test('joints are drawn where there are any, their gap as a colour on one scale for all engines', () =>
  visit(async (page) => {
    await select(page, 'linkage');
    const { layers, gapRange } = await describe(page);
    assert.ok(layers.find(({ name }) => name === 'joints').on, 'nobody has to ask for them');
    assert.ok(Math.abs(gapRange - 0.25) < 1e-6);
    assert.match(await page.locator('.pv-legends').textContent(), /gap of a joint0\u2265 250 mmspring/);
    const widest = (
      await page.evaluate(() => getComputedStyle(document.querySelector('.pv-legends .pv-ramp')).backgroundImage)
    )
      .match(/rgb\(([^)]*)\)\)$/)[1]
      .split(/[ ,]+/)
      .map(Number);
    const [alpha, beta] = await pixelsOf(page, widest);
    assert.ok(beta > 20 && alpha < beta / 10, `the widest gap is beta's: ${alpha} and ${beta} pixels of its colour`);
    await page.evaluate(() => window.plumbViewer.seek(1.2));
    const after = await pixelsOf(page, widest);
    assert.ok(after[1] < beta / 4, 'a joint that broke is gone');
    await page.evaluate(() => window.plumbViewer.setLayer('joints', false));
    assert.deepEqual(await pixelsOf(page, widest), [0, 0]);
  }));

test('a scene without ground has a grid and a scale in metres, one with ground no grid', () =>
  visit(async (page) => {
    await select(page, 'linkage');
    const [{ bar, grid }] = (await describe(page)).scale;
    assert.ok(grid > 0 && bar > 0);
    assert.match(await page.locator('.pv-scale-bar').first().textContent(), /^\d+ m; grid \d+ mm, no ground$/);
    // The bar is as long as it says: bob and sled are 4 m apart at the start, and near the turning point.
    await page.evaluate(() => {
      window.plumbViewer.seek(0);
      window.plumbViewer.renderOnce();
    });
    const port = await page.locator('.pv-port').first().boundingBox(),
      [left, right] = await page.evaluate(() => ['bob', 'sled'].map((name) => window.plumbViewer.onScreen(name))),
      apart = Math.hypot((left[0] - right[0]) * port.width, (left[1] - right[1]) * port.height),
      metre = (await page.locator('.pv-scale-bar i').first().boundingBox()).width / bar;
    assert.ok(
      apart / 4 < 1.1 * metre && apart / 4 > 0.6 * metre,
      `${apart} pixels for 4 m, seen askew, of ${metre} to a metre`,
    );
    await page.locator('.pv-port').first().focus();
    for (let i = 0; i < 12; ++i) await page.keyboard.press('+');
    await page.evaluate(() => window.plumbViewer.renderOnce());
    assert.ok((await describe(page)).scale[0].bar < bar, 'it goes with the camera');
    await select(page, 'tower H=10');
    assert.equal((await describe(page)).scale[0].grid, null);
    assert.doesNotMatch(await page.locator('.pv-scale-bar').first().textContent(), /grid/);
  }));

test('a followed body stays in the middle of each view, until escape', () =>
  visit(async (page) => {
    await select(page, 'linkage');
    const find = page.locator('.pv-find');
    await find.fill('nobody');
    await find.press('Enter');
    assert.match(await page.locator('.pv-message').textContent(), /no body "nobody" among 5/);
    await find.fill('lower');
    await find.press('Enter');
    assert.ok((await describe(page)).following);
    for (const time of [0, 0.4, 0.9]) {
      const places = await page.evaluate((seconds) => {
        window.plumbViewer.seek(seconds);
        window.plumbViewer.renderOnce();
        return [0, 1].map((view) => window.plumbViewer.onScreen('lower', view));
      }, time);
      for (const [x, y] of places) assert.ok(Math.hypot(x - 0.5, y - 0.5) < 0.01, `at ${time} s it is at ${x}, ${y}`);
    }
    const port = page.locator('.pv-port').first();
    await port.focus();
    await page.keyboard.press('Escape');
    let state = await describe(page);
    assert.deepEqual([state.following, state.picked], [false, [1, 1]], 'it stays picked');
    await page.keyboard.press('Escape');
    assert.deepEqual((await describe(page)).picked, [null, null]);
    await page.keyboard.press('.');
    await page.keyboard.press('.');
    await page.keyboard.press('c');
    state = await describe(page);
    assert.deepEqual([state.following, state.picked], [true, [1, 1]], 'the keyboard picks and follows, too');
  }));

test('names stand beside bodies when asked for, and of five thousand only the nearest', () =>
  visit(async (page) => {
    const names = page.locator('.pv-body-name:visible');
    await select(page, 'linkage');
    assert.equal(await names.count(), 0);
    await page.locator('.pv-port').first().focus();
    await page.keyboard.press('n');
    await page.evaluate(() => window.plumbViewer.renderOnce());
    const words = await page.locator('.pv-view').first().locator('.pv-body-name:visible').allTextContents();
    assert.deepEqual(words.sort(), ['bob', 'lower', 'sled', 'upper', 'wheel']);
    await select(page, 'crowd 5000');
    await page.evaluate(() => window.plumbViewer.renderOnce());
    const count = await names.count();
    assert.ok(count > 10 && count <= 40, `${count} names`);
    await page.locator('.pv-port').first().focus();
    await page.keyboard.press('n');
    await page.evaluate(() => window.plumbViewer.renderOnce());
    assert.equal(await names.count(), 0);
  }));

test('every run has its badge, those that pass, too', () =>
  visit(async (page) => {
    const chips = page.locator('.pv-view > header .chip');
    assert.deepEqual(await chips.allTextContents(), ['pass', 'failed'], 'as older recordings tell it');
    await select(page, 'linkage');
    assert.deepEqual(await chips.allTextContents(), ['gold', 'failed']);
    assert.deepEqual(await page.locator('.pv-view > header small').allTextContents(), [
      'nearest to its limit',
      'gap 0.25 > 0.05',
    ]);
  }));

test('bodies far smaller than a pixel are seen all the same', () =>
  visit(async (page) => {
    await select(page, 'specks');
    const { colours } = await picture(page),
      seen = await page.evaluate(() => {
        const canvas = document.querySelector('.pv-canvas'),
          copy = document.createElement('canvas');
        window.plumbViewer.renderOnce();
        Object.assign(copy, { width: canvas.width, height: canvas.height });
        const pen = copy.getContext('2d');
        pen.drawImage(canvas, 0, 0);
        const { data } = pen.getImageData(0, 0, copy.width, copy.height);
        let vivid = 0;
        for (let i = 0; i < data.length; i += 4)
          if (Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60) ++vivid;
        return vivid;
      });
    assert.ok(seen >= 9 * 4, `${seen} pixels of nine bodies are coloured, of ${colours} colours in all`);
  }));

test('a page may have a replay elsewhere, which begins when the reader comes near', async () => {
  const other = join(scratch, 'mounted.html');
  writeFileSync(
    other,
    makePage(root, join(folder, 'viewer.js'), [
      '<div id="near" data-plumb-replay="shapes"></div><div style="height:6000px"></div><div id="far" data-plumb-replay=""></div>',
      script('tower H=10', 'alpha', tower('alpha')),
      script('shapes', 'alpha', zoo('alpha')),
    ]),
  );
  await visitPage(
    pathToFileURL(other).href,
    async (page) => {
      await page.waitForSelector('#near .pv-view');
      assert.equal(await page.locator('#near .pv-title').textContent(), 'every kind of shape');
      assert.equal(await page.locator('#near .pv-curves *').count(), 0, 'without curves');
      assert.equal(await page.locator('#far > *').count(), 0);
      await page.evaluate(() => document.getElementById('far').scrollIntoView());
      await page.waitForSelector('#far .pv-view');
      assert.equal(await page.locator('#far .pv-title').textContent(), 'a tower of boxes');
    },
    { width: 900, height: 700 },
  );
});

test('a replay elsewhere may stand at a moment of its own instead of playing', () =>
  visit(
    async (page) => {
      const shown = await page.evaluate(async () => {
        const place = document.createElement('div');
        document.querySelector('main').prepend(place);
        scrollTo(0, 0);
        const api = window.plumbReplays.mount(place, { scene: 'tower H=10', at: '0.5', compact: true });
        await api.ready;
        await new Promise((resolve) => {
          setTimeout(resolve, 300);
        });
        return api.describe();
      });
      assert.equal(shown.time, 0.5);
      assert.equal(shown.playing, false);
      assert.deepEqual(shown.backends, ['alpha', 'beta']);
    },
    { reducedMotion: 'no-preference' },
  ));

test('pairs of shapes are chosen from a matrix and shown side by side', () =>
  visit(async (page) => {
    await page.locator('.pv-scene select').selectOption({ label: 'pairs of shapes' });
    await page.waitForFunction(() => window.plumbViewer.describe().kind === 'pairs');
    assert.equal(await page.locator('.pv-pairs button').count(), 6);
    await page.locator('[data-pair="pair box-sphere"]').click();
    await page.waitForFunction(() => window.plumbViewer.describe().scene === 'pair box-sphere');
    const { backends, layers } = await page.evaluate(() => window.plumbViewer.describe());
    assert.deepEqual(backends, ['alpha', 'beta']);
    assert.deepEqual(
      layers.filter(({ on }) => on).map(({ name }) => name),
      ['contacts', 'axes'],
    );
    const apart = await picture(page);
    await page.evaluate(() => window.plumbViewer.seek(0.8));
    assert.notEqual((await picture(page)).sum, apart.sum);
    assert.deepEqual(await page.locator('.pv-strip:first-child .pv-value').allTextContents(), [
      '\u2212197 mm',
      '\u2212187 mm',
    ]);
    await page.evaluate(() => window.plumbViewer.selectPair('capsule', 'capsule'));
    assert.equal((await page.evaluate(() => window.plumbViewer.describe())).scene, 'pair capsule-capsule');
    await page.evaluate(() => window.plumbViewer.select('tower H=10'));
    assert.deepEqual(
      (await page.evaluate(() => window.plumbViewer.describe())).layers.filter(({ on }) => on),
      [],
    );
  }));

test('without WebGL it says so in words', async () => {
  const blind = await chromium.launch({
    executablePath,
    args: [...kArguments.filter((argument) => !/gl|swiftshader/.test(argument)), '--disable-gpu', '--disable-3d-apis'],
  });
  try {
    const visitBlind = await visitor(blind, isReady);
    await visitBlind(address(), async (page) => assert.match(await page.locator('.pv-failure').textContent(), /WebGL 2/));
  } finally {
    await blind.close();
  }
});
