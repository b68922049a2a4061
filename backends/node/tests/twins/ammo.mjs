// Bullet as ammo.js without Plumb.
import { setFlagsFromString } from 'node:v8';
import { load, scene, tell } from './scene.mjs';

setFlagsFromString('--no-validate-asm');  // else all of it is compiled before any of it runs, which takes seconds
const { default: A } = await load('ammo.js', 'ammo.js'), vec = (v) => new A.btVector3(...v), DISABLE_DEACTIVATION = 4;
const rules = new A.btDefaultCollisionConfiguration(), dispatcher = new A.btCollisionDispatcher(rules);
const world = new A.btDiscreteDynamicsWorld(dispatcher, new A.btDbvtBroadphase(), new A.btSequentialImpulseConstraintSolver(), rules);
world.setGravity(vec(scene.gravity));
const frame = (position, [x, y, z, w]) => {
  const made = new A.btTransform();
  made.setIdentity();
  made.setOrigin(vec(position));
  made.setRotation(new A.btQuaternion(x, y, z, w));
  return made;
};
const bodyOf = (shape, mass, place, inertia) => new A.btRigidBody(new A.btRigidBodyConstructionInfo(mass, new A.btDefaultMotionState(place), shape, vec(inertia)));
const ground = bodyOf(new A.btSphereShape(1), 0, frame([0, 0, 0], [0, 0, 0, 1]), [0, 0, 0]);

const bodies = scene.items.map(({ still, sphere, half, position, orientation, mass, inertia, velocity, spin }) => {
  const shape = sphere ? new A.btSphereShape(half[0]) : new A.btBoxShape(vec(half));
  const body = bodyOf(shape, still ? 0 : mass, frame(position, orientation), still ? [0, 0, 0] : inertia);
  body.setFriction(Math.sqrt(scene.friction));  // Bullet multiplies the two
  world.addRigidBody(body);
  if (!still) {
    body.setLinearVelocity(vec(velocity));
    body.setAngularVelocity(vec(spin));
  }
  body.setActivationState(DISABLE_DEACTIVATION);
  return body;
});
for (const { hinge, a, b, inA, inB } of scene.joints) {
  const one = a < 0 ? ground : bodies[a], straight = [0, 0, 0, 1];  // a hinge of Bullet's turns about z
  const joint = hinge ? new A.btHingeConstraint(one, bodies[b], frame(inA, straight), frame(inB, straight), true) : new A.btPoint2PointConstraint(one, bodies[b], vec(inA), vec(inB));
  world.addConstraint(joint, a >= 0);
}
for (let i = 0; i < scene.steps; ++i) world.stepSimulation(scene.dt, 0);

const array = (v) => [v.x(), v.y(), v.z()];
tell(bodies.filter((_, i) => !scene.items[i].still).map((body) => {
  const place = body.getWorldTransform(), r = place.getRotation(), turn = [r.x(), r.y(), r.z(), r.w()], position = array(place.getOrigin());
  return [...position, ...turn, ...array(body.getLinearVelocity()), ...array(body.getAngularVelocity())];
}));
