// Descriptors of the wire as the options that the module takes.
import { DYNAMIC } from '../../rows.mjs';
import { AXIS_MODES, JOINTS, MOTIONS, SHAPES } from '../../words.mjs';

const AXES = ['x', 'y', 'z', 'angularX', 'angularY', 'angularZ'];
const LOCKS = ['linearX', 'linearY', 'linearZ', 'angularX', 'angularY', 'angularZ'];
const FLAGS = ['sensor', 'ccd', 'noRotation', 'asleep', 'neverSleeps', 'modifyContacts'];
const wordsOf = (words, bits) => words.filter((_, bit) => bits & (1 << bit));

/** shapes: handles by slot. */
export function shapeOptions({ slot: _, type, children, dx, dz, ...rest }, shapes) {
  const options = { ...rest, type: SHAPES[type] === 'height_field' ? 'heightField' : SHAPES[type] };
  if (dx !== undefined) options.spacing = [dx, dz];
  if (children) options.children = children.map(({ shape, pose, material }) => ({ shape: shapes.get(shape), ...pose, material: material ?? undefined }));
  return options;
}

export function bodyOptions(desc, shapes) {
  const { shape, motion, flags, locks, pose, linear, angular, mass, centre, inertia, inertiaOrientation, material, filter, gravityScale, linearDamping, angularDamping } = desc;
  return {
    shape: shape < 0 ? 0n : shapes.get(shape), motion: MOTIONS[motion], flags: wordsOf(FLAGS, flags), locks: wordsOf(LOCKS, locks), ...pose,
    linearVelocity: linear, angularVelocity: angular, ...material, filter, gravityScale, linearDamping, angularDamping,
    ...(motion === DYNAMIC ? { mass, centreOfMass: centre, inertia, inertiaOrientation } : {}),
  };
}

/** bodies: handles by slot. */
export function jointOptions({ type, a, b, frameA, frameB, collideConnected, restLength, axes }, bodies) {
  const some = (has, make) => Object.fromEntries(axes.flatMap((axis, i) => (has(axis) ? [[AXES[i], make(axis)]] : [])));
  return {
    type: JOINTS[type], a: a < 0 ? 0n : bodies.get(a), b: bodies.get(b), frameA, frameB, collideConnected, restLength,
    axes: some(() => true, ({ mode }) => AXIS_MODES[mode]),
    limits: some(({ limit }) => limit.enabled || limit.lower !== 0 || limit.upper !== 0, ({ limit }) => [limit.lower, limit.upper]),
    motors: some(({ motor }) => motor.enabled, ({ motor }) => ({ targetVelocity: motor.target, maxForce: motor.most })),
    springs: some(({ spring }) => spring.enabled, ({ spring: { byStiffness, rest, frequency, ratio } }) =>
      ({ rest, ...(byStiffness ? { stiffness: frequency, damping: ratio } : { frequency, dampingRatio: ratio }) })),
  };
}
