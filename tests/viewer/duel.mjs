// The page of a duel in a browser without a window: ranked scenes lead to their cards, replays stand where the engines
// part, and nothing is cut.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { kArguments, kBrowser } from '../../harness/viewer/chromium.mjs';
import { kPatience, visitor } from './visitor.mjs';

const { PLUMB_VIEWER_FOLDER: folder, PLUMB_SOURCE: root, PLUMB_PROGRAM: program, SAMPLE_BACKEND: sample } = process.env;
if (!existsSync(kBrowser)) {
  console.log(`skipped: there is no browser at ${kBrowser}; install the package chromium or name one in PLUMB_CHROMIUM`);
  process.exit(0);
}
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');

let browser, visit, scratch;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-duel-'));
  browser = await chromium.launch({ executablePath: kBrowser, args: kArguments, timeout: kPatience });
  visit = await visitor(browser);
});

after(async () => {
  await browser?.close();
  if (scratch) rmSync(scratch, { recursive: true });
});

const plumb = (...given) =>
  execFileSync(program, given, {
    encoding: 'utf8',
    maxBuffer: 1 << 30,
    env: { ...process.env, PLUMB_SCENES: join(root, 'scenes') },
  });

const overflow = (page) =>
  page.evaluate(() => [
    document.documentElement.scrollWidth - innerWidth,
    ...[...document.querySelectorAll('.card.duel')].map((card) => card.scrollWidth - card.clientWidth),
  ]);

test('replays of both stand side by side at the moment where they part', async () => {
  const file = join(scratch, 'run.html');
  plumb('duel', sample, `${sample}:integrator=verlet`, 'A1', '--repeat', '1', '--out', join(scratch, 'run'), '--html', file);
  const use = async (page) => {
    await page.waitForSelector('#scene1 .pv-view');
    assert.equal(await page.locator('#scene1 .pv-view').count(), 2);
    await page.waitForTimeout(300); // it would play by now
    const { at, shown } = await page.evaluate(() => {
      const place = document.querySelector('#scene1 [data-plumb-replay]'),
        { begin, end } = window.plumbViewer.describe(),
        slider = place.querySelector('.pv-time');
      return { at: Number(place.dataset.at), shown: begin + ((end - begin) * slider.value) / slider.max };
    });
    assert.ok(at > 0);
    assert.ok(Math.abs(shown - at) < 0.01, `${shown} s, and they part at ${at} s`);
  };
  await visit(pathToFileURL(file).href, use, { width: 1300, reducedMotion: 'no-preference' });
});

test('of earlier results every ranked scene leads to its card, and nothing is cut', async () => {
  const results = join(root, 'harness/results/xeon-16-cores'),
    file = join(scratch, 'from.html');
  const rows = plumb('report', results, '--json').trim().split('\n');
  const [first, second] = new Set(rows.map((row) => JSON.parse(row).backend));
  plumb('duel', first, second, '--from', results, '--html', file);
  for (const width of [1300, 420])
    await visit(
      pathToFileURL(file).href,
      async (page) => {
        const { links, cards } = await page.evaluate(() => ({
          links: [...document.querySelectorAll('#ranked tbody a')].map((link) => link.getAttribute('href').slice(1)),
          cards: [...document.querySelectorAll('.card.duel')].map((card) => card.id),
        }));
        assert.ok(links.length > 5, `${links.length} scenes`);
        assert.deepEqual(links, cards);
        assert.deepEqual(
          (await overflow(page)).filter((pixels) => pixels > 0),
          [],
          `cut at ${width}`,
        );
      },
      { width },
    );
});
