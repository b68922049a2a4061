// Opening bundles: bytes, quantisation, orientations, ragged lists.
import assert from 'node:assert/strict';
import test from 'node:test';
import { decodeBundle, parseBundle } from '../../harness/viewer/src/data/bundle.js';
import { kPose, Replay } from '../../harness/viewer/src/data/replay.js';
import { base64, encode, quaternion, ragged, replay, tower } from './synthetic.mjs';

const rotate = ([x, y, z, w], [a, b, c]) => {
  const tx = 2 * (y * c - z * b),
    ty = 2 * (z * a - x * c),
    tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
};

test('a bundle goes through base64 and zlib and comes back', async () => {
  const { header, sections } = await decodeBundle(base64(tower('alpha', { height: 3, frames: 5 })));
  assert.equal(header.backend, 'alpha');
  assert.deepEqual(header.moving, [1, 2, 3]);
  assert.equal(sections.times.length, 5);
  assert.ok(sections.positions instanceof Uint16Array);
  assert.equal(sections.positions.length, 5 * 3 * 3);
});

test('sections that are not aligned are read all the same', () => {
  const bytes = encode(
    { bodies: [] },
    { times: ['f32', [0, 0.5]], first: ['u8', [1, 2, 3]], second: ['u32', [7, 70000]] },
  );
  const shifted = new Uint8Array(bytes.length + 1);
  shifted.set(bytes, 1);
  const { sections } = parseBundle(shifted.subarray(1));
  assert.deepEqual([...sections.first], [1, 2, 3]);
  assert.deepEqual([...sections.second], [7, 70000]);
  assert.deepEqual([...sections.times], [0, 0.5]);
});

test('what is no bundle is refused in words', () => {
  const good = tower('alpha', { height: 2, frames: 3 });
  assert.throws(() => parseBundle(new Uint8Array(40)), /no replay bundle/);
  assert.throws(() => parseBundle(good.slice(0, good.length - 64)), /cut off/);
  const later = good.slice();
  later[4] = 9;
  assert.throws(() => parseBundle(later), /version 9/);
});

/** One body on a spiral that turns as it goes. */
function spiral(quantised) {
  const pose = (f) => [3 * Math.sin(f / 5), f / 10, -40 + 2 * f, ...quaternion([1, 2, 3], f / 3)];
  const bytes = replay({
    scene: 's',
    backend: 'b',
    shapes: [{ type: 'sphere', radius: 1 }],
    bodies: [{ name: 'ball', shape: 0, motion: 'dynamic' }],
    frames: 40,
    pose,
    quantised,
  });
  return { replay: new Replay(parseBundle(bytes)), pose };
}

test('quantised positions are within half a step of the true ones, floats exact', () => {
  for (const quantised of [true, false]) {
    const { replay: spin, pose } = spiral(quantised);
    for (let f = 0; f < spin.frames; ++f) {
      for (let axis = 0; axis < 3; ++axis) {
        const most = quantised ? 0.5 * spin.step[axis] + 1e-6 : 4e-6;
        assert.ok(Math.abs(spin.coordinate(f, 0, axis) - pose(f)[axis]) <= most, `frame ${f}, axis ${axis}`);
      }
    }
  }
});

test('orientations come back as the rotations that they were', () => {
  const { replay: spin, pose } = spiral(true);
  for (let f = 0; f < spin.frames; ++f) {
    spin.sample(spin.times[f]);
    const got = rotate(spin.poses.subarray(3, 7), [1, -2, 0.5]),
      want = rotate(pose(f).slice(3), [1, -2, 0.5]);
    assert.ok(Math.hypot(...got.map((v, k) => v - want[k])) < 3e-4, `frame ${f}`);
  }
});

test('between frames positions go straight and rotations the short way', () => {
  // q and -q are one rotation.
  const pose = (f) => [f, 0, 0, ...quaternion([0, 1, 0], f * 0.2).map((v) => (f % 2 ? -v : v))];
  const bytes = replay({
    scene: 's',
    backend: 'b',
    shapes: [],
    bodies: [{ name: 'a', shape: null, motion: 'dynamic' }],
    frames: 4,
    rate: 1,
    pose,
    quantised: false,
  });
  const spin = new Replay(parseBundle(bytes));
  spin.sample(1.5);
  assert.equal(spin.frame, 1);
  assert.ok(Math.abs(spin.poses[0] - 1.5) < 1e-6);
  const turned = rotate(spin.poses.subarray(3, kPose), [1, 0, 0]);
  assert.ok(Math.hypot(turned[0] - Math.cos(0.3), turned[2] + Math.sin(0.3)) < 1e-4);
  assert.ok(Math.abs(Math.hypot(...spin.poses.subarray(3, 7)) - 1) < 1e-6);
});

test('time is clamped to the frames, and frames are found by time', () => {
  const { replay: spin } = spiral(true);
  spin.sample(-5);
  assert.equal(spin.frame, 0);
  assert.ok(Math.abs(spin.poses[2] + 40) < 1e-2);
  spin.sample(1e9);
  assert.equal(spin.frame, spin.frames - 1);
  assert.ok(Math.abs(spin.poses[2] - 38) < 1e-2);
  for (const f of [0, 1, 7, 38]) assert.equal(spin.frameAt(spin.times[f]), f);
});

test('ragged lists give each frame its rows', () => {
  const list = ragged([[1, 2], [], [3, 4, 5]]),
    pose = () => [0, 0, 0, 0, 0, 0, 1];
  const bytes = replay({
    scene: 's',
    backend: 'b',
    shapes: [],
    bodies: [{ name: 'a', shape: null, motion: 'dynamic' }],
    frames: 3,
    rate: 1,
    pose,
    quantised: false,
    extra: { 'axes/start': ['u32', list.start], 'axes/body_a': ['u32', list.rows] },
  });
  const spin = new Replay(parseBundle(bytes)),
    rows = [];
  for (let f = 0; f < 3; ++f) {
    spin.sample(f);
    rows.push([...spin.sections['axes/body_a'].subarray(spin.first('axes'), spin.first('axes', 1))]);
  }
  assert.deepEqual(rows, [[1, 2], [], [3, 4, 5]]);
  assert.equal(spin.first('contacts', 1), 0);
});
