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
import { crowd, pairScripts, room, script, tower, zoo } from './synthetic.mjs';

const folder = process.env.PLUMB_VIEWER_FOLDER,
  root = process.env.PLUMB_SOURCE;
if (!existsSync(executablePath)) {
  console.log(
    `skipped: there is no browser at ${executablePath}; install the package chromium or name one in PLUMB_CHROMIUM`,
  );
  process.exit(0);
}
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');

let browser, scratch, file;

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
      ...pairScripts(['alpha', 'beta']),
    ]),
  );
  browser = await chromium.launch({ executablePath, args: kArguments });
});

after(async () => {
  await browser?.close();
  if (scratch) rmSync(scratch, { recursive: true });
});

/** Runs use(page) on a fresh page and fails on anything that its console says. */
async function visit(
  use,
  { size = { width: 900, height: 700 }, url = pathToFileURL(file).href, context = {}, browserUsed = browser } = {},
) {
  const page = await browserUsed.newPage({ viewport: size, reducedMotion: 'reduce', ...context }),
    said = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) said.push(message.text());
  });
  page.on('pageerror', (error) => said.push(error.stack));
  await page.goto(url);
  await page.evaluate(() => window.plumbViewer.ready);
  await use(page);
  await page.close();
  // What the browser says of a software renderer's speed is none of the viewer's doing.
  assert.deepEqual(
    said.filter((line) => !/GPU stall|GL Driver Message/.test(line)),
    [],
  );
}

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
    context: { reducedMotion: 'no-preference' },
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
    { size: { width: 900, height: 900 } },
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
  for (const colorScheme of ['light', 'dark']) {
    await visit(
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
      { size: { width: 390, height: 780 }, context: { colorScheme, hasTouch: true, isMobile: true } },
    );
  }
});

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
    await visit(async (page) => assert.match(await page.locator('.pv-failure').textContent(), /WebGL 2/), {
      browserUsed: blind,
    });
  } finally {
    await blind.close();
  }
});
