// Time of a step by the number of threads, beside the .wasm of one thread. All take their steps in turn, as other programs
// may use the machine, and the best part of each counts: PLUMB_WEB=FOLDER node bench_threads.mjs [THREADS]...
import assert from 'node:assert/strict';
import { load } from './worlds.mjs';

const kPart = 2, kParts = 40, kWarm = 40; // steps
const counts = process.argv.length > 2 ? process.argv.slice(2).map(Number) : [1, 2];
const folder = new URL('./', new URL(`file://${process.env.PLUMB_WEB}/`));

const pile = (count, side) => (drop) => {
  for (let i = 0; i < count; ++i)
    drop(1.3 * (i % side - (side - 1) / 2) + 0.1 * (i % 7), 1 + 1.2 * Math.floor(i / side ** 2),
      1.3 * (Math.floor(i / side) % side - (side - 1) / 2));
};
const scenes = {
  'pyramid-100': (drop) => {
    for (let row = 0; row < 100; ++row)
      for (let i = 0; i < 100 - row; ++i) drop(1.05 * (i - (99 - row) / 2), 0.5 + row, 0);
  },
  'pile-4000': pile(4000, 16),
  'pile-500': pile(500, 8),
};

function worldOf(engine, scene, threads) {
  const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction'], threads });
  world.createBody({ shape: world.createShape({ type: 'plane' }), motion: 'static' });
  const shape = world.createShape({ type: 'box', halfExtents: [0.5, 0.5, 0.5] });
  const bodies = [];
  scene((...position) => bodies.push({ shape, position }));
  world.createBodies(bodies);
  return world;
}
function seconds(world, steps) {
  const start = performance.now();
  for (let i = 0; i < steps; ++i) world.step(1 / 60);
  return (performance.now() - start) / 1000;
}

const alone = await load(new URL('plumb-impulse.wasm', folder));
const team = await load(new URL('plumb-impulse-threads.wasm', folder), { threads: Math.max(...counts) });
for (const [name, scene] of Object.entries(scenes)) {
  const rows = [{ name: 'plumb-impulse.wasm', world: worldOf(alone, scene, 1) },
    ...counts.map((threads) => ({ name: `${threads} threads`, world: worldOf(team, scene, threads) }))];
  for (const row of rows) {
    seconds(row.world, kWarm);
    row.best = Infinity;
  }
  for (let part = 0; part < kParts; ++part)
    for (const row of rows) row.best = Math.min(row.best, seconds(row.world, kPart) / kPart);
  for (const { name: what, best, world } of rows) {
    assert.equal(world.hash(), rows[0].world.hash(), `${what} has other bits`);
    console.log(`${name}, ${what}: ${(1000 * best).toFixed(2)} ms a step, ${(rows[0].best / best).toFixed(2)} x as fast`);
  }
  for (const { world } of rows) world.destroy();
}
team.dispose();
