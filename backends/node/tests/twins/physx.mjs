// PhysX without Plumb.
import { readFileSync } from 'node:fs';
import { fileOf, load, scene, tell } from './scene.mjs';

// The package takes Node for a shell that it was not built for, and a page for a page.
const { process } = globalThis, wasmBinary = readFileSync(fileOf('physx-js-webidl', 'physx-js-webidl.wasm'));
const { default: PhysX } = await load('physx-js-webidl', 'physx-js-webidl.mjs');
globalThis.process = undefined;
globalThis.window = {};
const P = await PhysX({ wasmBinary });
globalThis.process = process;
delete globalThis.window;

const GYROSCOPIC = 1 << 10;  // PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, which the package does not name
const top = P.PxTopLevelFunctions.prototype, vec = (v) => new P.PxVec3(...v);
const frame = (position, orientation = [0, 0, 0, 1]) => new P.PxTransform(vec(position), new P.PxQuat(...orientation));
const foundation = top.CreateFoundation(P.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
const scales = new P.PxTolerancesScale(), physics = top.CreatePhysics(P.PHYSICS_VERSION, foundation, scales);
top.InitExtensions(physics);
const desc = new P.PxSceneDesc(scales);
desc.gravity = vec(scene.gravity);
desc.cpuDispatcher = top.DefaultCpuDispatcherCreate(0);
desc.filterShader = top.DefaultFilterShader();
desc.flags.raise(P.PxSceneFlagEnum.eENABLE_ENHANCED_DETERMINISM);
const world = physics.createScene(desc);

const flags = new P.PxShapeFlags(P.PxShapeFlagEnum.eSIMULATION_SHAPE), everything = new P.PxFilterData(1, 1, 0, 0);
const material = physics.createMaterial(scene.friction, scene.friction, 0);
const actors = scene.items.map((item) => {
  const place = frame(item.position, item.orientation), actor = item.still ? physics.createRigidStatic(place) : physics.createRigidDynamic(place);
  const shape = physics.createShape(item.sphere ? new P.PxSphereGeometry(item.half[0]) : new P.PxBoxGeometry(...item.half), material, true, flags);
  shape.setSimulationFilterData(everything);
  actor.attachShape(shape);
  if (!item.still) {
    actor.setMass(item.mass);
    actor.setMassSpaceInertiaTensor(vec(item.inertia));
    actor.setAngularDamping(0);
    actor.setMaxAngularVelocity(100);
    actor.setRigidBodyFlag(GYROSCOPIC, true);
    actor.setSleepThreshold(0);
    actor.setStabilizationThreshold(0);
  }
  world.addActor(actor);
  if (!item.still) {
    actor.setLinearVelocity(vec(item.velocity));
    actor.setAngularVelocity(vec(item.spin));
  }
  return actor;
});
for (const { hinge, a, b, inA, inB } of scene.joints) {
  const turn = hinge ? [0, -Math.SQRT1_2, 0, Math.SQRT1_2] : [0, 0, 0, 1];  // the joint's x axis is the hinge's
  const joint = top.D6JointCreate(physics, a < 0 ? null : actors[a], frame(inA, turn), actors[b], frame(inB, turn));
  const { eTWIST, eSWING1, eSWING2 } = P.PxD6AxisEnum;
  for (const axis of hinge ? [eTWIST] : [eTWIST, eSWING1, eSWING2]) joint.setMotion(axis, P.PxD6MotionEnum.eFREE);
}
for (let i = 0; i < scene.steps; ++i) {
  world.simulate(scene.dt);
  world.fetchResults(true);
}

const array = ({ x, y, z }) => [x, y, z];
tell(actors.filter((_, i) => !scene.items[i].still).map((actor) => {
  const { p, q } = actor.getGlobalPose(), place = [p.x, p.y, p.z, q.x, q.y, q.z, q.w];
  return [...place, ...array(actor.getLinearVelocity()), ...array(actor.getAngularVelocity())];
}));
