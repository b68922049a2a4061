// What the reader sees in numbers and colours: maps, quantities, curves, ranges, the clock, the matrix of pairs.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Clock } from '../../harness/viewer/src/clock.js';
import { forceMap, penetrationMap } from '../../harness/viewer/src/basics/colour.js';
import { curvePath, valueRange } from '../../harness/viewer/src/curves.js';
import { kLayers, missingEverywhere } from '../../harness/viewer/src/layers/layers.js';
import { kLevels, Pace } from '../../harness/viewer/src/pace.js';
import { kindsOf, pairOf } from '../../harness/viewer/src/pairs.js';
import { quantity } from '../../harness/viewer/src/data/quantity.js';
import { upperRange } from '../../harness/viewer/src/ranges.js';

test('equal steps of a colour map look equal, and its lightness only grows', () => {
  for (const map of [penetrationMap, forceMap]) {
    const steps = [];
    for (let i = 3; i < map.lab.length; i += 3) {
      steps.push(
        Math.hypot(map.lab[i] - map.lab[i - 3], map.lab[i + 1] - map.lab[i - 2], map.lab[i + 2] - map.lab[i - 1]),
      );
      assert.ok(map.lab[i] > map.lab[i - 3]);
    }
    assert.ok(Math.max(...steps) / Math.min(...steps) < 1.1, `${Math.min(...steps)} to ${Math.max(...steps)}`);
  }
});

test('quantities have three digits and a prefix', () => {
  assert.equal(quantity(0.00125, 'm'), '1.25 mm');
  assert.equal(quantity(-36700, 'N'), '\u221236.7 kN');
  assert.equal(quantity(0, 'J'), '0 J');
  assert.equal(quantity(4, '1'), '4.00');
  assert.equal(quantity(NaN, 'J'), 'no number');
  assert.equal(quantity(0.9999, 'm'), '1.00 m');
});

test('a curve keeps its peaks when it has more frames than columns, and leaves gaps for what is no number', () => {
  const times = Float32Array.from({ length: 5000 }, (_, i) => i),
    values = new Float32Array(5000);
  values[2503] = 7;
  assert.deepEqual(valueRange(values), { low: 0, high: 7 });
  assert.match(curvePath(times, values, { begin: 0, end: 4999 }, { low: 0, high: 7 }), /L\d+\.\d 0\.00/);
  const broken = curvePath(
    Float32Array.of(0, 1, 2, 3),
    Float32Array.of(1, NaN, 2, 3),
    { begin: 0, end: 3 },
    { low: 1, high: 3 },
  );
  assert.equal(broken.match(/M/g).length, 2);
});

test('one wild value does not take the whole scale', () => {
  const values = new Float32Array(10000).fill(1);
  values[77] = 1e9;
  values[78] = NaN;
  assert.equal(upperRange([values, undefined], 1e-9), 1);
  assert.equal(upperRange([new Float32Array(3)], 1e-9), 1e-9);
});

test('the clock plays, rests at the end, begins anew or stops', () => {
  const clock = new Clock();
  clock.setRange(0, 2);
  clock.play();
  clock.tick(1.5);
  assert.equal(clock.shown, 1.5);
  clock.tick(0.7);
  assert.equal(clock.shown, 2);
  clock.tick(0.5);
  assert.equal(clock.shown, 0);
  clock.loop = false;
  clock.tick(5);
  assert.deepEqual([clock.shown, clock.playing], [2, false]);
  clock.play();
  assert.equal(clock.shown, 0);
  clock.seek(-3);
  assert.equal(clock.time, 0);
});

test('pairs of shapes make a triangle', () => {
  assert.deepEqual(pairOf('pair height_field-box'), ['height_field', 'box']);
  assert.equal(pairOf('D1 H=10'), null);
  const kinds = ['sphere', 'box', 'hull'],
    pairs = kinds.flatMap((b, i) => [...kinds.slice(i), 'plane'].map((a) => [a, b]));
  assert.deepEqual(kindsOf(pairs), ['sphere', 'box', 'hull', 'plane']);
});

test('slow frames give something up, step by step; fast ones and a pause nothing', () => {
  const pace = new Pace(),
    frames = (count, seconds) => Array.from({ length: count }, () => pace.late(seconds)).filter(Boolean).length;
  assert.equal(frames(200, 1 / 60), 0);
  assert.equal(frames(50, 30), 0);
  assert.ok(frames(12, 0.2) === 1 && pace.level === 1);
  frames(500, 0.2);
  assert.equal(pace.level, kLevels);
});

test('a layer that nobody recorded has one reason for all', () => {
  const replay = (backend, without) => ({ header: { backend, recorded: { without } }, has: () => false, sections: {} });
  const islands = kLayers.find(({ name }) => name === 'islands');
  assert.equal(missingEverywhere(islands, [replay('alpha'), replay('beta')]), 'no engine recorded islands');
  assert.equal(
    missingEverywhere(islands, [replay('alpha', { islands: 'has none' }), replay('beta')]),
    'has none; beta did not record islands',
  );
});
