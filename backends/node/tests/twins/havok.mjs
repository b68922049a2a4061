// Havok without Plumb.
import { readFileSync } from 'node:fs';
import { fileOf, load, scene, tell } from './scene.mjs';

const { default: HavokPhysics } = await load('@babylonjs/havok', 'lib/esm/HavokPhysics_es.js');
const hp = await HavokPhysics({ wasmBinary: readFileSync(fileOf('@babylonjs/havok', 'lib/esm/HavokPhysics.wasm')) });
const [, world] = hp.HP_World_Create(), { MaterialCombine: combine, ConstraintAxis: axis } = hp;
hp.HP_World_SetGravity(world, scene.gravity);
hp.HP_World_SetIdealStepTime(world, scene.dt);
hp.HP_World_SetSpeedLimit(world, 1e6, 1e6);
const [, ground] = hp.HP_Body_Create();
hp.HP_Body_SetMotionType(ground, hp.MotionType.STATIC);
hp.HP_World_AddBody(world, ground, false);

const bodies = scene.items.map(({ still, sphere, half, position, orientation, mass, inertia, velocity, spin }) => {
  const [, body] = hp.HP_Body_Create();
  const [, shape] = sphere ? hp.HP_Shape_CreateSphere([0, 0, 0], half[0]) : hp.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], half.map((h) => 2 * h));
  hp.HP_Shape_SetMaterial(shape, [scene.friction, scene.friction, 0, combine.GEOMETRIC_MEAN, combine.MAXIMUM]);
  hp.HP_Body_SetShape(body, shape);
  hp.HP_Body_SetMotionType(body, still ? hp.MotionType.STATIC : hp.MotionType.DYNAMIC);
  if (!still) hp.HP_Body_SetMassProperties(body, [[0, 0, 0], mass, inertia.map((i) => i / mass), [0, 0, 0, 1]]);
  hp.HP_Body_SetQTransform(body, [position, orientation]);
  hp.HP_Body_SetLinearDamping(body, 0);
  hp.HP_Body_SetAngularDamping(body, 0);
  if (!still) {
    hp.HP_Body_SetLinearVelocity(body, velocity);
    hp.HP_Body_SetAngularVelocity(body, spin);
  }
  hp.HP_World_AddBody(world, body, false);
  if (!still) hp.HP_Body_SetActivationControl(body, hp.ActivationControl.ALWAYS_ACTIVE);
  return body;
});
for (const { hinge, a, b, inA, inB } of scene.joints) {
  const [, joint] = hp.HP_Constraint_Create(), axes = hinge ? [[0, 0, 1], [0, 1, 0]] : [[1, 0, 0], [0, 1, 0]];  // a hinge turns about the first
  hp.HP_Constraint_SetParentBody(joint, a < 0 ? ground : bodies[a]);
  hp.HP_Constraint_SetChildBody(joint, bodies[b]);
  hp.HP_Constraint_SetAnchorInParent(joint, inA, ...axes);
  hp.HP_Constraint_SetAnchorInChild(joint, inB, ...axes);
  hp.HP_Constraint_SetCollisionsEnabled(joint, 0);
  const locked = [axis.LINEAR_X, axis.LINEAR_Y, axis.LINEAR_Z, ...(hinge ? [axis.ANGULAR_Y, axis.ANGULAR_Z] : [])];
  for (const one of locked) hp.HP_Constraint_SetAxisMode(joint, one, hp.ConstraintAxisLimitMode.LOCKED);
  hp.HP_Constraint_SetEnabled(joint, 1);
}
for (let i = 0; i < scene.steps; ++i) hp.HP_World_Step(world, scene.dt);

tell(bodies.filter((_, i) => !scene.items[i].still).map((body) =>
  [...hp.HP_Body_GetQTransform(body)[1].flat(), ...hp.HP_Body_GetLinearVelocity(body)[1], ...hp.HP_Body_GetAngularVelocity(body)[1]]));
