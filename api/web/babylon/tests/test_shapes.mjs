import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { MeshBuilder } from '@babylonjs/core/Meshes/meshBuilder.js';
import { PhysicsRaycastResult } from '@babylonjs/core/Physics/physicsRaycastResult.js';
import { ProximityCastResult } from '@babylonjs/core/Physics/proximityCastResult.js';
import { ShapeCastResult } from '@babylonjs/core/Physics/shapeCastResult.js';
import { PhysicsBody } from '@babylonjs/core/Physics/v2/physicsBody.js';
import { PhysicsShapeCapsule, PhysicsShapeContainer, PhysicsShapeConvexHull, PhysicsShapeCylinder,
  PhysicsShapeGroundMesh, PhysicsShapeHeightField, PhysicsShapeMesh } from '@babylonjs/core/Physics/v2/physicsShape.js';
import { both, Stage, STATIC } from './engines.mjs';

const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) < by, `${value} is not ${wanted}`);
const same = ([plumb, havok], by) => {
  assert.equal(plumb.length, havok.length);
  plumb.forEach((value, i) => near(value, havok[i], by));
};
/** Height at a point by a ray from above; -1 where there is nothing. */
function heightAt(stage, x, z) {
  const hit = stage.physics.raycast(new Vector3(x, 10, z), new Vector3(x, -10, z));
  return hit.hasHit ? hit.hitPointWorld.y : -1;
}
const spots = [-1.6, -0.7, 0.1, 0.9, 1.7];
const profile = (stage) => spots.flatMap((x) => spots.map((z) => heightAt(stage, x, z)));

test('every shape has the profile that Havok has', () => {
  const shapes = {
    capsule: ({ scene }) => new PhysicsShapeCapsule(new Vector3(-1, 0, 0), new Vector3(1, 0.5, 0), 0.4, scene),
    cylinder: ({ scene }) => new PhysicsShapeCylinder(new Vector3(0, -1, 0.3), new Vector3(0, 1, 0.3), 1, scene),
    hull: ({ scene }) => new PhysicsShapeConvexHull(MeshBuilder.CreatePolyhedron('', { type: 1, size: 1 }, scene), scene),
    mesh: ({ scene }) => new PhysicsShapeMesh(MeshBuilder.CreateTorus('', { diameter: 2, thickness: 0.8 }, scene), scene),
    container: (stage) => {
      const container = new PhysicsShapeContainer(stage.scene);
      container.addChild(stage.box(1, 1, 1), new Vector3(1, 0.5, 0), Quaternion.RotationYawPitchRoll(0.5, 0, 0.3));
      container.addChild(stage.ball(0.7), new Vector3(-1, 0, 0.5));
      return container;
    },
    field: ({ scene }) => new PhysicsShapeHeightField(4, 4, 5, 5,
      Float32Array.from({ length: 25 }, (_, i) => Math.sin(i)), scene),
  };
  for (const [name, make] of Object.entries(shapes)) {
    const told = both((stage) => {
      stage.body(make(stage), [0, 0, 0], STATIC);
      stage.run(1 / 60);
      return profile(stage);
    });
    // Havok shrinks and cuts otherwise: a field's cells along the other diagonal, hulls by a margin.
    const by = { field: 0.6, hull: 0.05 }[name] ?? 0.03;
    told[0].forEach((value, i) => near(value, told[1][i], by));
  }
});

test('a ground has its own heights', () => {
  const stage = new Stage('plumb');
  const ground = MeshBuilder.CreateGround('', { width: 4, height: 6, subdivisions: 4, updatable: true }, stage.scene);
  const positions = ground.getVerticesData('position');
  for (let i = 0; i < positions.length; i += 3) positions[i + 1] = 0.3 * positions[i] + 0.1 * positions[i + 2] - 1;
  ground.setVerticesData('position', positions);
  stage.body(new PhysicsShapeGroundMesh(ground, stage.scene), [0, 0, 0], STATIC);
  stage.run(1 / 60);
  for (const x of spots) for (const z of spots) near(heightAt(stage, x, z), 0.3 * x + 0.1 * z - 1, 1e-3);
  stage.end();
});

test('a ball lies on a mesh, also on a mirrored one', () => {
  const stage = new Stage('plumb');
  const balls = [1, -1].map((mirror, i) => {
    const ground = MeshBuilder.CreateGround('', { width: 4, height: 4 }, stage.scene);
    ground.scaling.x = mirror;
    ground.position.x = 10 * i;
    const body = new PhysicsBody(ground, STATIC, false, stage.scene);
    body.shape = new PhysicsShapeMesh(ground, stage.scene);
    const { positions, indices } = body.getGeometry();
    const [a, b, c] = [...indices.slice(0, 3)].map((index) =>
      Vector3.FromArray(positions, 3 * index).applyRotationQuaternion(ground.absoluteRotationQuaternion));
    assert.ok(Vector3.Cross(b.subtract(a), c.subtract(a)).y > 0, 'counter-clockwise seen from outside');
    return stage.body(stage.ball(), [10 * i + 0.3, 1, 0.2]);
  });
  stage.run(1.5);
  for (const ball of balls) near(ball.transformNode.position.y, 0.5, 0.01);
  stage.end();
});

