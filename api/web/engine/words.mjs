// Words for the numbers of plumb.h, in its order.
import { PlumbError, INVALID } from './error.mjs';

const inOrder = (...words) => Object.fromEntries(words.map((word, number) => [word, number]));
const asBits = (...words) => Object.fromEntries(words.map((word, bit) => [word, 2 ** bit]));

export const NEED = asBits('rotation', 'collision', 'friction', 'restitution', 'joints', 'ccd', 'sleeping', 'events',
  'contacts', 'contactImpulses', 'sensors', 'kinematic', 'gyroscopic', 'damping', 'forces', 'axisLocks', 'filters',
  'queries', 'surfaceVelocity', 'jointReactions', 'snapshot', 'contactModification',
  'rollingFriction');
export const MOTION = inOrder('static', 'kinematic', 'dynamic');
export const FLAG = asBits('sensor', 'ccd', 'noRotation', 'asleep', 'neverSleeps', 'modifyContacts');
export const LOCK = asBits('linearX', 'linearY', 'linearZ', 'angularX', 'angularY', 'angularZ');
export const SHAPE =
  inOrder('sphere', 'box', 'capsule', 'cylinder', 'hull', 'mesh', 'heightField', 'plane', 'compound');
export const JOINT = inOrder('ball', 'hinge', 'slider', 'distance', 'fixed', 'universal', 'generic', 'swing_twist',
  'gear', 'rack_and_pinion');
export const AXIS = inOrder('free', 'locked', 'limited');
export const SPRING = inOrder('frequency', 'stiffness');
export const MASS = inOrder('fromDensity', 'fromTotal', 'explicit');
export const FIELD = inOrder('pose', 'velocity', 'force', 'torque', 'impulse', 'angularImpulse', 'forceAtPoint',
  'impulseAtPoint', 'awake', 'kinematicTarget', 'mass', 'material', 'gravityScale', 'damping', 'surfaceVelocity',
  'filter', 'rollingFriction');
export const JOINT_FIELD = inOrder('coordinates', 'reaction', 'motor', 'springRest');
export const EVENT = ['contactBegin', 'contactEnd', 'sensorEnter', 'sensorLeave', 'wake', 'sleep', 'jointBroken'];
export const CHANGE_OF_BODY = asBits('motion', 'shape', 'mass', 'flags', 'locks');
export const CHANGE_OF_JOINT =
  asBits('frames', 'limits', 'motors', 'springs', 'strength', 'collideConnected', 'enabled');
export const CHANGE_OF_CONTACT = asBits('disabled', 'friction', 'restitution', 'surfaceVelocity');
export const CAPABILITY = inOrder('shape', 'pair', 'joint', 'jointFeature', 'query', 'fieldRead', 'fieldWrite', 'need',
  'event', 'phaseTime', 'residual', 'snapshot', 'hostJobs', 'childMaterial', 'modify', 'manifold', 'closest',
  'triangleMaterial', 'cooking', 'hostMemory');
export const DEGREE = ['none', 'approximate', 'emulated', 'native'];

/** The number of a word, or a sentence that lists the words. */
export function numberOf(words, word, what) {
  if (!Object.hasOwn(words, word))
    throw new PlumbError(INVALID, `there is no ${what} "${word}"; there are ${Object.keys(words).join(', ')}`);
  return words[word];
}

export const bitsOf = (words, given, what) => given.reduce((all, word) => all + numberOf(words, word, what), 0);
