// A page that runs scenes, in a browser without a window: it runs, stops, begins anew, takes what the reader changes, and
// lets bodies be pulled; the same in a report, below its recordings.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { kArguments, kBrowser } from '../../harness/viewer/chromium.mjs';
import { livePage, needWasm, plumb } from './live_page.mjs';
import { kPatience, visitor } from './visitor.mjs';

needWasm();
if (!existsSync(kBrowser)) {
  console.log(
    `skipped: there is no browser at ${kBrowser}; install the package chromium or name one in PLUMB_CHROMIUM`,
  );
  process.exit(0);
}
const { chromium } = createRequire(join(process.env.PLUMB_VIEWER_FOLDER, 'package.json'))('playwright-core');

let browser, visit, visitReport, scratch, file;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-live-'));
  file = join(scratch, 'live.html');
  livePage(file, 'D1', 'E1', '--param', 'H=5', '--param', 'L=10');
  browser = await chromium.launch({ executablePath: kBrowser, args: kArguments, timeout: kPatience });
  visit = await visitor(browser, (page) => page.evaluate(() => window.plumbLive.ready));
  visitReport = await visitor(browser, (page) => page.evaluate(() => window.plumbViewer.ready));
});

after(async () => {
  await browser?.close();
  if (scratch) rmSync(scratch, { recursive: true });
});

const visitLive = (use, settings) => visit(pathToFileURL(file).href, use, settings);
const change = async (page, name, value) => {
  const field = page.locator(`[data-setting="${name}"] :is(input, select)`);
  await field.evaluate((input) => input.closest('details').setAttribute('open', ''));
  if ((await field.evaluate((input) => input.tagName)) === 'SELECT') await field.selectOption(value);
  else {
    await field.fill('');
    await field.pressSequentially(value); // none of which the viewer takes for one of its keys
    await field.press('Enter');
  }
};

test('it runs by itself, unless the reader wants calm, and stops', async () => {
  await visitLive((page) => page.waitForFunction(() => window.plumbLive.frame() > 3), {
    reducedMotion: 'no-preference',
  });
  await visitLive(async (page) => {
    await page.waitForTimeout(300);
    assert.equal(await page.evaluate(() => window.plumbLive.frame()), 0);
    await page.locator('.pv-play').click();
    await page.waitForFunction(() => window.plumbLive.frame() > 3);
    await page.locator('.pv-play').click();
    const frame = await page.evaluate(() => window.plumbLive.frame());
    await page.waitForTimeout(200);
    assert.equal(await page.evaluate(() => window.plumbLive.frame()), frame);
  });
});

test('steps and a new beginning come to the same bits', () =>
  visitLive(async (page) => {
    const after20 = () => page.evaluate(() => (window.plumbLive.step(20), window.plumbLive.hash));
    const first = await after20();
    await page.locator('.pv-anew').click();
    assert.equal(await page.evaluate(() => window.plumbLive.frame()), 0);
    assert.equal(await after20(), first);
    await page.locator('.pv-step').click();
    assert.equal(await page.evaluate(() => window.plumbLive.frame()), 21);
    await page.evaluate(() => window.plumbLive.renderOnce());
    assert.match(
      await page.locator('.pv-counts').textContent(),
      /step 21 \u00b7 5 bodies, \d awake \u00b7 \d+ contacts/,
    );
  }));

test('what is changed counts, and what is wrong is said', () =>
  visitLive(async (page) => {
    await change(page, 'gravity', '-20');
    await change(page, 'step', '1/120');
    await change(page, 'friction', '0');
    await change(page, 'substeps', '4');
    const { gravity, dt, friction, substeps } = await page.evaluate(() => {
      const { run } = window.plumbLive;
      return {
        gravity: run.gravity,
        dt: run.dt,
        friction: run.material.friction,
        substeps: run.getSetting('substeps'),
      };
    });
    assert.deepEqual(
      { gravity, dt, friction, substeps },
      { gravity: [0, -20, 0], dt: 1 / 120, friction: 0, substeps: 4 },
    );
    assert.equal(await page.locator('.pv-changed').count(), 4);
    await change(page, 'substeps', '100000');
    assert.match(await page.locator('.pv-message').textContent(), /substeps: "100000" is no whole number from 1 to/);
    assert.equal(await page.locator('[data-setting=substeps] input').inputValue(), '4');
    await page.getByText('All as at first').click();
    await page.waitForFunction(() => document.querySelectorAll('.pv-changed').length === 0);
    assert.equal(await page.evaluate(() => window.plumbLive.run.gravity[1]), -9.81);
  }));

test('a body that is taken comes along, and a click picks it', () =>
  visitLive(async (page) => {
    const box = await page.locator('.pv-port').boundingBox(),
      [x, y] = await page.evaluate(() => window.plumbLive.onScreen('box4')),
      at = [box.x + x * box.width, box.y + y * box.height];
    const height = () => page.evaluate(() => window.plumbLive.run.poses[5 * 7 + 1]);
    const before = await height();
    await page.mouse.move(...at);
    await page.mouse.down();
    await page.mouse.move(at[0], at[1] - 150, { steps: 3 });
    await page.evaluate(() => window.plumbLive.step(60));
    assert.ok((await height()) > before + 0.3, `${await height()} m, from ${before} m`);
    await page.mouse.up();
    await page.evaluate(() => window.plumbLive.step(1));
    assert.equal(await page.evaluate(() => window.plumbLive.run.pull), null);
    await page.evaluate(() => (window.plumbLive.reset(), window.plumbLive.renderOnce()));
    await page.mouse.click(...at);
    assert.match(await page.locator('.pv-card').textContent(), /^box4dynamic/);
  }));

test('joints, forces and velocities are drawn, and what is measured is plotted along', () =>
  visitLive(async (page) => {
    await page.evaluate(() => window.plumbLive.select('E1 L=10'));
    await page.evaluate(() => window.plumbLive.step(30));
    const picture = () => page.locator('.pv-port').screenshot();
    let before = await picture();
    for (const layer of ['joints', 'velocities']) {
      const { on } = await page.evaluate(
        (name) => window.plumbLive.describe().layers.find((one) => one.name === name),
        layer,
      );
      await page.evaluate(([name, to]) => window.plumbLive.setLayer(name, to), [layer, !on]);
      const now = await picture();
      assert.notDeepEqual(now, before, layer);
      before = now;
    }
    const captions = await page.locator('.pv-caption').allTextContents();
    assert.match(captions.join('\n'), /energy-?[^]*J[^]*widest gap of a joint[^]*m/);
    await page.evaluate(() => window.plumbLive.follow('0'));
    assert.ok(await page.evaluate(() => window.plumbLive.describe().following));
  }));

test('a report runs its scenes below their recordings', async () => {
  const results = join(scratch, 'results'),
    report = join(scratch, 'report.html');
  plumb('run', 'D1', '--param', 'H=5', '--seconds', '1', '--backend', 'impulse', '--record', '--out', results);
  plumb('report', results, '--html', report);
  await visitReport(pathToFileURL(report).href, async (page) => {
    await page.locator('.pv-run').click();
    await page.waitForFunction(() => window.plumbLive);
    await page.evaluate(() => window.plumbLive.ready);
    assert.equal(await page.evaluate(() => window.plumbLive.describe().scene), 'D1 H=5');
    await page.evaluate(() => window.plumbLive.step(60));
    const row = JSON.parse(plumb('report', results, '--json').trim().split('\n')[0]);
    assert.equal(await page.evaluate(() => window.plumbLive.hash), row.hash);
  });
});