test('a container changes with its children', () => {
  const stage = new Stage('plumb');
  const container = new PhysicsShapeContainer(stage.scene);
  container.addChild(stage.box(), new Vector3(0, 0.5, 0));
  stage.body(container, [0, 0, 0], STATIC);
  stage.run(1 / 60);
  near(heightAt(stage, 0.1, 0.1), 1, 1e-3);
  container.addChild(stage.box(), new Vector3(0, 1.5, 0));
  assert.equal(container.getNumChildren(), 2);
  near(heightAt(stage, 0.1, 0.1), 2, 1e-3);
  near(container.getBoundingBox().maximum.y, 2, 1e-6);
  container.removeChild(1);
  near(heightAt(stage, 0.1, 0.1), 1, 1e-3);
  stage.end();
});

test('masks keep bodies apart and hide them from rays, as in Havok', () => {
  same(both((stage) => {
    stage.ground();
    const through = stage.box();
    through.filterMembershipMask = 2;
    through.filterCollideMask = 2;
    const body = stage.body(through, [0, 2, 0]), floor = stage.body(stage.box(), [3, 2, 0]);
    const ray = (query) => {
      const hit = stage.physics.raycast(new Vector3(0, 5, 0), new Vector3(0, -5, 0), query);
      return hit.hasHit ? hit.hitPointWorld.y : -9;
    };
    stage.run(1 / 60);
    const rays = [ray({ collideWith: 2, membership: 2 }), ray({ collideWith: 1, membership: 1 }),
      ray({ ignoreBody: body })];
    stage.run(1);
    return [...rays, body.transformNode.position.y, floor.transformNode.position.y, through.filterMembershipMask];
  }), 0.1);
});

test('rays, casts and proximity answer as Havok', () => {
  same(both((stage, name) => {
    stage.ground();
    stage.body(stage.box(), [0, 3, 0], STATIC);
    stage.run(1 / 60);
    const many = [];
    stage.plugin.raycast(new Vector3(0, 9, 0), new Vector3(0, -1, 0), many);
    const [one, other, near1, near2] = [new ShapeCastResult(), new ShapeCastResult(), new ProximityCastResult(),
      new ProximityCastResult()];
    const ball = stage.ball(), base = { shape: ball, rotation: Quaternion.Identity(), shouldHitTriggers: false };
    stage.plugin.shapeCast({ ...base, startPosition: new Vector3(0.2, 7, 0), endPosition: new Vector3(0.2, 0, 0) }, one, other);
    stage.plugin.shapeProximity({ ...base, position: new Vector3(2, 3, 0), maxDistance: 2 }, near1, near2);
    const point = new ProximityCastResult();
    stage.plugin.pointProximity({ position: new Vector3(0, 5, 0), maxDistance: 3, collisionFilter: {},
      shouldHitTriggers: false }, point);
    const rows = (result) => [Number(result.hasHit), result.hitPoint.x, result.hitPoint.y, result.hitNormal.x,
      result.hitNormal.y];
    // Havok's plugin gathers one hit, if it is not told to gather more.
    if (name === 'plumb') assert.deepEqual(many.map((hit) => Math.round(hit.hitPointWorld.y * 100)), [350, 0]);
    return [many[0].hitPointWorld.y, one.hitFraction, ...rows(one), ...rows(other),
      near1.hitDistance, ...rows(near1), ...rows(near2), point.hitDistance, ...rows(point)];
  }), 0.02);
  const result = new PhysicsRaycastResult(), stage = new Stage('plumb');
  stage.plugin.raycast(new Vector3(0, 1, 0), new Vector3(0, 1, 0), result);
  assert.equal(result.hasHit, false);
  const container = new PhysicsShapeContainer(stage.scene);
  container.addChild(stage.box(), new Vector3(1, 0, 0));
  assert.throws(() => stage.plugin.shapeCast({ shape: container, rotation: Quaternion.Identity(),
    startPosition: Vector3.Zero(), endPosition: Vector3.Up() }, new ShapeCastResult(), new ShapeCastResult()),
    /can be cast/);
  stage.end();
});

test('debug geometry is where the shape is', () => {
  const [plumb, havok] = both((stage) => {
    const shape = new PhysicsShapeCylinder(new Vector3(0, -1, 0), new Vector3(0, 1, 0), 0.5, stage.scene);
    const body = stage.body(shape, [3, 0, 0]);
    const { positions, indices } = body.getGeometry();
    const { minimum, maximum } = body.getBoundingBox();
    return { ys: [Math.min(...positions.filter((_, i) => i % 3 === 1)), Math.max(...positions)], count: indices.length,
      bounds: [minimum.x, maximum.x, minimum.y] };
  });
  plumb.ys.forEach((value, i) => near(value, havok.ys[i], 0.05));
  assert.ok(plumb.count > 30 && plumb.count % 3 === 0);
  plumb.bounds.forEach((value, i) => near(value, [2.5, 3.5, -1][i], 0.02));
});
