// Threads of a .wasm in Node, and what becomes of them: PLUMB_WEB=FOLDER PLUMB_WEB_HASHES=FILE node --test test_threads.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { syncBuiltinESMExports } from 'node:module';
import { afterEach, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import worker_threads from 'node:worker_threads';
import { kStep, load, PlumbError, steps } from './worlds.mjs';

const folder = pathToFileURL(`${process.env.PLUMB_WEB}/`);
const alone = new URL('plumb-impulse.wasm', folder), shared = new URL('plumb-impulse-threads.wasm', folder);
const checks = pathToFileURL(process.env.PLUMB_WEB_HASHES); // threads_at_work.cpp is in it
const recorded = BigInt(readFileSync(new URL('../hashes/recorded.inc', import.meta.url), 'utf8')
  .match(/RECORDED\("tower-20", (0x[0-9a-f]+)/)[1]);

const kPatience = 60_000; // ms

/** Every worker that is made, by a class that a test may have changed. */
const { Worker } = worker_threads;
let made = [];
function makeWorkersBy(Class) {
  worker_threads.Worker = class extends Class {
    constructor(...given) {
      super(...given);
      made.push(this);
    }
  };
  syncBuiltinESMExports();
}
makeWorkersBy(Worker);
const { wait } = Atomics;
afterEach(() => {
  makeWorkersBy(Worker);
  made = [];
  delete globalThis.crossOriginIsolated;
  Atomics.wait = wait;
});

function towerOf(engine, options) {
  const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction'], ...options });
  const ground = world.createShape({ type: 'box', halfExtents: [50, 0.5, 50] });
  world.createBody({ shape: ground, motion: 'static', position: [0, -0.5, 0] });
  const cube = world.createShape({ type: 'box', halfExtents: [0.5, 0.5, 0.5] });
  for (let i = 0; i < 20; ++i) world.createBody({ shape: cube, position: [0, 0.5 + i, 0] });
  return world;
}
function bitsOf(engine) {
  const world = towerOf(engine);
  steps(world, 300);
  const bits = world.hash();
  world.destroy();
  return bits;
}
const says = (code, text) => (error) => error instanceof PlumbError && error.code === code && text.test(error.message);

test('worlds have as many threads as were asked for, and the recorded bits', async () => {
  for (const threads of [1, 2, 3]) {
    const engine = await load({ threads });
    assert.deepEqual([engine.info.threads, engine.info.remark, made.length], [threads, '', threads * (threads - 1) / 2]);
    const world = towerOf(engine);
    assert.equal(world.step(kStep).threads, threads);
    assert.equal(bitsOf(engine), recorded);
    engine.dispose();
  }
  const engine = await load({ threads: 'auto' });
  assert.equal(bitsOf(engine), recorded);
  engine.dispose();
});

test('threads work at once, each with its own memory, and what one throws reaches the caller', async () => {
  const engine = await load(checks, { threads: 3 });
  for (const threads of [2, 3]) {
    assert.ok(engine.wasm.test_meet(threads), `${threads} threads did not meet`);
    assert.ok(engine.wasm.test_allocate(threads));
    assert.ok(engine.wasm.test_own(threads));
    assert.throws(() => engine.check(engine.wasm.test_throw(threads)), says(-12, /thrown by a worker/));
  }
  engine.dispose();
});

test('memory that a worker took is seen by the caller', async () => {
  const engine = await load(checks, { threads: 2 });
  const size = engine.wasm.memory.buffer.byteLength, at = engine.wasm.test_grow(2);
  assert.ok(at > size);
  assert.equal(engine.memory.word(at), 42);
  engine.dispose();
});

test('a caller that may not sleep, as a page, gets the same', async () => {
  Atomics.wait = () => {
    throw new TypeError('Atomics.wait cannot be called in this context');
  };
  const engine = await load(checks, { threads: 3 });
  assert.ok(engine.wasm.test_meet(3));
  assert.ok(engine.wasm.test_allocate(3));
  assert.equal(bitsOf(engine), recorded);
  engine.dispose();
});

test('worlds and engines beside each other do not disturb each other', async () => {
  const engines = await Promise.all([load({ threads: 3 }), load({ threads: 2 }), load()]);
  const worlds = engines.flatMap((engine) => [towerOf(engine), towerOf(engine, { threads: 2 })]);
  assert.deepEqual(worlds.map((world) => world.step(kStep).threads), [3, 2, 2, 2, 1, 1]);
  for (let i = 1; i < 300; ++i) for (const world of worlds) world.step(kStep);
  assert.deepEqual(worlds.map((world) => world.hash()), worlds.map(() => recorded));
  engines[0].dispose();
  assert.equal(bitsOf(engines[1]), recorded);
  assert.throws(() => worlds[0].step(kStep), says(-1, /was disposed of/));
  assert.throws(() => engines[0].createWorld(), says(-1, /was disposed of/));
  worlds[0].destroy();
  engines[1].dispose();
});

test('workers end when the engine is disposed of', { timeout: kPatience }, async () => {
  const engine = await load({ threads: 3 });
  const ends = made.map((worker) => new Promise((ended) => worker.once('exit', ended)));
  bitsOf(engine);
  engine.dispose();
  engine.dispose();
  for (const worker of made) worker.ref();
  assert.deepEqual(await Promise.all(ends), [0, 0]);
});

test('a program ends by itself, whether it disposes of the engine or forgets it', () => {
  const program = (end) => `const { load } = await import(${JSON.stringify(new URL('plumb.mjs', folder))});
    const engine = await load({ threads: 3 });
    engine.createWorld().step(1 / 60);
    ${end}
    console.log(engine.info.threads);`;
  for (const end of ['engine.dispose();', ''])
    assert.equal(execFileSync(process.execPath, ['--input-type=module', '-e', program(end)],
      { encoding: 'utf8', timeout: kPatience }).trim(), '3');
});

test('a worker that is ended between steps is not missed', async () => {
  const engine = await load({ threads: 3 });
  await made[0].terminate();
  assert.equal(bitsOf(engine), recorded);
  await made[1].terminate();
  assert.equal(bitsOf(engine), recorded);
  engine.dispose();
});

test('a worker that dies amid its work is told, and nobody waits for it', async () => {
  const engine = await load(checks, { threads: 3 });
  const world = towerOf(engine);
  assert.throws(() => engine.wasm.test_trap(3), says(-12, /a thread of the engine died/));
  assert.throws(() => world.step(kStep), says(-1, /a thread of the engine died/));
  assert.throws(() => engine.createWorld(), says(-1, /a thread of the engine died/));
  world.destroy();
  engine.dispose();
});

test('workers that cannot start are told, and the engine does without', { timeout: kPatience }, async () => {
  makeWorkersBy(class {
    constructor() {
      throw new Error('no more workers here');
    }
  });
  let engine = await load({ threads: 3 });
  assert.equal(engine.info.threads, 1);
  assert.match(engine.info.remark, /could not be started: no more workers here/);
  assert.equal(towerOf(engine).step(kStep).threads, 1);
  assert.equal(bitsOf(engine), recorded);

  let first = true;
  makeWorkersBy(class extends Worker {
    constructor(file, options) {
      super(first ? new URL('no_such_file.mjs', file) : file, options);
      first = false;
    }
  });
  engine = await load({ threads: 3 });
  assert.equal(engine.info.threads, 2);
  assert.match(engine.info.remark, /could not be started: .*no_such_file/);
  assert.equal(bitsOf(engine), recorded);
  engine.dispose();

  makeWorkersBy(class extends Worker {
    constructor(_file, options) {
      super('process.exit(3)', { ...options, eval: true });
    }
  });
  engine = await load({ threads: 2 });
  assert.match(engine.info.remark, /could not be started: it ended/);
  assert.equal(bitsOf(engine), recorded);
});

test('where memory may not be shared there is one thread, and the reason', async () => {
  globalThis.crossOriginIsolated = false;
  const engine = await load({ threads: 2 });
  assert.equal(engine.info.threads, 1);
  assert.match(engine.info.remark, /Cross-Origin-Opener-Policy/);
  assert.equal(bitsOf(engine), recorded);
  assert.equal((await load()).info.remark, '');
  await assert.rejects(load(shared), says(-1, /Cross-Origin-Opener-Policy/));
});

test('what load is given is checked', async () => {
  for (const threads of [0, 1.5, 65, 'many', null])
    await assert.rejects(load({ threads }), says(-1, /threads is a whole number from 1 to 64 or 'auto', not/));
  const engine = await load(alone, { threads: 2 });
  assert.equal(engine.info.threads, 1);
  assert.match(engine.info.remark, /the \.wasm that was given has one thread/);
});

test('the package has every file of the build', () => {
  const { files } = JSON.parse(readFileSync(new URL('package.json', folder), 'utf8'));
  const built = readdirSync(folder).filter((name) => !['package.json', 'README.md'].includes(name));
  assert.deepEqual(built.sort(), files.sort());
});
