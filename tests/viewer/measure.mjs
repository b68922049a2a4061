// What a frame costs, in the browser without a window: node measure.mjs [BODIES...], with the folders of browser.mjs
// in the environment. Drawing is by a software renderer here, so only the first number is that of a reader's machine.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { kArguments, kBrowser } from '../../harness/viewer/chromium.mjs';
import { page as makePage } from './page.mjs';
import { crowd, script } from './synthetic.mjs';

const kRounds = 40;
const folder = process.env.PLUMB_VIEWER_FOLDER;
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');
const counts = process.argv.slice(2).map(Number);
const browser = await chromium.launch({ executablePath: kBrowser, args: kArguments });
const scratch = mkdtempSync(join(tmpdir(), 'plumb-viewer-'));
try {
  for (const count of counts.length ? counts : [1000, 5000]) {
    const file = join(scratch, `${count}.html`);
    const replays = [script('crowd', 'alpha', crowd('alpha', { count }))];
    writeFileSync(file, makePage(process.env.PLUMB_SOURCE, join(folder, 'viewer.js'), replays));
    const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, reducedMotion: 'reduce' });
    await page.goto(pathToFileURL(file).href);
    await page.evaluate(() => window.plumbViewer.ready);
    const [submitted, drawn] = await page.evaluate((rounds) => {
      const measure = () => {
        const times = [];
        for (let i = 0; i < rounds; ++i) {
          window.plumbViewer.seek((i % 25) / 60);
          times.push(window.plumbViewer.renderOnce());
        }
        return times.sort((a, b) => a - b);
      };
      const finished = measure();
      WebGL2RenderingContext.prototype.readPixels = () => {}; // nobody waits for the picture any more
      return [measure(), finished];
    }, kRounds);
    const middle = (times) => times[kRounds >> 1].toFixed(1),
      least = (times) => times[0].toFixed(1);
    console.log(
      `${count} bodies: ${middle(submitted)} ms a frame until all is handed to the graphics (least ${least(submitted)}), ` +
        `${middle(drawn)} ms until software has drawn it (least ${least(drawn)})`,
    );
    await page.close();
  }
} finally {
  await browser.close();
  rmSync(scratch, { recursive: true });
}
