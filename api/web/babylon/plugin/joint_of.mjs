// The engine's joints for a constraint: a named one where its axes are those of one, else a generic one.
import { quatOfAxes, rowOf } from './values.mjs';

const BALL = 1, DISTANCE = 2, HINGE = 3, SLIDER = 4, LOCK = 5, PRISMATIC = 6, SIX_DOF = 7;
const FREE = 0, LIMITED = 1, LOCKED = 2;
const VELOCITY = 1, POSITION = 2;
const LINEAR_DISTANCE = 6;
const kNames = ['x', 'y', 'z', 'angularX', 'angularY', 'angularZ'];
const kFreeAxes = { [BALL]: [3, 4, 5], [DISTANCE]: [0, 1, 2, 3, 4, 5], [HINGE]: [3], [SLIDER]: [0, 3], [LOCK]: [],
  [PRISMATIC]: [0], [SIX_DOF]: [0, 1, 2, 3, 4, 5] };
const kUnbounded = 1e6, kStrong = 1e9;
/** Of a motor that is to reach a position. */
const kServo = { frequency: 8, dampingRatio: 1 };

/** The seven axes of a new constraint. */
export function axesOf({ type, options, limits = [] }) {
  const axes = Array.from({ length: 7 }, (_, axis) =>
    ({ mode: axis === LINEAR_DISTANCE || kFreeAxes[type].includes(axis) ? FREE : LOCKED, friction: 0, motorType: 0 }));
  if (type === DISTANCE) Object.assign(axes[LINEAR_DISTANCE], { mode: LIMITED, min: 0, max: options.maxDistance ?? 0 });
  for (const { axis, minLimit, maxLimit } of type === SIX_DOF ? limits : [])
    Object.assign(axes[axis], minLimit === 0 && maxLimit === 0 ? { mode: LOCKED }
      : { mode: LIMITED, min: minLimit, max: maxLimit });
  return axes;
}

export function jointsOf({ type, options, limits = [] }, axes, warn) {
  if (limits.some(({ stiffness, damping }) => stiffness || damping))
    warn('limits are hard, whatever stiffness and damping say');
  const frames = { frameA: frameOf(options.pivotA, options.axisA, options.perpAxisA),
    frameB: frameOf(options.pivotB, options.axisB, options.perpAxisB) };
  const six = axes.slice(0, 6), joints = [];
  if (type !== DISTANCE || six.some(({ mode }) => mode !== FREE)) joints.push({ ...frames, ...jointOf(six, warn) });
  if (axes[LINEAR_DISTANCE].mode !== FREE) {
    const { mode, min = 0, max = kUnbounded } = axes[LINEAR_DISTANCE];
    joints.push({ ...frames, type: 'distance', restLength: 0, limits: { x: mode === LOCKED ? [0, 0] : [min, max] } });
  }
  return joints;
}

function frameOf(pivot, axis, perpendicular) {
  return { position: pivot ? rowOf(pivot) : [0, 0, 0],
    orientation: quatOfAxes(axis ? rowOf(axis) : [1, 0, 0], perpendicular ? rowOf(perpendicular) : [0, 1, 0]) };
}

function jointOf(six, warn) {
  const locked = six.map(({ mode }) => (mode === LOCKED ? 'L' : '.')).join('');
  const driven = six.some(({ motorType, friction }) => motorType !== 0 || friction > 0);
  const limited = six.some(({ mode }) => mode === LIMITED);
  const plain = locked === 'LLL...' && !driven && !limited ? 'ball' : undefined;
  const type = plain ?? { 'LLL.LL': 'hinge', '.LLLLL': 'slider', LLLLLL: 'fixed' }[locked] ?? 'generic';
  const named = (make) => Object.fromEntries(six.map((axis, i) => [kNames[i], make(axis, i)])
    .filter(([, value]) => value !== undefined));
  const row = { limits: named(limitOf), motors: named(motorOf), springs: named((axis) => springOf(axis, warn)) };
  if (type === 'ball' || type === 'fixed') return { type };
  return type === 'generic' ? { type, ...row, axes: named(({ mode }) => ['free', 'limited', 'locked'][mode]) }
    : { type, ...row };
}

const limitOf = ({ mode, min = -kUnbounded, max = kUnbounded }) => (mode === LIMITED ? [min, max] : undefined);
/** Friction of a joint is a motor that holds it at rest. */
function motorOf({ mode, motorType, target = 0, maxForce = kStrong, friction }) {
  if (mode === LOCKED) return undefined;
  if (motorType === VELOCITY) return { targetVelocity: target, maxForce };
  return motorType !== POSITION && friction > 0 ? { targetVelocity: 0, maxForce: friction } : undefined;
}
function springOf({ mode, motorType, target = 0 }, warn) {
  if (mode === LOCKED || motorType !== POSITION) return undefined;
  warn('a motor to a position is a critically damped spring of 8 Hz; its maximum force is not kept');
  return { rest: target, ...kServo };
}
