// How far a joint is from what it demands, from the poses of its bodies alone, as the referee has it
// (referee/joints.hpp, which says by type what counts).
import { rotationOf } from './accounts.js';

const kAxes = ['x', 'y', 'z', 'angularX', 'angularY', 'angularZ'];
const kWorld = [0, 0, 0, 0, 0, 0, 1];
const kTurn = 2 * Math.PI;
/** Axes whose limits count. */
const kLimited = {
  ball: [3, 4, 5],
  hinge: [3],
  slider: [0],
  distance: [0],
  universal: [3, 4],
  swing_twist: [3],
};
const kFreeTurns = { hinge: 0b001, universal: 0b011 };

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const apply = (r, [x, y, z]) => [
  r[0] * x + r[1] * y + r[2] * z,
  r[3] * x + r[4] * y + r[5] * z,
  r[6] * x + r[7] * y + r[8] * z,
];
const applyInverse = (r, [x, y, z]) => [
  r[0] * x + r[3] * y + r[6] * z,
  r[1] * x + r[4] * y + r[7] * z,
  r[2] * x + r[5] * y + r[8] * z,
];
const column = (r, c) => [r[c], r[c + 3], r[c + 6]];
const product = (a, b) => {
  const out = new Array(9);
  for (let i = 0; i < 9; i += 3)
    for (let c = 0; c < 3; ++c) out[i + c] = a[i] * b[c] + a[i + 1] * b[c + 3] + a[i + 2] * b[c + 6];
  return out;
};
const inverseProduct = (a, b) => product([a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]], b);
const angleBetween = (a, b) => Math.atan2(Math.hypot(...cross(a, b)), dot(a, b));
const sine = (x) => Math.asin(Math.min(Math.max(x, -1), 1));

/** {at, r}: a frame of a body in the world. */
function frameInWorld(poses, p, frame) {
  const r = rotationOf(poses[p + 3], poses[p + 4], poses[p + 5], poses[p + 6]);
  frame.turn ??= rotationOf(...frame.orientation);
  return { at: apply(r, frame.position).map((x, i) => x + poses[p + i]), r: product(r, frame.turn) };
}

/** Of a rotation, from half the vector that its antisymmetric part is and its trace. */
function wholeAngle(r) {
  const [x, y, z] = [r[7] - r[5], r[2] - r[6], r[3] - r[1]];
  return Math.atan2(Math.hypot(x, y, z), r[0] + r[4] + r[8] - 1);
}

function turnsOf(r, free) {
  const m = (i, j) => r[3 * i + j];
  const about = (i, j, k) => {
    const turns = [0, 0, 0],
      unit = [0, 0, 0];
    unit[i] = 1;
    turns[i] = Math.atan2(m(k, j) - m(j, k), m(j, j) + m(k, k));
    turns[j] = angleBetween(unit, column(r, i));
    return turns;
  };
  switch (free) {
    case 0b001:
      return about(0, 1, 2);
    case 0b010:
      return about(1, 2, 0);
    case 0b100:
      return about(2, 0, 1);
    case 0b011:
      return [Math.atan2(m(2, 1), m(1, 1)), Math.atan2(m(0, 2), m(0, 0)), sine(-m(0, 1))];
    case 0b101:
      return [Math.atan2(-m(1, 2), m(2, 2)), sine(m(0, 2)), Math.atan2(-m(0, 1), m(0, 0))];
    case 0b110:
      return [sine(-m(1, 2)), Math.atan2(m(0, 2), m(2, 2)), Math.atan2(m(1, 0), m(1, 1))];
    default:
      return [
        Math.atan2(-m(1, 2), m(2, 2)),
        Math.atan2(m(0, 2), Math.hypot(m(1, 2), m(2, 2))),
        Math.atan2(-m(0, 1), m(0, 0)),
      ];
  }
}

/** The twist about x, then the y and z of the swing's vector. */
function swingTwistOf(r) {
  const x = [1, 0, 0],
    across = cross(x, column(r, 0)),
    length = Math.hypot(...across),
    angle = angleBetween(x, column(r, 0)),
    about = length > 0 ? across.map((part) => part / length) : [0, 1, 0];
  const back = [...about.map((part) => part * Math.sin(-angle / 2)), Math.cos(angle / 2)],
    twist = product(rotationOf(...back), r);
  return [Math.atan2(twist[7], twist[4]), angle * about[1], angle * about[2]];
}

const beyond = ([lower, upper], value) => Math.max(0, lower - value, value - upper);
/** Poses do not tell how often it has gone round. */
const turnedBeyond = (limit, angle) => Math.min(...[-kTurn, 0, kTurn].map((turn) => beyond(limit, angle + turn)));

/** How far b's x axis is beyond the cone, along its meridian. */
function beyondCone([, halfY], [, halfZ], y, z) {
  const angle = Math.hypot(y, z);
  return angle > 0 ? Math.max(0, angle - angle / Math.hypot(y / halfY, z / halfZ)) : 0;
}

/** m and rad by which the joint is open, limits included; the gap is NaN where a spring alone holds the distance.
 *  joint: of the world as the harness wrote it. Poses are rows of all bodies. */
export function jointError(joint, poses) {
  const a =
      joint.a === undefined ? frameInWorld(kWorld, 0, joint.frameA) : frameInWorld(poses, 7 * joint.a, joint.frameA),
    b = frameInWorld(poses, 7 * joint.b, joint.frameB);
  const r = inverseProduct(a.r, b.r),
    gap = applyInverse(
      a.r,
      b.at.map((x, i) => x - a.at[i]),
    );
  const { type, limits, springs, axes } = joint,
    locked = (axis) => axes[kAxes[axis]] === 'locked';
  let free = kFreeTurns[type] ?? 0b111;
  if (type === 'generic') free = [0, 1, 2].reduce((bits, i) => (locked(3 + i) ? bits : bits | (1 << i)), 0);
  const at = [...gap, ...(type === 'swing_twist' ? swingTwistOf(r) : turnsOf(r, free))];
  let position = Math.hypot(...gap),
    angle = 0,
    limited = kLimited[type] ?? [];
  if (type === 'hinge') angle = at[4];
  else if (type === 'slider') {
    position = Math.hypot(gap[1], gap[2]);
    angle = wholeAngle(r);
  } else if (type === 'distance') {
    at[0] = position;
    const held = !limits.x && !springs.x;
    position = held ? Math.abs(at[0] - joint.restLength) : 0;
    if (springs.x && !limits.x) position = NaN;
  } else if (type === 'fixed') angle = wholeAngle(r);
  else if (type === 'universal') angle = Math.abs(at[5]);
  else if (type === 'swing_twist') {
    if (limits.angularY) angle = beyondCone(limits.angularY, limits.angularZ, at[4], at[5]);
  } else if (type === 'generic') {
    position = Math.hypot(...[0, 1, 2].map((axis) => (locked(axis) ? at[axis] : 0)));
    angle = free === 0 ? wholeAngle(r) : Math.max(...[3, 4, 5].map((axis) => (locked(axis) ? Math.abs(at[axis]) : 0)));
    limited = kAxes.flatMap((name, axis) => (axes[name] === 'limited' ? [axis] : []));
  } else if (type === 'gear' || type === 'rack_and_pinion') position = 0; // which hold no places
  for (const axis of limited) {
    const limit = limits[kAxes[axis]];
    if (!limit) continue;
    if (axis < 3) position = Math.max(position, beyond(limit, at[axis]));
    else angle = Math.max(angle, turnedBeyond(limit, at[axis]));
  }
  return { gap: position, angle };
}
