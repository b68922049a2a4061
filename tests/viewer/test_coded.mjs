// Coded bundles as the program writes them: poses within the bounds that they state, lists row by row.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import test from 'node:test';
import { decodeBundle } from '../../harness/viewer/src/data/bundle.js';
import { kPose, Replay } from '../../harness/viewer/src/data/replay.js';

const kFrames = 300,
  kBroken = 100; // frame from which the first joint is gone

/** The formulas of sample_bundle.cpp. */
function poseOf(frame, body) {
  const t = frame / 60,
    a = 5 * Math.sin(t),
    b = 3 * t;
  if (body === 0) return [0.3 * t, t < 1 ? 6 - 4.905 * t * t : 1.095, -2, 0, 0, 0, 1];
  if (body === 1)
    return [
      ...[0, 0, 1],
      Math.sin(a) * Math.cos(b),
      Math.sin(a) * Math.sin(b),
      Math.cos(a) * Math.sin(2 * b),
      Math.cos(a) * Math.cos(2 * b),
    ];
  return [frame === 7 ? NaN : 1e8, 0, 0, 0, Math.sin(t), 0, -Math.cos(t)];
}

const bundle = () => decodeBundle(execFileSync(process.env.PLUMB_SAMPLE_BUNDLE, { encoding: 'utf8' }));

test('poses come back within what the bundle states', async () => {
  const opened = await bundle(),
    replay = new Replay(opened),
    { position, angle } = opened.header.bounds;
  assert.ok(position > 0 && position <= 1.001 / 512 && angle === 1e-3);
  assert.equal(replay.frames, kFrames);
  let worst = 0,
    worstAngle = 0;
  for (let f = 0; f < kFrames; ++f) {
    replay.sample(replay.times[f]);
    assert.equal(replay.frame, f);
    for (let body = 0; body < 3; ++body) {
      const want = poseOf(f, body),
        got = replay.poses.subarray(body * kPose, (body + 1) * kPose);
      if (body < 2) for (let i = 0; i < 3; ++i) worst = Math.max(worst, Math.abs(got[i] - want[i]));
      else if (f === 7) assert.ok(Number.isNaN(got[0]), 'what is no number stays none');
      else if (f < 6 || f > 8) assert.equal(got[0], 1e8);
      const [x, y, z, w] = got.subarray(3),
        [p, q, r, s] = want.slice(3);
      // The vector part of want times the inverse of got: sin of half the angle between them.
      const across = Math.hypot(
        x * s - w * p + y * r - z * q,
        y * s - w * q + z * p - x * r,
        z * s - w * r + x * q - y * p,
      );
      worstAngle = Math.max(worstAngle, 2 * Math.asin(Math.min(1, across)));
    }
  }
  assert.ok(worst <= position + 1e-6, `${worst} m`); // and the last bit of a float32
  assert.ok(worstAngle <= angle + 1e-4, `${worstAngle} rad`); // and the steps of 1/32767
});

test('joints have their rows frame by frame, and one that broke has none', async () => {
  const replay = new Replay(await bundle()),
    { sections } = replay;
  for (let f = 0; f < kFrames; ++f) {
    replay.sample(replay.times[f]);
    const rows = [];
    for (let row = replay.first('joints'); row < replay.first('joints', 1); ++row)
      rows.push([sections['joints/joint'][row], sections['joints/gap'][row]]);
    assert.deepEqual(
      rows.map(([joint]) => joint),
      f < kBroken ? [0, 1, 2] : [1, 2],
    );
    for (const [joint, gap] of rows) {
      const want = (0.1 * (joint + 1)) / (f + 1);
      assert.ok(
        joint === 2 ? Number.isNaN(gap) : Math.abs(gap / want - 1) < 1.5e-3,
        `frame ${f}, joint ${joint}: ${gap}`,
      );
    }
  }
});
