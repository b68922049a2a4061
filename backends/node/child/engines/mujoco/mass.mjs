// How heavily a joint's axis is felt: kg or kg m2, against which a force along it works, with nothing else holding the
// bodies.
import { DISTANCE, DYNAMIC, GENERIC, NO_ROTATION } from '../../rows.mjs';
import { add, compose, cross, length, multiply, rotate, scale, sub, unrotate } from '../../algebra.mjs';

const moves = (body) => body?.desc.motion === DYNAMIC;

/** Of its centre of mass. What is not dynamic turns about its origin. */
export const centreOf = ({ desc, pose }) => (desc.motion === DYNAMIC ? add(pose.position, rotate(pose.orientation, desc.centre)) : pose.position);
/** Its principal axes. */
export const axesOf = ({ desc, pose }) => multiply(pose.orientation, desc.inertiaOrientation);
export const frameA = ({ desc, a }) => (a === null ? desc.frameA : compose(a.pose, desc.frameA));
export const frameB = ({ desc, b }) => compose(b.pose, desc.frameB);

/** n . I^-1 n of a dynamic body in world axes; 0 of what forces do not turn. */
function turning(body, n) {
  if (!moves(body) || (body.desc.flags & NO_ROTATION) !== 0) return 0;
  const u = unrotate(axesOf(body), n);
  return u.reduce((sum, x, k) => sum + (x * x) / body.desc.inertia[k], 0);
}
const inverseMass = (body) => (moves(body) ? 1 / body.desc.mass : 0);
/** n . (1/m + r x I^-1 x r) n */
const pushing = (body, at, n) => (body === null ? 0 : inverseMass(body) + turning(body, cross(sub(at, centreOf(body)), n)));
const unit = (axis) => [0, 1, 2].map((k) => (k === axis ? 1 : 0));

export function effectiveMass(joint, axis) {
  const { desc: { type }, a: one, b: two } = joint, a = frameA(joint), b = frameB(joint);
  if (axis >= 3) {
    const n = rotate(axis === 3 ? a.orientation : b.orientation, unit(axis - 3));
    return 1 / (turning(one, n) + turning(two, n));
  }
  if (type !== DISTANCE && type !== GENERIC) return 1 / (inverseMass(one) + inverseMass(two));
  const way = sub(b.position, a.position), isRod = type === DISTANCE, far = length(way);
  const n = isRod && far > 1e-9 ? scale(1 / far, way) : rotate(a.orientation, unit(axis));
  return 1 / (pushing(one, isRod ? a.position : b.position, n) + pushing(two, b.position, n));
}

/** Moments about the principal axes times a turn about them: the spin's momentum, or with 1 / moments back. */
export const spread = (moments, turn) => turn.map((x, k) => moments[k] * x);
/** Of a twist, in world axes; 0 of what does not turn. */
export function turnedBy(body, twist) {
  if ((body.desc.flags & NO_ROTATION) !== 0) return [0, 0, 0];
  const axes = axesOf(body);
  return rotate(axes, spread(body.desc.inertia.map((i) => 1 / i), unrotate(axes, twist)));
}
