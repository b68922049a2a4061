// A page as the report makes them, with the viewer and the given replay scripts in it.
import { readFileSync } from 'node:fs';

/** root: the repository; viewer: the bundled viewer.js. */
export function page(root, viewer, scripts, { theme = 'light' } = {}) {
  const read = (name) => readFileSync(`${root}/harness/report/page/${name}`, 'utf8');
  return `<!doctype html><html lang="en" data-theme="${theme}"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<meta name="color-scheme" content="light dark"><title>replays</title><link rel="icon" href="data:,">
<style>${read('page.css')}</style></head><body><main>
<section id="replays"><h2>Replays</h2><div id="plumb-viewer"></div></section></main>
${scripts.join('\n')}<script>${readFileSync(viewer, 'utf8')}</script></body></html>`;
}
