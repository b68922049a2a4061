// Options, as a page writes them, become descriptors, as plumb.h has them.
import { AXIS, bitsOf, CHANGE_OF_BODY, CHANGE_OF_CONTACT, CHANGE_OF_JOINT, FLAG, JOINT, LOCK, MASS, MOTION, numberOf, SHAPE, SPRING }
  from './words.mjs';
import { LAYOUT } from './layouts.mjs';
import { INVALID, PlumbError } from './error.mjs';

const kOrigin = [0, 0, 0], kUpright = [0, 0, 0, 1];
const kAxes = ['x', 'y', 'z', 'angularX', 'angularY', 'angularZ'];

export const poseOf = ({ position = kOrigin, orientation = kUpright } = {}) => [...position, ...orientation];
export const filterOf = ({ category = 1, mask = 0xffffffff, group = 0 } = {}) => ({ category, mask, group });
const materialOf = ({ friction = 0.5, restitution = 0, surfaceVelocity = kOrigin }) =>
  ({ friction, restitution, surfaceVelocity });

export function shapeOf(memory, { type, vertices = [], indices = [], heights = [], children = [], materials = [],
  triangleMaterials = [], ...rest }) {
  const childOf = ({ shape, material, ...pose }) =>
    ({ shape, pose: poseOf(pose), hasMaterial: material ? 1 : 0, material: materialOf(material ?? {}) });
  return { ...rest, type: numberOf(SHAPE, type, 'shape'), vertices: memory.putArray(Float64Array, vertices),
    vertexCount: vertices.length / 3, indices: memory.putArray(Uint32Array, indices),
    triangleCount: indices.length / 3, heights: memory.putArray(Float64Array, heights),
    spacing: rest.spacing && [rest.spacing[0], 0, rest.spacing[1]],
    children: memory.putStructs(LAYOUT.child, children.map(childOf)), childCount: children.length,
    materials: memory.putStructs(LAYOUT.material, materials.map(materialOf)), materialCount: materials.length,
    triangleMaterials: memory.putArray(Uint32Array, Array.from(triangleMaterials, (m) => m >>> 0)) };
}

/** Explicit with an inertia, from the mass with a mass alone, else from the density. */
function massOf({ density = 1000, mass = 0, centreOfMass = kOrigin, inertia, inertiaOrientation = kUpright }) {
  const mode = inertia !== undefined ? MASS.explicit : mass !== 0 ? MASS.fromTotal : MASS.fromDensity;
  return { massMode: mode, density, mass, centreOfMass, inertia: inertia ?? kOrigin, inertiaOrientation };
}

export function bodyOf(options) {
  const { shape = 0n, motion = 'dynamic', flags = [], locks = [], linearVelocity = kOrigin, angularVelocity = kOrigin,
    gravityScale = 1, linearDamping = 0, angularDamping = 0, filter, rollingFriction = 0,
    spinningFriction = 0 } = options;
  return { shape, motion: numberOf(MOTION, motion, 'motion'), flags: bitsOf(FLAG, flags, 'flag'),
    locks: bitsOf(LOCK, locks, 'lock'), pose: poseOf(options), linearVelocity, angularVelocity, ...massOf(options),
    material: materialOf(options), gravityScale, linearDamping, angularDamping, filter: filterOf(filter),
    rollingFriction, spinningFriction };
}

/** Six of them, from those that an object names: { x: ..., angularZ: ... }; the others are nothing. */
function sixOf(given, what, make, nothing) {
  for (const axis of Object.keys(given)) numberOf(Object.fromEntries(kAxes.map((a, i) => [a, i])), axis, `axis of ${what}`);
  return kAxes.map((axis) => given[axis] === undefined ? nothing : make(given[axis]));
}
const limitsOf = (given = {}) =>
  sixOf(given, 'limits', ([lower, upper]) => ({ lower, upper, enabled: 1 }), { lower: 0, upper: 0, enabled: 0 });
