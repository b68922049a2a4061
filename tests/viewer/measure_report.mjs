// How long a report's page takes to its first use, in the browser without a window: node measure_report.mjs PAGE.html
// [ROUNDS], with the folder of browser.mjs in the environment. First use: the filter, links and the picture of the first
// screen are there.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { kArguments, kBrowser } from '../../harness/viewer/chromium.mjs';

const { chromium } = createRequire(resolve(process.env.PLUMB_VIEWER_FOLDER, 'package.json'))('playwright-core');
const [file, rounds = '5'] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: kBrowser, args: kArguments });
try {
  const times = [];
  let page;
  for (let i = 0; i < Number(rounds); ++i) {
    await page?.close();
    page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
    await page.goto(pathToFileURL(resolve(file)).href, { waitUntil: 'commit' });
    const ready = await page.waitForFunction(() => 'ready' in document.documentElement.dataset && (!document.getElementById('speed') || document.querySelector('#speed svg.plot')) && performance.now());
    times.push(await ready.jsonValue());
  }
  times.sort((a, b) => a - b);
  const { elements, height } = await page.evaluate(() => ({
    elements: document.querySelectorAll('*').length,
    height: document.documentElement.scrollHeight,
  }));
  console.log(
    `first use after ${Math.round(times[times.length >> 1])} ms (${Math.round(times[0])} to ${Math.round(times.at(-1))}), ${elements} elements, ${height} px tall`,
  );
} finally {
  await browser.close();
}
