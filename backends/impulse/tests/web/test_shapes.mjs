import assert from 'node:assert/strict';
import { test } from 'node:test';
import { engine, grounded, positionOf, steps } from './worlds.mjs';

const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) < by, `${value} is not ${wanted}`);

test('a compound has the mass of its children, and lies on the lowest', () => {
  const { world } = grounded();
  const half = world.createShape({ type: 'box', halfExtents: [0.5, 0.25, 0.5] });
  const shape = world.createShape({ type: 'compound',
    children: [{ shape: half, position: [-1, 0, 0] }, { shape: half, position: [1, 0, 0] }] });
  const body = world.createBody({ shape, position: [0, 0.3, 0], density: 100 });
  near(world.read('mass', [body])[0], 2 * 100 * 0.5, 1e-4);
  steps(world, 120);
  near(positionOf(world, body)[1], 0.25, 5e-3);
  world.destroy();
});

test('a ball comes to rest in the valley of a height field', () => {
  const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction', 'queries'] });
  const heights = Array.from({ length: 9 * 5 }, (_, i) => 0.25 * Math.abs((i % 9) - 4));
  const field = world.createShape({ type: 'heightField', rows: 5, columns: 9, heights, spacing: [1, 2] });
  world.createBody({ shape: field, motion: 'static' });
  const ball = world.createBody({ shape: world.createShape({ type: 'sphere', radius: 0.5 }), position: [1.5, 1, 0.2],
    friction: 0.5 });
  steps(world, 600);
  const [x, y, z] = positionOf(world, ball);
  near(x, 0, 0.25);
  near(y, 0.5 * Math.sqrt(1 + 0.25 ** 2), 0.02);
  near(z, 0.2, 0.2);
  const heightAt = (atX, atZ) => world.castRay([atX, 3, atZ], [0, -6, 0])?.position[1];
  near(heightAt(3, 3.9), 0.75, 1e-4);
  assert.equal(heightAt(4.1, 0), undefined);
  assert.equal(heightAt(3, 4.1), undefined);
  world.destroy();
});

test('a pit opens in a height field, and in a mesh', () => {
  const spots = Array.from({ length: 81 }, (_, i) => [i % 9 - 4, Math.floor(i / 9) - 4]);
  const cells = spots.flatMap(([x, z], i) => x < 4 && z < 4 ? [i, i + 9, i + 1, i + 1, i + 9, i + 10] : []);
  const field = (height) => ({ type: 'heightField', rows: 9, columns: 9, heights: spots.map(height), spacing: [1, 1] });
  const mesh = (height) =>
    ({ type: 'mesh', vertices: spots.flatMap((spot) => [spot[0], height(spot), spot[1]]), indices: cells });
  for (const ground of [field, mesh]) {
    const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction'] });
    const shape = world.createShape(ground(() => 0));
    world.createBody({ shape, motion: 'static' });
    const ball = world.createBody({ shape: world.createShape({ type: 'sphere', radius: 0.5 }), position: [0, 0.5, 0] });
    steps(world, 30);
    world.modifyShape(shape, ground(([x, z]) => Math.max(Math.abs(x), Math.abs(z)) < 2 ? -1 : 0));
    steps(world, 120);
    near(positionOf(world, ball)[1], -0.5, 0.01);
    assert.throws(() => world.modifyShape(shape, { type: 'sphere', radius: 1 }), /type is sphere/);
    world.destroy();
  }
});

test('shapes are made from bytes that were cooked', () => {
  const spots = Array.from({ length: 81 }, (_, i) => [i % 9 - 4, Math.floor(i / 9) - 4]);
  const indices = spots.flatMap(([x, z], i) => x < 4 && z < 4 ? [i, i + 9, i + 1, i + 1, i + 9, i + 10] : []);
  const ground = { type: 'mesh', vertices: spots.flatMap(([x, z]) => [x, 0.1 * x * z, z]), indices };
  const cube = { type: 'box', halfExtents: [0.3, 0.3, 0.3] };
  const poured = (shapes) => {
    const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction'] });
    const [below, above] = shapes(world);
    world.createBody({ shape: below, motion: 'static' });
    const body = world.createBody({ shape: above, position: [0.3, 1, 0.2] });
    steps(world, 90);
    const pose = [...world.read('pose', [body])];
    world.destroy();
    return pose;
  };
  assert.equal(engine.capability('cooking', 'mesh'), 'native');
  const bytes = [ground, cube].map((shape) => engine.cook(shape));
  assert.deepEqual(engine.cook(ground), bytes[0]);
  assert.deepEqual(poured((world) => world.createCooked(bytes)), poured((world) => world.createShapes([ground, cube])));
  const world = engine.createWorld();
  assert.throws(() => world.createCooked([bytes[0].slice(0, 99)]), /shapes\[0\].data has 99 bytes, less than the header/);
  assert.throws(() => engine.cook({ type: 'sphere', radius: 0 }), /desc\[0\].radius is 0/);
  world.destroy();
});

