import assert from 'node:assert/strict';
import { test } from 'node:test';
import { both, Stage, STATIC } from './engines.mjs';

test('collisions are told as by Havok', () => {
  const [plumb, havok] = both((stage) => {
    stage.ground();
    const body = stage.body(stage.ball(), [0, 2, 0]), told = { types: new Set(), own: 0, ended: 0, impulse: 0, up: 0 };
    body.setCollisionCallbackEnabled(true);
    stage.plugin.onCollisionObservable.add(({ type }) => told.types.add(type));
    body.getCollisionObservable().add(({ collider, normal, impulse, point }) => {
      told.own += collider === body ? 1 : 0;
      told.impulse = Math.max(told.impulse, impulse);
      told.up = Math.sign(normal.y);
      assert.ok(Math.abs(point.y) < 0.2);
    });
    stage.plugin.onCollisionEndedObservable.add(() => ++told.ended);
    stage.run(0.8);
    body.setLinearVelocity(body.getLinearVelocity().set(0, 5, 0));
    stage.run(0.3);
    return { ...told, types: [...told.types].sort() };
  });
  assert.deepEqual(plumb.types, havok.types);
  assert.equal(plumb.ended, havok.ended);
  assert.equal(plumb.up, havok.up);
  assert.ok(plumb.own > 0 && plumb.impulse > 1000);
});

test('a trigger tells who enters and leaves, and stops nobody', () => {
  const [plumb, havok] = both((stage) => {
    const gate = stage.box();
    gate.isTrigger = true;
    const sensor = stage.body(gate, [0, 0, 0], STATIC), body = stage.body(stage.ball(0.3), [0, 3, 0]), told = [];
    stage.plugin.onTriggerCollisionObservable.add(({ type, collider, collidedAgainst }) => {
      if (type !== 'TRIGGER_ENTERED' && type !== 'TRIGGER_EXITED') return;
      told.push(type);
      assert.ok([collider, collidedAgainst].includes(sensor) && [collider, collidedAgainst].includes(body));
    });
    stage.run(2);
    return [told, Math.round(body.transformNode.position.y)];
  });
  assert.deepEqual(plumb[0], ['TRIGGER_ENTERED', 'TRIGGER_EXITED']);
  assert.deepEqual(plumb[0], havok[0]);
  assert.ok(Math.abs(plumb[1] - havok[1]) <= 1);
});

test('nobody is told of what nobody asked for, nor of bodies that are gone', () => {
  const stage = new Stage('plumb');
  stage.ground();
  const body = stage.body(stage.ball(), [0, 0.5, 0]);
  let told = 0;
  stage.plugin.onCollisionObservable.add(() => ++told);
  stage.run(0.5);
  assert.equal(told, 0);
  body.setCollisionCallbackEnabled(true);
  stage.run(0.1);
  assert.ok(told > 0);
  body.dispose();
  stage.run(0.1);
  stage.end();
});
