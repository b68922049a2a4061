import assert from 'node:assert/strict';
import { test } from 'node:test';
import { engine, grounded, kStep, positionOf, PlumbError, steps } from './worlds.mjs';

const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) < by, `${value} is not ${wanted}`);

test('contacts carry the weight, and events tell who touches', () => {
  const { world, ground, cube } = grounded(['contacts', 'contactImpulses', 'events']);
  const body = world.createBody({ shape: cube, position: [0, 0.5, 0] });
  const report = world.step(kStep);
  assert.deepEqual([report.step, report.bodies, report.awake], [1n, 2, 1]);
  assert.deepEqual(world.events().map(({ type, a, b }) => [type, a, b]), [['contactBegin', ground, body]]);
  steps(world, 60);
  const contacts = world.contacts();
  assert.equal(contacts.length, 4);
  near(contacts.reduce((all, { normalImpulse }) => all + normalImpulse, 0), 1000 * 9.81 * kStep, 0.5);
  near(Math.abs(contacts[0].normal[1]), 1, 1e-5);
  world.destroyBody(body);
  world.step(kStep);
  assert.deepEqual(world.events().map(({ type }) => type), ['contactEnd']);
  world.destroy();
});

test('a sensor tells who enters and leaves', () => {
  const { world, cube } = grounded(['sensors', 'events']);
  const gate = world.createBody({ shape: cube, motion: 'static', position: [0, 3, 0], flags: ['sensor'] });
  const body = world.createBody({ shape: cube, position: [0, 6, 0] });
  const told = [];
  for (let i = 0; i < 120; ++i) {
    world.step(kStep);
    told.push(...world.events().filter(({ type }) => type.startsWith('sensor')));
  }
  assert.deepEqual(told.map(({ type, a, b }) => [type, a, b]),
    [['sensorEnter', gate, body], ['sensorLeave', gate, body]]);
  world.destroy();
});

test('rays, casts and overlaps find bodies, and filters hide them', () => {
  const { world, ground, cube } = grounded(['queries', 'filters']);
  const body = world.createBody({ shape: cube, position: [0, 3, 0], motion: 'static', filter: { category: 4 } });
  steps(world, 1);
  const down = { origin: [0, 10, 0], translation: [0, -20, 0] };
  assert.deepEqual(world.castRays([down], { all: true })[0].map((hit) => hit.body), [body, ground]);
  assert.equal(world.castRay(down.origin, down.translation, { mask: 1 }).body, ground);
  assert.equal(world.castRays([down, { ...down, origin: [200, 10, 0] }])[1], null);
  const ball = world.createShape({ type: 'sphere', radius: 0.5 });
  const hit = world.castShape(ball, { position: [0, 8, 0] }, [0, -8, 0]);
  assert.equal(hit.body, body);
  near(hit.fraction, 4 / 8, 1e-4);
  assert.deepEqual(world.overlap(ball, { position: [0.9, 3, 0] }).map((one) => one.body), [body]);
  assert.deepEqual(world.overlap(ball, { position: [2, 3, 0] }), []);
  const rod = world.createShape({ type: 'capsule', radius: 0.25, halfHeight: 1 });
  const swing = { shape: rod, position: [0, 5.2, 0], rotation: [0, 0, 1], translation: [0, -4, 0] };
  const [swung, early] = world.castShapes([swing, { ...swing, position: [0, 50, 0] }]);
  assert.equal(swung.body, body);
  assert.ok(swung.fraction > 0.05 && swung.fraction < 0.25, `${swung.fraction}`);
  assert.equal(early, null);
  assert.throws(() => world.castShapes([{ ...swing, rotation: [0, 7, 0] }]), /at most 2 pi/);
  const [deepest, ...others] = world.penetrations(ball, { position: [0.9, 3, 0] });
  assert.deepEqual([deepest.body, others.length], [body, 0]);
  assert.ok(deepest.depth > 0 && deepest.normal[0] > 0.5, JSON.stringify(deepest.normal));
  assert.deepEqual(world.penetrations(ball, { position: [2, 3, 0] }), []);
  const touching = world.collide({ shapeA: ball, frameA: { position: [0.9, 0, 0] }, shapeB: cube });
  near(touching.distance, -0.1, 1e-3);
  assert.ok(touching.points.length > 0 && touching.points[0].normal[0] < -0.99);
  world.destroy();
});

test('a snapshot brings the same bits back', () => {
  const { world, cube } = grounded(['snapshot']);
  for (let i = 0; i < 5; ++i) world.createBody({ shape: cube, position: [0.3 * i, 0.7 + 1.2 * i, 0] });
  steps(world, 20);
  const bytes = world.save();
  steps(world, 40);
  const hash = world.hash();
  world.restore(bytes);
  assert.notEqual(world.hash(), hash);
  steps(world, 40);
  assert.equal(world.hash(), hash);
  assert.throws(() => world.restore(bytes.slice(0, 20)), (error) => error instanceof PlumbError && error.code === -11);
  world.destroy();
});

test('a snapshot of the world brings back who is gone', () => {
  const { world, cube } = grounded(['snapshot']);
  const bodies = [0, 1, 2, 3].map((i) => world.createBody({ shape: cube, position: [0.3 * i, 0.7 + 1.2 * i, 0] }));
  steps(world, 20);
  const bytes = world.saveWorld(), lived = world.bodies;
  steps(world, 40);
  const hash = world.hash();
  world.destroyBody(bodies[1], bodies[2]);
  const comer = world.createBody({ shape: cube, position: [5, 5, 5] });
  steps(world, 10);
  assert.throws(() => world.restore(world.save().slice(0, 20)), (error) => error instanceof PlumbError && error.code === -11);
  world.restore(bytes);
  assert.deepEqual(world.bodies, lived);
  assert.throws(() => world.destroyBody(comer), (error) => error instanceof PlumbError);
  steps(world, 40);
  assert.equal(world.hash(), hash);
  world.destroy();
});

test('settings are listed, read and set', () => {
  const solver = engine.settings.find(({ name }) => name === 'solver');
  assert.ok(solver.type === 'choice' && solver.choices.includes(solver.default));
  const { world } = grounded([], { settings: { solver: 'si' } });
  assert.equal(world.getSetting('solver'), 'si');
  const other = engine.settings.find(({ type, creationOnly }) => type === 'int' && !creationOnly);
  world.setSetting(other.name, other.minimum);
  assert.equal(world.getSetting(other.name), other.minimum);
  assert.throws(() => world.setSetting('solvr', 1), /no setting "solvr"; there are /);
  world.destroy();
});

test('what the engine can is told', () => {
  assert.equal(engine.capability('shape', 'mesh', 0), 'native');
  assert.notEqual(engine.capability('joint', 'generic'), 'none');
  assert.throws(() => engine.capability('shape', 'cone'), /there is no shape "cone"/);
});