test('triangles have their own materials', () => {
  const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction'] });
  assert.equal(engine.capability('triangleMaterial', 'heightField'), 'native');
  const field = world.createShape({ type: 'heightField', rows: 2, columns: 3, heights: Array(6).fill(0), spacing: [20, 40],
    materials: [{ friction: 0 }, { friction: 1 }], triangleMaterials: [0, 0, -1, -1] });
  world.createBody({ shape: field, motion: 'static', friction: 0.5 });
  const shape = world.createShape({ type: 'box', halfExtents: [0.5, 0.25, 0.5] });
  const [ice, ground] = world.createBodies([-15, 5].map((x) =>
    ({ shape, position: [x, 0.25, 1], linearVelocity: [2, 0, 0], friction: 0.5 })));
  steps(world, 60);
  near(world.read('velocity', [ice])[0], 2, 1e-3);
  near(world.read('velocity', [ground])[0], 0, 1e-3);
  assert.throws(() => world.createShape({ type: 'heightField', rows: 2, columns: 2, heights: [0, 0, 0, 0], spacing: [1, 1],
    materials: [{}], triangleMaterials: [0, 1] }), /triangle_materials\[1\] is 1/);
  world.destroy();
});

test('a ball rolls to a stop where it has rolling friction', () => {
  const { world } = grounded(['rollingFriction']);
  const shape = world.createShape({ type: 'sphere', radius: 0.5 });
  const [rolls, stops] = world.createBodies([0, 0.05].map((rollingFriction, i) =>
    ({ shape, position: [0, 0.5, 3 * i], linearVelocity: [1, 0, 0], angularVelocity: [0, 0, -2], rollingFriction,
      spinningFriction: 0.25 })));
  assert.deepEqual([...world.read('rollingFriction', [stops])].map((x) => Number(x.toFixed(4))), [0.05, 0.25]);
  steps(world, 120);
  near(world.read('velocity', [rolls])[0], 1, 1e-3);
  near(world.read('velocity', [stops])[0], 0, 1e-3);
  world.write('rollingFriction', [rolls], [0.05, 0]);
  steps(world, 120);
  near(world.read('velocity', [rolls])[0], 0, 1e-3);
  world.destroy();
});

test('filters and excluded pairs let bodies through', () => {
  const { world, ground, cube } = grounded(['filters']);
  const [lies, falls, excluded] = world.createBodies([
    { shape: cube, position: [0, 0.5, 0], filter: { category: 2 } },
    { shape: cube, position: [3, 0.5, 0], filter: { category: 2, mask: 2 } },
    { shape: cube, position: [6, 0.5, 0] }]);
  world.setPairTouches(ground, excluded, false);
  steps(world, 30);
  near(positionOf(world, lies)[1], 0.5, 1e-2);
  assert.ok(positionOf(world, falls)[1] < 0 && positionOf(world, excluded)[1] < 0);
  assert.deepEqual([...world.read('filter', [falls])], [2, 2, 0]);
  world.destroy();
});

test('a belt carries what lies on it', () => {
  const { world, ground, cube } = grounded(['surfaceVelocity']);
  const body = world.createBody({ shape: cube, position: [0, 0.5, 0] });
  world.write('surfaceVelocity', ground, [2, 0, 0]);
  steps(world, 120);
  near(world.read('velocity', [body])[0], 2, 0.02);
  world.destroy();
});

test('contacts are seen before they are solved, and changed', () => {
  const { world, ground, cube } = grounded(['contactModification']);
  const [through, slides] = world.createBodies([
    { shape: cube, position: [0, 0.5, 0], flags: ['modifyContacts'] },
    { shape: cube, position: [5, 0.5, 0], flags: ['modifyContacts'], linearVelocity: [2, 0, 0] }]);
  let seen = 0;
  for (let i = 0; i < 15; ++i)
    world.step(1 / 60, (manifolds) => manifolds.map(({ a, b, normal, points }, manifold) => {
      ++seen;
      assert.ok(a === ground || b === ground);
      near(Math.abs(normal[1]), 1, 1e-3);
      assert.ok(points.length > 0 && points.length <= 4 && points.every(({ position }) => Math.abs(position[1]) < 0.3));
      return a === through || b === through ? { manifold, disabled: true } : { manifold, friction: 0 };
    }));
  assert.ok(seen > 15);
  assert.ok(positionOf(world, through)[1] < 0.3);
  near(world.read('velocity', [slides])[0], 2, 1e-3);
  assert.throws(() => world.step(1 / 60, () => [{ manifold: 99, disabled: true }]), /manifold is 99/);
  assert.throws(() => world.step(1 / 60, () => [{ manifold: 0 }]), /nothing that can change is among manifold/);
  world.step(1 / 60);
  world.destroy();
});

test('bodies are listed, keep what the page gave them, and become others', () => {
  const { world, ground, cube } = grounded();
  const body = world.createBody({ shape: cube, position: [0, 3, 0], userData: { name: 'crate' } });
  assert.deepEqual(world.bodies, [ground, body]);
  assert.equal(world.userData(body).name, 'crate');
  world.modifyBody(body, { motion: 'static' });
  steps(world, 30);
  near(positionOf(world, body)[1], 3, 1e-9);
  world.modifyBody(body, { motion: 'dynamic', mass: 7 });
  assert.equal(world.read('mass', [body])[0], 7);
  steps(world, 120);
  near(positionOf(world, body)[1], 0.5, 1e-2);
  assert.throws(() => world.modifyBody(body, { colour: 3 }), /nothing that can change is among colour/);
  world.destroyBody(body);
  assert.equal(world.userData(body), undefined);
  world.destroy();
});
