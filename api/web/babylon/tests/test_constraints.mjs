import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { BallAndSocketConstraint, DistanceConstraint, HingeConstraint, LockConstraint, Physics6DoFConstraint,
  PrismaticConstraint, SliderConstraint } from '@babylonjs/core/Physics/v2/physicsConstraint.js';
import { both, Stage, STATIC } from './engines.mjs';

const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) < by, `${value} is not ${wanted}`);
const kX = 0, kAngularX = 3;
const kVelocity = 1, kLimited = 1;

/** A box that hangs by a constraint at a post of nothing; where it is after a while. */
function hung(make, { gravity, then = () => {}, seconds = 0.7 } = {}) {
  return both((stage) => {
    const post = stage.body(stage.box(0.1, 0.1, 0.1), [0, 0, 0], STATIC), body = stage.body(stage.box(), [1, 0, 0]);
    body.setMassProperties({ mass: 1 });
    body.setAngularDamping(0);
    const constraint = make(stage.scene);
    post.addConstraint(body, constraint);
    then(stage, body, constraint, post);
    stage.run(seconds);
    const { x, y, z } = body.transformNode.position, w = body.getAngularVelocity(), v = body.getLinearVelocity();
    return [x, y, z, w.x, w.y, w.z, v.x, v.y, v.z];
  }, gravity);
}
const same = ([plumb, havok], by) => plumb.forEach((value, i) => near(value, havok[i], by));
const pivot = new Vector3(-1, 0, 0);

test('doors, balls, locks and rails move as in Havok', () => {
  const z = new Vector3(0, 0, 1), y = new Vector3(0, 1, 0), x = new Vector3(1, 0, 0);
  same(hung((scene) => new HingeConstraint(Vector3.Zero(), pivot, z, z, scene)), 0.15);
  same(hung((scene) => new BallAndSocketConstraint(Vector3.Zero(), pivot, x, x, scene)), 0.15);
  same(hung((scene) => new LockConstraint(Vector3.Zero(), pivot, x, x, scene)), 0.15);
  same(hung((scene) => new PrismaticConstraint(Vector3.Zero(), pivot, y, y, scene)), 0.15);
  same(hung((scene) => new SliderConstraint(Vector3.Zero(), pivot, y, y, scene), {
    then: (_, body) => body.setAngularVelocity(new Vector3(0, 2, 0)), seconds: 0.3 }), 0.15);
});

test('a distance is kept', () => {
  for (const [x, y, z] of hung((scene) => new DistanceConstraint(1.5, scene), { seconds: 3 }))
    assert.ok(Math.hypot(x, y, z) < 1.55);
});

test('a motor of a 6 dof constraint turns as in Havok, and stops', () => {
  const make = (scene) => new Physics6DoFConstraint({ pivotA: Vector3.Zero(), pivotB: pivot, axisA: new Vector3(0, 1, 0),
    axisB: new Vector3(0, 1, 0), perpAxisA: new Vector3(0, 0, 1), perpAxisB: new Vector3(0, 0, 1) },
    [0, 1, 2, 4, 5].map((axis) => ({ axis, minLimit: 0, maxLimit: 0 })), scene);
  const drive = (_, __, constraint) => {
    constraint.setAxisMotorType(kAngularX, kVelocity);
    constraint.setAxisMotorMaxForce(kAngularX, 1000);
    constraint.setAxisMotorTarget(kAngularX, 1.5);
  };
  const told = hung(make, { gravity: 0, then: drive });
  same(told, 0.1);
  near(Math.abs(told[0][4]), 1.5, 0.01);
  // Joint friction of 50 N m stops it; Havok 1.3.14 turns on.
  const [row] = hung(make, { gravity: 0, then: (stage, body, constraint) => {
    drive(stage, body, constraint);
    stage.run(0.5);
    constraint.setAxisMotorType(kAngularX, 0);
    constraint.setAxisFriction(kAngularX, 50);
  } });
  near(row[4], 0, 1e-3);
});

test('limits hold, on the same side as in Havok', () => {
  const make = (min, max) => (scene) => new Physics6DoFConstraint({ pivotA: Vector3.Zero(), pivotB: pivot,
    axisA: new Vector3(0, 0, 1), axisB: new Vector3(0, 0, 1), perpAxisA: new Vector3(0, 1, 0),
    perpAxisB: new Vector3(0, 1, 0) }, [...[0, 1, 2, 4, 5].map((axis) => ({ axis, minLimit: 0, maxLimit: 0 })),
    { axis: 3, minLimit: min, maxLimit: max }], scene);
  same(hung(make(-0.3, 1), { seconds: 2 }).map((row) => row.slice(0, 3)), 0.05);
  same(hung(make(-1, 0.3), { seconds: 2 }).map((row) => row.slice(0, 3)), 0.05);
  const slide = (scene) => new Physics6DoFConstraint({ pivotA: Vector3.Zero(), pivotB: pivot }, [{ axis: kX, minLimit: -0.5,
    maxLimit: 0.25 }, ...[1, 2, 3, 4, 5].map((axis) => ({ axis, minLimit: 0, maxLimit: 0 }))], scene);
  const push = (_, body) => body.setLinearVelocity(new Vector3(2, 0, 0));
  same(hung(slide, { gravity: 0, then: push, seconds: 1 }).map((row) => row.slice(0, 1)), 0.05);
});

test('constraints are read, disabled, and end with their bodies', () => {
  const stage = new Stage('plumb');
  const post = stage.body(stage.box(), [0, 0, 0], STATIC), body = stage.body(stage.box(), [1, 0, 0]);
  const constraint = new Physics6DoFConstraint({ pivotB: pivot }, [], stage.scene);
  post.addConstraint(body, constraint);
  constraint.setAxisMode(kX, kLimited);
  constraint.setAxisMinLimit(kX, -2);
  constraint.setAxisMaxLimit(kX, 3);
  assert.deepEqual([constraint.getAxisMode(kX), constraint.getAxisMinLimit(kX), constraint.getAxisMaxLimit(kX)],
    [kLimited, -2, 3]);
  assert.deepEqual([constraint.isEnabled, constraint.isCollisionsEnabled], [true, false]);
  assert.equal(constraint.getBodiesUsingConstraint()[0].childBody, body);
  const lock = new LockConstraint(Vector3.Zero(), pivot, undefined, undefined, stage.scene);
  post.addConstraint(body, lock);
  stage.run(0.5);
  near(body.transformNode.position.y, 0, 1e-3);
  lock.isEnabled = false;
  stage.run(0.5);
  assert.ok(body.transformNode.position.y < -0.5);
  body.dispose();
  assert.equal(lock.getBodiesUsingConstraint().length, 0);
  stage.run(1 / 60);
  stage.end();
});

test('what outlives the engine can be disposed of', () => {
  const stage = new Stage('plumb'), shape = stage.box();
  const post = stage.body(shape, [0, 0, 0], STATIC), body = stage.body(stage.box(), [1, 0, 0]);
  const constraint = new LockConstraint(Vector3.Zero(), pivot, undefined, undefined, stage.scene);
  post.addConstraint(body, constraint);
  stage.run(1 / 60);
  stage.scene.disablePhysicsEngine();
  body.dispose();
  constraint.dispose();
  shape.dispose();
  stage.end();
});
