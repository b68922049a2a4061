import assert from 'node:assert/strict';
import { test } from 'node:test';
import { grounded, positionOf, steps, velocityOf } from './worlds.mjs';

const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) < by, `${value} is not ${wanted}`);
/** A cube that a joint holds at a point of the world. */
function held(options, { gravity = [0, -9.81, 0], needs = [] } = {}) {
  const { world, cube } = grounded(['joints', ...needs], { gravity });
  const body = world.createBody({ shape: cube, position: [0, 5, 0] });
  const joint = world.createJoint({ b: body, frameA: { position: [0, 5, 0] }, ...options });
  return { world, body, joint };
}

test('a generic joint is free, limited and locked where it says so', () => {
  const { world, body, joint } = held({ type: 'generic', limits: { y: [-1, 1] },
    axes: { x: 'locked', y: 'limited', z: 'free', angularX: 'locked', angularY: 'locked', angularZ: 'locked' } });
  steps(world, 120);
  near(positionOf(world, body)[1], 4, 1e-2);
  near(world.readJoints('coordinates', [joint])[1], -1, 1e-2);
  world.destroy();
});

test('a hinge stops at its limit', () => {
  const { world, body, joint } = held({ type: 'hinge', limits: { angularX: [-0.5, 0.5] } }, { gravity: [0, 0, 0] });
  world.write('velocity', body, [0, 0, 0, 2, 0, 0]);
  steps(world, 60);
  near(world.readJoints('coordinates', [joint])[3], 0.5, 0.02);
  world.destroy();
});

test('a motor reaches its speed, is rewritten, and is taken out', () => {
  const { world, body, joint } = held(
    { type: 'hinge', motors: { angularX: { targetVelocity: 3, maxForce: 1e5 } } }, { gravity: [0, 0, 0] });
  steps(world, 30);
  near(velocityOf(world, body)[3], 3, 1e-3);
  const row = world.readJoints('motor', [joint]);
  assert.deepEqual([row[6], row[7]], [3, 1e5]);
  row[6] = -2;
  world.writeJoints('motor', joint, row);
  steps(world, 30);
  near(velocityOf(world, body)[3], -2, 1e-3);
  world.modifyJoint(joint, { enabled: false });
  world.write('velocity', body, [0, 0, 0, 0, 0, 0]);
  steps(world, 30);
  near(velocityOf(world, body)[3], 0, 1e-6);
  world.destroy();
});

test('a spring swings with its frequency', () => {
  const { world, body } = held({ type: 'slider', springs: { x: { frequency: 1, dampingRatio: 0 } } },
    { gravity: [0, 0, 0] });
  world.write('velocity', body, [1, 0, 0, 0, 0, 0]);
  steps(world, 15);
  near(positionOf(world, body)[0], 1 / (2 * Math.PI), 0.02);
  steps(world, 15);
  near(positionOf(world, body)[0], 0, 0.03);
  world.destroy();
});

test('a spring by stiffness swings with its mass', () => {
  const { world, body } = held({ type: 'slider', springs: { x: { stiffness: 1000 * (2 * Math.PI) ** 2 } } },
    { gravity: [0, 0, 0] });
  world.write('velocity', body, [1, 0, 0, 0, 0, 0]);
  steps(world, 15);
  near(positionOf(world, body)[0], 1 / (2 * Math.PI), 0.02);
  world.destroy();
});

test('springs about its axes bring a limb to an orientation, and to another', () => {
  const spring = { frequency: 3 };
  const { world, joint } = held({ type: 'swing_twist', springs: { angularX: { ...spring, rest: 0.3 }, angularY: spring,
    angularZ: { ...spring, rest: -0.4 } } }, { gravity: [0, 0, 0] });
  const arrives = (...turns) => {
    steps(world, 120);
    const at = world.readJoints('coordinates', [joint]);
    turns.forEach((turn, k) => near(at[3 + k], turn, 0.01));
  };
  arrives(0.3, 0, -0.4);
  const rest = world.readJoints('springRest', [joint]);
  near(rest[5], -0.4, 1e-12);
  world.writeJoints('springRest', joint, [0, 0, 0, -0.2, 0.6, 0.1]);
  arrives(-0.2, 0.6, 0.1);
  world.destroy();
});

test('a damper brakes what slides', () => {
  const { world, body } = held({ type: 'slider', springs: { x: { damping: 2000 } } }, { gravity: [0, 0, 0] });
  world.write('velocity', body, [1, 0, 0, 0, 0, 0]);
  steps(world, 60);
  near(velocityOf(world, body)[0], Math.exp(-2), 0.01);
  world.destroy();
});

test('a joint tells its load, and breaks above its strength', () => {
  const { world, body, joint } = held({ type: 'fixed', breakForce: 2e4, userData: 'rope' },
    { needs: ['jointReactions', 'events', 'forces'] });
  steps(world, 60);
  near(world.readJoints('reaction', [joint])[1], 1000 * 9.81, 50);
  assert.equal(world.jointUserData(joint), 'rope');
  world.write('force', body, [0, -3e4, 0]);
  steps(world, 1);
  assert.deepEqual(world.events().map(({ type, joint: which }) => [type, which]), [['jointBroken', joint]]);
  steps(world, 120);
  near(positionOf(world, body)[1], 0.5, 1e-2);
  world.destroy();
});
