// Rapier without Plumb: twins/rapier.mjs [PACKAGE].
import { load, scene, tell } from './scene.mjs';

const [, , name = '@dimforge/rapier3d-compat'] = process.argv;
const { default: whole, ...names } = await load(name, 'dist/rapier.mjs'), R = whole?.init ? whole : names;
await R.init();
const xyz = ([x, y, z]) => ({ x, y, z });
const world = new R.World(xyz(scene.gravity));
world.timestep = scene.dt;
const ground = world.createRigidBody(R.RigidBodyDesc.fixed());

const bodies = scene.items.map(({ still, sphere, half, position, orientation: [x, y, z, w], mass, inertia, velocity, spin }) => {
  const kind = still ? R.RigidBodyDesc.fixed() : R.RigidBodyDesc.dynamic();
  kind.setTranslation(...position).setRotation({ x, y, z, w }).setLinvel(...velocity).setAngvel(xyz(spin)).setCanSleep(false);
  if (!still) kind.setAdditionalMassProperties(mass, { x: 0, y: 0, z: 0 }, xyz(inertia), { x: 0, y: 0, z: 0, w: 1 });
  const body = world.createRigidBody(kind), shape = sphere ? R.ColliderDesc.ball(half[0]) : R.ColliderDesc.cuboid(...half);
  world.createCollider(shape.setDensity(0).setFriction(scene.friction), body);
  return body;
});
for (const { hinge, a, b, inA, inB } of scene.joints) {
  const joint = hinge ? R.JointData.revolute(xyz(inA), xyz(inB), { x: 0, y: 0, z: 1 }) : R.JointData.spherical(xyz(inA), xyz(inB));
  world.createImpulseJoint(joint, a < 0 ? ground : bodies[a], bodies[b], true).setContactsEnabled(a < 0);
}
for (let i = 0; i < scene.steps; ++i) world.step();

const array = ({ x, y, z }) => [x, y, z];
tell(bodies.filter((_, i) => !scene.items[i].still).map((body) => {
  const r = body.rotation();
  return [...array(body.translation()), r.x, r.y, r.z, r.w, ...array(body.linvel()), ...array(body.angvel())];
}));
