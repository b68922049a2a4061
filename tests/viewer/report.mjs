// The report's page in a browser without a window: it unpacks, leads from figures to runs, and hides what is filtered.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { kArguments, kBrowser } from '../../harness/viewer/chromium.mjs';

const { PLUMB_VIEWER_FOLDER: folder, PLUMB_SOURCE: root, PLUMB_PROGRAM: program } = process.env;
if (!existsSync(kBrowser)) {
  console.log(`skipped: there is no browser at ${kBrowser}; install the package chromium or name one in PLUMB_CHROMIUM`);
  process.exit(0);
}
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');

let browser, scratch, url;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-report-'));
  const file = join(scratch, 'page.html'),
    results = ['xeon-2-cores', 'h200'].map((machine) => join(root, 'harness/results', machine));
  execFileSync(program, ['report', ...results, '--html', file], { env: { ...process.env, PLUMB_SCENES: join(root, 'scenes') } });
  url = pathToFileURL(file).href;
  browser = await chromium.launch({ executablePath: kBrowser, args: kArguments });
});

after(async () => {
  await browser?.close();
  if (scratch) rmSync(scratch, { recursive: true });
});

/** Runs use(page) on a fresh page that has unpacked, and fails on anything that its console says. */
async function visit(hash, use) {
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 } }),
    said = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) said.push(message.text());
  });
  page.on('pageerror', (error) => said.push(error.stack));
  await page.goto(url + hash);
  await page.waitForFunction(() => 'unpacked' in document.documentElement.dataset, null, { timeout: 60000 });
  await use(page);
  await page.close();
  assert.deepEqual(said, []);
}

test('what is packed is unpacked, and only one machine is shown', () =>
  visit('', async (page) => {
    assert.equal(await page.locator('script.packed').count(), 0);
    assert.equal(await page.locator('.machine').count(), 2);
    assert.equal(await page.locator('.machine:visible').count(), 1);
    for (const id of ['cost', 'answers', 'engines', 'precision', 'fronts', 'matrix', 'runs'])
      assert.ok(await page.locator(`#${id}`).isVisible(), id);
    await page.locator('#machine').selectOption('1');
    assert.ok(!(await page.locator('#cost').isVisible()));
    assert.ok(await page.locator('#cost-1').isVisible());
  }));

test('an address leads to a run, with the command that repeats it', () =>
  visit('#r3', async (page) => {
    const details = page.locator('tr.details');
    assert.equal(await details.count(), 1);
    assert.match(await details.innerText(), /plumb run \w+ --backend /);
    await page.locator('tr#r3').click();
    assert.equal(await details.count(), 0);
  }));

test('a figure leads to its run, on either machine', () =>
  visit('#cost-1', async (page) => {
    await page.locator('#machine').selectOption('1');
    const link = page.locator('#cost-1 tbody a[href^="#r"]').first(),
      row = await link.getAttribute('href');
    await link.click();
    assert.equal(await page.locator(`${row}.open`).count(), 1);
  }));

test('a filter leaves what it names', () =>
  visit('', async (page) => {
    const rows = page.locator('#runs tbody > tr:visible'),
      all = await rows.count();
    await page.locator('#filter').fill('D1 gold');
    await page.waitForFunction(
      (before) => [...document.querySelectorAll('#runs tbody > tr')].filter((row) => !row.hidden).length < before,
      all,
    );
    const texts = await rows.allInnerTexts();
    assert.ok(texts.length > 0 && texts.every((text) => /^D1/.test(text.trim()) && /gold/.test(text)), texts[0]);
  }));
