// cannon-es without Plumb.
import { load, scene, tell } from './scene.mjs';

const C = await load('cannon-es', 'dist/cannon-es.js'), vec = (v) => new C.Vec3(...v);
const world = new C.World({ gravity: vec(scene.gravity) }), ground = new C.Body({ type: C.Body.STATIC }), material = new C.Material();
// What cannon calls the largest force of friction bounds the impulse of a step.
world.addContactMaterial(new C.ContactMaterial(material, material, { friction: scene.friction * scene.dt, restitution: 0 }));
world.solver.iterations = 10;

const bodies = scene.items.map(({ still, sphere, half, position, orientation, mass, inertia, velocity, spin }) => {
  const body = new C.Body({ type: still ? C.Body.STATIC : C.Body.DYNAMIC, mass: still ? 0 : mass, position: vec(position), quaternion: new C.Quaternion(...orientation),
    material, linearDamping: 0, angularDamping: 0, shape: sphere ? new C.Sphere(half[0]) : new C.Box(vec(half)) });
  if (!still) {
    body.velocity.set(...velocity);
    body.angularVelocity.set(...spin);
    body.inertia.set(...inertia);
    body.invInertia.set(...inertia.map((i) => 1 / i));
    body.updateInertiaWorld(true);
  }
  world.addBody(body);
  return body;
});
for (const { hinge, a, b, inA, inB } of scene.joints) {
  const one = a < 0 ? ground : bodies[a], about = { axisA: vec([0, 0, 1]), axisB: vec([0, 0, 1]) };
  world.addConstraint(hinge ? new C.HingeConstraint(one, bodies[b], { pivotA: vec(inA), pivotB: vec(inB), ...about, collideConnected: a < 0 })
    : Object.assign(new C.PointToPointConstraint(one, vec(inA), bodies[b], vec(inB)), { collideConnected: a < 0 }));
}
for (let i = 0; i < scene.steps; ++i) world.step(scene.dt);

const array = ({ x, y, z }) => [x, y, z];
tell(bodies.filter((_, i) => !scene.items[i].still).map(({ position, quaternion: { x, y, z, w }, velocity, angularVelocity }) =>
  [...array(position), x, y, z, w, ...array(velocity), ...array(angularVelocity)]));
