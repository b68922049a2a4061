// Time and error of both engines in the same scenes, one core, nothing asleep: PLUMB_WEB=FOLDER
// node compare.mjs [SECONDS [SETTING=VALUE]...], settings of Plumb's engine
import { BallAndSocketConstraint } from '@babylonjs/core/Physics/v2/physicsConstraint.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { kStep, Stage, STATIC } from './tests/engines.mjs';

const kAlwaysActive = 1;
const seconds = Number(process.argv[2] ?? 5);
const settings = Object.fromEntries(process.argv.slice(3).map((word) => word.split('='))
  .map(([name, value]) => [name, Number.isNaN(Number(value)) ? value : Number(value)]));
const positionOf = ({ transformNode: { position } }) => position;

/** Each builds its bodies, and gives them and a measure of what is wrong in metres. */
const scenes = {
  'tower of 20, drift': (stage) => {
    stage.ground();
    const box = stage.box(), list = Array.from({ length: 20 }, (_, i) => stage.body(box, [0, 0.5 + i, 0]));
    return { list, error: driftOf(list) };
  },
  'pyramid of base 20, drift': (stage) => {
    stage.ground();
    const box = stage.box(), list = [];
    for (let row = 0; row < 20; ++row)
      for (let i = 0; i < 20 - row; ++i) list.push(stage.body(box, [1.05 * (i - 0.5 * (19 - row)), 0.5 + row, 0]));
    return { list, error: driftOf(list) };
  },
  'net of 20 x 20 balls, gap of its joints': (stage) => {
    const ball = stage.ball(0.3), list = [], joints = [], count = 20;
    for (let i = 0; i < count * count; ++i) {
      const row = Math.floor(i / count), column = i % count;
      list.push(stage.body(ball, [column, 0, row], row === 0 && column % 19 === 0 ? STATIC : undefined));
      if (column > 0) joints.push([list[i - 1], list[i], new Vector3(0.5, 0, 0)]);
      if (row > 0) joints.push([list[i - count], list[i], new Vector3(0, 0, 0.5)]);
    }
    for (const [a, b, half] of joints)
      a.addConstraint(b, new BallAndSocketConstraint(half, half.negate(), undefined, undefined, stage.scene));
    const end = ({ transformNode: { position, rotationQuaternion } }, half) =>
      half.applyRotationQuaternion(rotationQuaternion).add(position);
    return { list, error: () => Math.max(...joints.map(([a, b, half]) =>
      Vector3.Distance(end(a, half), end(b, half.negate())))) };
  },
  'pile of 1,000 balls, overlap': (stage) => {
    stage.ground();
    const side = 6, wall = stage.box(1, 40, 2 * side + 2), other = stage.box(2 * side + 2, 40, 1), ball = stage.ball();
    for (const sign of [-1, 1]) {
      stage.body(wall, [sign * (side + 0.5), 20, 0], STATIC);
      stage.body(other, [0, 20, sign * (side + 0.5)], STATIC);
    }
    const list = Array.from({ length: 1000 }, (_, i) => stage.body(ball,
      [(i % 10) * 1.1 - 5 + 0.01 * (i % 7), 1 + 1.1 * Math.floor(i / 100), (Math.floor(i / 10) % 10) * 1.1 - 5 + 0.01 * (i % 3)]));
    return { list, error: () => overlapOf(list) };
  },
};

function driftOf(list) {
  const before = list.map((body) => positionOf(body).clone());
  return () => Math.max(...list.map((body, i) => Vector3.Distance(positionOf(body), before[i])));
}
function overlapOf(list) {
  let most = 0;
  for (let i = 0; i < list.length; ++i)
    for (let j = 0; j < i; ++j) most = Math.max(most, 1 - Vector3.Distance(positionOf(list[i]), positionOf(list[j])));
  return most;
}
const medianOf = (times) => times.sort((a, b) => a - b)[Math.floor(times.length / 2)];

function measured(name, build) {
  const stage = new Stage(name, -9.81, { sleeping: false, settings });
  const { list, error } = build(stage), times = [];
  for (const body of list) stage.plugin.setActivationControl(body, kAlwaysActive);
  for (let i = 0; i < seconds / kStep; ++i) {
    const before = performance.now();
    stage.plugin.executeStep(kStep, []);
    times.push(performance.now() - before);
  }
  for (const body of list) stage.plugin.sync(body);
  const told = { time: medianOf(times), error: error() };
  stage.end();
  return told;
}

console.log(`| after ${seconds} s | Plumb, ms a step | Havok | times Havok's | Plumb, error in m | Havok |`);
console.log('|---|---|---|---|---|---|');
for (const [title, build] of Object.entries(scenes)) {
  const plumb = measured('plumb', build), havok = measured('havok', build);
  console.log(`| ${title} | ${plumb.time.toFixed(3)} | ${havok.time.toFixed(3)} | ${(plumb.time / havok.time).toFixed(2)} ` +
    `| ${plumb.error.toPrecision(2)} | ${havok.error.toPrecision(2)} |`);
}
