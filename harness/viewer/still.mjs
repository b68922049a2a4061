// Pictures of a report's replays, made by a browser without a window: one PNG, or one for each frame of a film.
import { existsSync, mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { kArguments, kBrowser } from './chromium.mjs';

const kUsage =
  'usage: node still.mjs PAGE.html --size 1280x720 (--at SECONDS --png FILE | --frames DIR --fps F) ' +
  '[--scene NAME] [--layers A,B] [--theme light|dark]';

class Refusal extends Error {}

function need(condition, text) {
  if (!condition) throw new Refusal(text);
}

function readOptions() {
  let parsed;
  try {
    parsed = parseArgs({
      allowPositionals: true,
      options: Object.fromEntries(
        ['size', 'at', 'png', 'frames', 'fps', 'scene', 'layers', 'theme'].map((name) => [name, { type: 'string' }]),
      ),
    });
  } catch (error) {
    throw new Refusal(`${error.message}\n${kUsage}`);
  }
  const {
    values,
    positionals: [page, ...rest],
  } = parsed;
  need(page && !rest.length, kUsage);
  need(existsSync(page), `there is no page "${page}"; make one with: plumb report DIR --html FILE`);
  const size = /^(\d+)x(\d+)$/.exec(values.size ?? '1280x720');
  need(size && size[1] > 0 && size[2] > 0, `--size is "${values.size}"; write it as 1280x720`);
  const at = values.at === undefined ? undefined : Number(values.at),
    fps = values.fps === undefined ? undefined : Number(values.fps);
  need(
    (values.png === undefined) !== (values.frames === undefined),
    `give --at and --png for one picture, or --frames and --fps for a film\n${kUsage}`,
  );
  need(
    values.png === undefined || Number.isFinite(at),
    `--at is "${values.at}"; give the seconds of the scene, as in --at 2.5`,
  );
  need(values.frames === undefined || fps > 0, `--fps is "${values.fps}"; give frames a second, as in --fps 30`);
  need(
    values.theme === undefined || ['light', 'dark'].includes(values.theme),
    `--theme is "${values.theme}"; it is light or dark`,
  );
  return {
    ...values,
    page,
    at,
    fps,
    width: Number(size[1]),
    height: Number(size[2]),
    layers: values.layers?.split(',').filter(Boolean) ?? [],
  };
}

async function launch() {
  const executablePath = kBrowser;
  need(
    existsSync(executablePath),
    `there is no browser at ${executablePath}; install the package chromium or name one in PLUMB_CHROMIUM`,
  );
  const { chromium } = await import('playwright-core');
  return chromium.launch({ executablePath, args: [...kArguments, '--hide-scrollbars'] });
}

/** Opens the page, chooses scene and layers, and fills the window with the views alone. */
async function prepare(browser, options) {
  const page = await browser.newPage({
    viewport: { width: options.width, height: options.height },
    reducedMotion: 'reduce',
    colorScheme: options.theme ?? 'light',
  });
  const url = pathToFileURL(resolve(options.page));
  if (options.theme) url.search = `?theme=${options.theme}`;
  await page.goto(url.href);
  need(
    await page.evaluate(() => Boolean(window.plumbViewer)),
    `${options.page} has no replays in it: run with --record, and make the report where node and npm are installed`,
  );
  const failure = await page.evaluate(() => window.plumbViewer.ready.then(() => window.plumbViewer.failure));
  need(!failure, failure);
  if (options.scene) {
    const scenes = await page.evaluate(() => window.plumbViewer.scenes());
    need(
      scenes.includes(options.scene),
      `there is no replay of the scene "${options.scene}"; there are: ${scenes.join(', ')}`,
    );
    await page.evaluate((scene) => window.plumbViewer.select(scene), options.scene);
  }
  for (const layer of options.layers) {
    const problem = await page.evaluate((name) => {
      try {
        return window.plumbViewer.setLayer(name, true)
          ? null
          : `no engine of this scene recorded what the layer "${name}" shows`;
      } catch (error) {
        return error.message;
      }
    }, layer);
    need(!problem, problem);
  }
  await page.evaluate(() => {
    window.plumbViewer.pause();
    window.plumbViewer.present(true, true);
  });
  return page;
}

async function shoot(page, time, path) {
  await page.evaluate((seconds) => {
    window.plumbViewer.seek(seconds);
    window.plumbViewer.renderOnce();
  }, time);
  await page.screenshot({ path });
}

async function main() {
  const options = readOptions(),
    browser = await launch();
  try {
    const page = await prepare(browser, options);
    const { begin, end } = await page.evaluate(() => window.plumbViewer.describe());
    if (options.png !== undefined) {
      need(
        options.at >= begin && options.at <= end + 1e-6,
        `--at is ${options.at}; the replay goes from ${begin.toFixed(2)} to ${end.toFixed(2)} s`,
      );
      await shoot(page, options.at, options.png);
      return;
    }
    mkdirSync(options.frames, { recursive: true });
    const count = Math.max(1, Math.floor((end - begin) * options.fps + 1e-6) + 1);
    for (let i = 0; i < count; ++i)
      await shoot(page, begin + i / options.fps, join(options.frames, `frame_${String(i).padStart(5, '0')}.png`));
    console.log(`${count} frames in ${options.frames}`);
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.error(`still: ${error instanceof Refusal ? error.message : error.stack}`);
  process.exitCode = 1;
});
