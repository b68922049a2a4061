// The bits of the .wasm, and what it says of mistakes: PLUMB_WEB=FOLDER node --test test_bits.mjs
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { engine, PlumbError } from './worlds.mjs';

function recorded(scene) {
  const rows = readFileSync(new URL('../hashes/recorded.inc', import.meta.url), 'utf8');
  return BigInt(rows.match(`RECORDED\\("${scene}", (0x[0-9a-f]+)`)[1]);
}

function worldOf(options) {
  const world = engine.createWorld(options);
  const ground = world.createShape({ type: 'box', halfExtents: [50, 0.5, 50] });
  world.createBody({ shape: ground, motion: 'static', position: [0, -0.5, 0] });
  return { world, cube: world.createShape({ type: 'box', halfExtents: [0.5, 0.5, 0.5] }) };
}
const needs = ['rotation', 'collision', 'friction'];

test('a tower has the bits of every other platform', () => {
  const { world, cube } = worldOf({ needs });
  for (let i = 0; i < 20; ++i) world.createBody({ shape: cube, position: [0, 0.5 + i, 0] });
  for (let i = 0; i < 300; ++i) world.step(1 / 60);
  assert.equal(world.hash(), recorded('tower-20'));
  world.destroy();
});

test('settings are those of the engine, by name', () => {
  const { world, cube } = worldOf({ needs, settings: { solver: 'si' } });
  for (let row = 0; row < 10; ++row)
    for (let i = 0; i < 10 - row; ++i)
      world.createBody({ shape: cube, position: [1.05 * (i - 0.5 * (10 - row - 1)), 0.5 + row, 0] });
  for (let i = 0; i < 300; ++i) world.step(1 / 60);
  assert.equal(world.hash(), recorded('pyramid-10-si'));
  world.destroy();
});

test('rows are read and written, rays cast, joints hold', () => {
  const { world, cube } = worldOf({ needs: [...needs, 'joints', 'queries', 'forces'] });
  const body = world.createBody({ shape: cube, position: [0, 5, 0], mass: 2 });
  assert.equal(world.bodyCount, 2);
  assert.deepEqual([...world.read('pose', [body])], [0, 5, 0, 0, 0, 0, 1]);
  assert.equal(world.read('velocity').length, 12);
  world.write('impulse', body, [2, 0, 0]);
  assert.equal(world.read('velocity', [body])[0], 1);
  const hit = world.castRay([0, 10, 0], [0, -20, 0]);
  assert.equal(hit.body, body);
  assert.ok(Math.abs(hit.position[1] - 5.5) < 1e-5);
  assert.equal(world.castRay([20, 10, 0], [0, 5, 0]), null);
  const joint = world.createJoint({ type: 'ball', b: body, frameA: { position: [0, 5, 0] } });
  for (let i = 0; i < 60; ++i) world.step(1 / 60);
  assert.ok(Math.abs(world.read('pose', [body])[1] - 5) < 1e-4);
  world.destroyJoint(joint);
  world.destroyBody(body);
  assert.equal(world.bodyCount, 1);
  world.destroy();
});

test('what is wrong is said in a sentence, and the engine goes on', () => {
  const { world, cube } = worldOf({ needs });
  const fails = (call, code, text) =>
    assert.throws(call, (error) => error instanceof PlumbError && error.code === code && text.test(error.message));
  fails(() => world.createShape({ type: 'sphere', radius: -1 }), -1, /radius/);
  fails(() => world.contacts(), -4, /reading contacts/);
  fails(() => world.events(), -4, /reading events/);
  fails(() => world.createShape({ type: 'ball', radius: 1 }), -1, /no shape "ball"; there are sphere, box/);
  fails(() => world.createBody({ shape: cube, flags: ['sensor'] }), -4, /./);
  fails(() => world.write('pose', 77n, [0, 0, 0, 0, 0, 0, 1]), -2, /./);
  fails(() => world.write('pose', 77n, [0]), -1, /a row of pose has 7 numbers, not 1/);
  fails(() => engine.createWorld({ settings: { solvr: 'si' } }), -1, /no setting "solvr"/);
  fails(() => engine.createWorld({ settings: { solver: 'best' } }), -1, /./);
  fails(() => engine.createWorld({ needs: ['speed'] }), -1, /no need "speed"/);
  world.step(1 / 60);
  world.destroy();
  fails(() => world.step(1 / 60), -1, /was destroyed/);
});
