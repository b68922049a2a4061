import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix, Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { MeshBuilder } from '@babylonjs/core/Meshes/meshBuilder.js';
import '@babylonjs/core/Meshes/thinInstanceMesh.js';
import { PhysicsBody } from '@babylonjs/core/Physics/v2/physicsBody.js';
import { PhysicsPrestepType } from '@babylonjs/core/Physics/v2/IPhysicsEnginePlugin.js';
import { ANIMATED, both, DYNAMIC, Stage, STATIC } from './engines.mjs';

const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) < by, `${value} is not ${wanted}`);

test('a tower of 20 stands', () => {
  const stage = new Stage('plumb');
  stage.ground();
  const box = stage.box(), tower = Array.from({ length: 20 }, (_, i) => stage.body(box, [0, 0.5 + i, 0]));
  stage.run(10);
  near(tower.at(-1).transformNode.position.y, 19.5, 0.05);
  stage.end();
});

test('masses are those of Havok', () => {
  const [plumb, havok] = both((stage) => {
    const body = stage.body(stage.box(1, 2, 3), [0, 5, 0]);
    const told = () => {
      const { mass, inertia, centerOfMass } = body.getMassProperties();
      return [mass, inertia.x, inertia.y, inertia.z, centerOfMass.y];
    };
    const empty = new PhysicsBody(stage.body(null, [9, 9, 9]).transformNode, DYNAMIC, false, stage.scene);
    const rows = [empty.getMassProperties().mass, ...told()];
    body.setMassProperties({ mass: 10, centerOfMass: new Vector3(0, 0.5, 0) });
    return [...rows, ...told(), body.computeMassProperties().mass, body.shape.density];
  });
  plumb.forEach((value, i) => near(value, havok[i], 1e-3 * Math.max(1, Math.abs(value))));
});

test('impulses, forces, torques and damping act as in Havok', () => {
  const [plumb, havok] = both((stage) => {
    const body = stage.body(stage.box(), [0, 0, 0]);
    body.setMassProperties({ mass: 2 });
    body.setAngularDamping(0);
    body.setLinearDamping(0.5);
    body.applyImpulse(new Vector3(2, 0, 0), new Vector3(0, 0.5, 0));
    body.applyAngularImpulse(new Vector3(0, 0.3, 0));
    stage.run(0.5, () => {
      body.applyForce(new Vector3(0, 0, 3), body.transformNode.position);
      body.applyTorque(new Vector3(0.2, 0, 0));
    });
    const v = body.getLinearVelocity(), w = body.getAngularVelocity();
    body.setGravityFactor(2);
    return [v.x, v.y, v.z, w.x, w.y, w.z, body.getLinearDamping(), body.getAngularDamping(), body.getGravityFactor()];
  }, 0);
  plumb.forEach((value, i) => near(value, havok[i], 0.02));
});

test('an animated body reaches its target and carries what lies on it', () => {
  const heights = both((stage) => {
    const lift = stage.body(stage.box(4, 1, 4), [0, 0, 0], ANIMATED), load = stage.body(stage.box(), [0, 1, 0]);
    stage.run(1, (i) => lift.setTargetTransform(new Vector3(0, (i + 1) / 60, 0), Quaternion.Identity()));
    return [lift.transformNode.position.y, load.transformNode.position.y];
  });
  for (const [lift, load] of heights) {
    near(lift, 1, 1e-3);
    near(load, 2, 0.03);
  }
});

test('a body becomes another while it lives', () => {
  const stage = new Stage('plumb');
  stage.ground();
  const body = stage.body(stage.box(), [0, 5, 0], STATIC);
  stage.run(0.5);
  near(body.transformNode.position.y, 5, 1e-6);
  body.setMotionType(DYNAMIC);
  assert.equal(body.getMotionType(), DYNAMIC);
  stage.run(3);
  near(body.transformNode.position.y, 0.5, 0.01);
  body.shape = stage.ball(1);
  stage.run(2);
  near(body.transformNode.position.y, 1, 0.02);
  body.setMassProperties({ inertia: Vector3.Zero() });
  body.applyAngularImpulse(new Vector3(0, 100, 0));
  near(body.getAngularVelocity().length(), 0, 1e-9);
  body.disablePreStep = false;
  body.transformNode.position.set(3, 4, 0);
  stage.run(1 / 60);
  near(body.transformNode.position.x, 3, 1e-3);
  body.setPrestepType(PhysicsPrestepType.DISABLED);
  stage.run(2);
  near(body.transformNode.position.y, 1, 0.02);
  body.dispose();
  assert.equal(stage.plugin.world.bodyCount, 1);
  stage.end();
});

test('thin instances are bodies of their own', () => {
  const [plumb, havok] = both((stage) => {
    stage.ground();
    const mesh = MeshBuilder.CreateBox('', { size: 1 }, stage.scene);
    mesh.thinInstanceAdd([0, 1, 2].map((i) => Matrix.Translation(3 * i, 2 + i, 0)));
    const body = new PhysicsBody(mesh, DYNAMIC, false, stage.scene);
    body.shape = stage.box();
    body.setLinearVelocity(new Vector3(0, 0, 1), 1);
    const before = [body.numInstances, body.getLinearVelocity(1).z, body.getLinearVelocity(0).z];
    stage.run(2);
    const data = mesh._thinInstanceDataStorage.matrixData;
    return [...before, ...[0, 1, 2].flatMap((i) => [data[16 * i + 12], data[16 * i + 13]])];
  });
  plumb.forEach((value, i) => near(value, havok[i], 0.03));
});

test('velocities are bounded where a page says so', () => {
  const stage = new Stage('plumb', 0);
  const body = stage.body(stage.box(), [0, 0, 0]);
  stage.physics.setVelocityLimits(5, 100);
  body.setLinearVelocity(new Vector3(30, 40, 0));
  stage.run(1 / 60);
  near(body.getLinearVelocity().length(), 5, 1e-6);
  assert.equal(stage.physics.getMaxLinearVelocity(), 5);
  stage.end();
});
