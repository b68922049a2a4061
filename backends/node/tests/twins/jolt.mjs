// Jolt without Plumb.
import { load, scene, tell } from './scene.mjs';

const { default: init } = await load('jolt-physics', 'dist/jolt-physics.wasm-compat.js'), J = await init();
const still = 0, moving = 1, settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(2), broad = new J.BroadPhaseLayerInterfaceTable(2, 2);
pairs.EnableCollision(still, moving);
pairs.EnableCollision(moving, moving);
for (const layer of [still, moving]) broad.MapObjectToBroadPhaseLayer(layer, new J.BroadPhaseLayer(layer));
Object.assign(settings, { mObjectLayerPairFilter: pairs, mBroadPhaseLayerInterface: broad, mObjectVsBroadPhaseLayerFilter: new J.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 2) });
const jolt = new J.JoltInterface(settings), system = jolt.GetPhysicsSystem(), make = system.GetBodyInterface();
const vec = (v) => new J.Vec3(...v), at = (v) => new J.RVec3(...v);
system.SetGravity(vec(scene.gravity));

const bodies = scene.items.map((item) => {
  const { half, mass, inertia } = item, rounding = Math.min(0.05, 0.5 * Math.min(...half));
  const shape = item.sphere ? new J.SphereShape(half[0]) : new J.BoxShape(vec(half), rounding);
  const body = new J.BodyCreationSettings(shape, at(item.position), new J.Quat(...item.orientation), item.still ? J.EMotionType_Static : J.EMotionType_Dynamic, item.still ? still : moving);
  Object.assign(body, { mFriction: scene.friction, mLinearDamping: 0, mAngularDamping: 0, mAllowSleeping: false, mApplyGyroscopicForce: true, mMaxLinearVelocity: 1e6 });
  if (!item.still) {
    Object.assign(body, { mLinearVelocity: vec(item.velocity), mAngularVelocity: vec(item.spin), mOverrideMassProperties: J.EOverrideMassProperties_MassAndInertiaProvided });
    body.mMassPropertiesOverride.mMass = mass;
    body.mMassPropertiesOverride.mInertia = J.Mat44.prototype.sScaleVec3(vec(inertia));
  }
  const made = make.CreateBody(body);
  make.AddBody(made.GetID(), J.EActivation_Activate);
  return made;
});
const groups = new J.GroupFilterTable(bodies.length);
for (const { hinge, a, b, inA, inB } of scene.joints) {
  const joint = hinge ? new J.HingeConstraintSettings() : new J.PointConstraintSettings();
  Object.assign(joint, { mSpace: J.EConstraintSpace_LocalToBodyCOM, mPoint1: at(inA), mPoint2: at(inB) });
  if (hinge) Object.assign(joint, { mHingeAxis1: vec([0, 0, 1]), mHingeAxis2: vec([0, 0, 1]), mNormalAxis1: vec([0, 1, 0]), mNormalAxis2: vec([0, 1, 0]) });
  system.AddConstraint(joint.Create(a < 0 ? jolt.sGetFixedToWorldBody() : bodies[a], bodies[b]));
  if (a >= 0) groups.DisableCollision(a, b);
}
if (scene.joints.length > 0)
  bodies.forEach((body, i) => {
    body.GetCollisionGroup().SetGroupFilter(groups);
    body.GetCollisionGroup().SetGroupID(0);
    body.GetCollisionGroup().SetSubGroupID(i);
  });
for (let i = 0; i < scene.steps; ++i) jolt.Step(scene.dt, 1);

const array = (v) => [v.GetX(), v.GetY(), v.GetZ()];
tell(bodies.filter((_, i) => !scene.items[i].still).map((body) => {
  const r = body.GetRotation(), turn = [r.GetX(), r.GetY(), r.GetZ(), r.GetW()], position = array(body.GetPosition());
  return [...position, ...turn, ...array(body.GetLinearVelocity()), ...array(body.GetAngularVelocity())];
}));