const motorsOf = (given = {}) => sixOf(given, 'motors', ({ targetVelocity = 0, maxForce }) =>
  ({ targetVelocity, maxForce, enabled: 1 }), { targetVelocity: 0, maxForce: 0, enabled: 0 });
const springOf = ({ rest = 0, frequency, dampingRatio = 1, stiffness, damping }) =>
  stiffness === undefined && damping === undefined
    ? { rest, frequency, dampingRatio, enabled: 1, mode: SPRING.frequency }
    : { rest, frequency: stiffness ?? 0, dampingRatio: damping ?? 0, enabled: 1, mode: SPRING.stiffness };
const springsOf = (given = {}) => sixOf(given, 'springs', springOf,
  { rest: 0, frequency: 0, dampingRatio: 0, enabled: 0, mode: SPRING.frequency });
const modesOf = (given = {}) => sixOf(given, 'axes', (mode) => numberOf(AXIS, mode, 'axis mode'), AXIS.free);

export function jointOf({ type, a = 0n, b, frameA, frameB, collideConnected = false, axes, limits, motors, springs,
  restLength = 0, breakForce = 0, breakTorque = 0, ratio = 0 }) {
  return { type: numberOf(JOINT, type, 'joint'), a, b, frameA: poseOf(frameA), frameB: poseOf(frameB), collideConnected,
    axisModes: modesOf(axes), limits: limitsOf(limits), motors: motorsOf(motors), springs: springsOf(springs),
    restLength, breakForce, breakTorque, ratio };
}

/** Only what is given changes. */
export function bodyChangeOf(body, options) {
  const { motion, shape, flags, locks } = options;
  const given = { motion: motion !== undefined, shape: shape !== undefined,
    mass: ['density', 'mass', 'inertia'].some((name) => options[name] !== undefined), flags: flags !== undefined,
    locks: locks !== undefined };
  return { body, what: whatOf(CHANGE_OF_BODY, given, options), motion: numberOf(MOTION, motion ?? 'static', 'motion'),
    shape: shape ?? 0n, flags: bitsOf(FLAG, flags ?? [], 'flag'), locks: bitsOf(LOCK, locks ?? [], 'lock'),
    ...massOf(options) };
}

export function jointChangeOf(joint, options) {
  const has = (name) => options[name] !== undefined;
  const given = { frames: has('frameA') || has('frameB'), limits: has('limits') || has('axes') || has('restLength'),
    motors: has('motors'), springs: has('springs'), strength: has('breakForce') || has('breakTorque'),
    collideConnected: has('collideConnected'), enabled: has('enabled') };
  return { ...jointOf({ ...options, type: 'ball', b: 0n }), joint, what: whatOf(CHANGE_OF_JOINT, given, options),
    enabled: options.enabled ?? true };
}

/** As a page sees it: its points, each with its own numbers. */
export function manifoldOf({ pointCount, positions, depths, ...found }) {
  const points = Array.from({ length: pointCount }, (_, i) => ({ position: positions.slice(3 * i, 3 * i + 3), depth: depths[i] }));
  return { ...found, points };
}

export function contactChangeOf(options) {
  const { manifold, disabled = false, friction, restitution, surfaceVelocity } = options;
  const given = { disabled, friction: friction !== undefined, restitution: restitution !== undefined,
    surfaceVelocity: surfaceVelocity !== undefined };
  return { manifold, what: whatOf(CHANGE_OF_CONTACT, given, options), friction: friction ?? 0,
    restitution: restitution ?? 0, surfaceVelocity: surfaceVelocity ?? [0, 0, 0] };
}

function whatOf(bits, given, options) {
  const what = bitsOf(bits, Object.keys(given).filter((name) => given[name]), 'change');
  if (what === 0) throw new PlumbError(INVALID, `nothing that can change is among ${Object.keys(options).join(', ')}`);
  return what;
}
