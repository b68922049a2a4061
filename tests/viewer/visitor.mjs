// Visits pages in one tab of one window: a window of its own for each costs the browser more than the page that it shows.
import assert from 'node:assert/strict';
import { complaints } from './complaints.mjs';

export const kPatience = 180000; // ms that anything may take, on a machine that has other work

/**
 * A function visit(url, use, settings) that runs use(page) on the page when isReady(page) has come to pass, leaves it with
 * all that was done to it, and fails on anything that its console says or that it asks of a network.
 */
export async function visitor(browser, isReady = () => {}, options = {}) {
  const page = await browser.newPage(options),
    said = complaints(page);
  page.setDefaultTimeout(kPatience);
  return async (url, use, { width = 1400, height = 900, colorScheme = 'light', reducedMotion = 'reduce' } = {}) => {
    let heard;
    await page.setViewportSize({ width, height });
    await page.emulateMedia({ colorScheme, reducedMotion });
    try {
      await page.goto(url);
      await isReady(page);
      await use(page);
    } finally {
      await page.goto('about:blank');
      heard = said.splice(0);
    }
    // What the browser says of a software renderer's speed is none of the page's doing.
    assert.deepEqual(
      heard.filter((line) => !/GPU stall|GL Driver Message/.test(line)),
      [],
    );
  };
}
