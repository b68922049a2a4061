// Scenes that pages run: the same bits as `plumb run` has of the native engine, and the harness's own numbers of them.
import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { load } from '../../api/web/plumb.mjs';
import { expression } from '../../harness/viewer/src/live/expressions.js';
import { LiveReplay } from '../../harness/viewer/src/live/live_replay.js';
import { LiveRun } from '../../harness/viewer/src/live/run.js';
import { livePage, needWasm, partsOf, plumb } from './live_page.mjs';

needWasm();

// Boxes, a chain, all joints with their limits, motors and springs, what a host moves, compounds, meshes and heights.
const kScenes = ['D1', 'E1', 'I1', 'I19', 'E17', 'C9', 'H1', 'G7'];

let scratch, engine, worlds, rows;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-live-'));
  const page = join(scratch, 'live.html');
  livePage(page, ...kScenes);
  const parts = partsOf(page);
  worlds = parts.worlds;
  engine = await load(parts.engine);
  rows = plumb('run', ...kScenes, '--backend', 'impulse', '--json').trim().split('\n').map((line) => JSON.parse(line));
});

after(() => rmSync(scratch, { recursive: true }));

test('hashes', () => {
  for (const row of rows) {
    const title = [row.scene, ...Object.entries(row.params).map(([name, value]) => `${name}=${value}`)].join(' ');
    const form = worlds[title];
    if (!form) { console.log('no world', title, Object.keys(worlds).slice(0,5)); continue; }
    const run = new LiveRun(engine, form);
    const steps = Math.ceil(row.seconds / row.dt - 1e-6);
    const t0 = performance.now();
    for (let i = 0; i < steps; ++i) run.step();
    console.log(title, row.status, steps, run.hash, row.hash, run.hash === row.hash ? 'same' : 'DIFFERS', (performance.now() - t0).toFixed(0));
    run.world.destroy();
  }
});
