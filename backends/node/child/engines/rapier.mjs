// Rapier (dimforge): package @dimforge/rapier3d-compat. rapier-simd.mjs beside it is the same of another package.
import { FIXED, BALL, HINGE, SLIDER, DISTANCE, UNIVERSAL, GENERIC, LOCKED, LIMITED,
  SPHERE, BOX, CAPSULE, CYLINDER, HULL, MESH, HEIGHT_FIELD, PLANE,
  STATIC, DYNAMIC, SENSOR, CCD, NO_ROTATION, ASLEEP, NEVER_SLEEPS, meshOfHeightField } from '../rows.mjs';
import { add, rotate, scale } from '../algebra.mjs';
import { USUAL, WorldBase, boolSetting, floatSetting, intSetting, refuse } from '../base.mjs';
import { load, missing, versionOf } from '../packages.mjs';

const TOUCH = 1e-4;  // m: contacts are told before they touch

const vector = ([x, y, z]) => ({ x, y, z });
const quaternion = ([x, y, z, w]) => ({ x, y, z, w });
const array = ({ x, y, z }) => [x, y, z];

const settings = [
  intSetting('iterations', 'quality', [1, 1000], 4, 'sub-steps of the solver', { unit: '1' }),
  intSetting('pgs_iterations', 'quality', [1, 100], 1, 'sweeps over the contacts in each', { unit: '1' }),
  intSetting('ccd_substeps', 'quality', [0, 100], 1, 'impacts of fast bodies that one step resolves', { unit: '1' }),
  floatSetting('contact_frequency', 'behaviour', [1, 1e4], 30, 'stiffness of contacts', { unit: 'Hz' }),
  floatSetting('allowed_error', 'behaviour', [0, 1], 0.005, 'overlap that is left alone', { unit: 'm' }),
  floatSetting('prediction', 'behaviour', [0, 10], 0.02, 'distance at which contacts are found before they touch', { unit: 'm' }),
  boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
];

const GENERIC_NOTE = 'angles as the imaginary parts of the relative quaternion: right near zero';

function manifestOf(name) {
  return {
    version: versionOf(name), unmet: missing(name), description: 'Rapier by Dimforge, WebAssembly', precision: 'f32', deterministic: true,
    settings,
    capabilities: [
      ...USUAL,
      ['shape', 'plane', 'static', 'native'],
      ['shape', 'mesh', 'kinematic', 'native'],
      ['joint', 'ball|hinge|slider|fixed', '*', 'native'],
      ['joint', 'universal', '*', 'none', 'Rapier does not hold two axes square while both turn'],
      ['joint', 'generic', '*', 'approximate', GENERIC_NOTE],
      ['joint_feature', 'hinge|slider|generic', 'limits|motors|springs|stiffness', 'native'],
      ['query', '*', '*', 'native', 'over all colliders'],
      ['need', 'rotation', '*', 'approximate', 'the spin of a free ball drifts by about 4e-5 of itself a second'],
      ['write', 'damping|filter|awake', '*', 'native'],
      ['need', 'joints|ccd|sleeping|events|contacts|sensors|damping|axis_locks|filters|queries', '*', 'native'],
      ['event', 'contact_begin|contact_end|sensor_enter|sensor_leave|wake|sleep', '*', 'emulated', 'by comparing one step with the next'],
      ['child_material', '*', '*', 'native'],
    ],
  };
}

async function createWorldOf(name, init) {
  const { default: module, ...names } = await load(name, 'dist/rapier.mjs');
  const R = module?.init ? module : names;
  await R.init();
  return new RapierWorld(R, init);
}

/** What host.mjs asks of an engine, for a package of Rapier's. */
export const adapter = (name) => ({ manifest: () => manifestOf(name), createWorld: (init) => createWorldOf(name, init) });
export const { manifest, createWorld } = adapter('@dimforge/rapier3d-compat');

class RapierWorld extends WorldBase {
  constructor(R, init) {
    super(init);
    this.R = R;
    this.world = new R.World(vector(init.gravity));
    this.owners = new Map();  // collider handle to { slot, child }
    this.byHandle = new Map();  // body handle to slot
    this.hooks = {
      filterContactPair: (c1, c2, b1, b2) => (this.collides(this.byHandle.get(b1), this.byHandle.get(b2)) ? R.SolverFlags.COMPUTE_IMPULSE : null),
      filterIntersectionPair: (c1, c2, b1, b2) => this.collides(this.byHandle.get(b1), this.byHandle.get(b2)),
    };
    this.queue = new R.EventQueue(true);  // Rapier looks at hooks only beside one
    this.ground = this.world.createRigidBody(R.RigidBodyDesc.fixed());
    this.applySettings({});
  }

  applySettings(changed) {
    super.applySettings(changed);
    const s = this.settings, p = this.world.integrationParameters;
    p.numSolverIterations = s.iterations;
    p.numInternalPgsIterations = s.pgs_iterations;
    p.maxCcdSubsteps = s.ccd_substeps;
    p.contact_natural_frequency = s.contact_frequency;
    p.normalizedAllowedLinearError = s.allowed_error;
    p.normalizedPredictionDistance = s.prediction;
  }
  setGravity(gravity) { this.world.gravity = vector(gravity); }

  // --- shapes and bodies ---------------------------------------------------------------------------------------------

  createShape(desc) {
    const shape = desc.type === 8 ? null : this.shapeOf(desc);
    this.shapes.set(desc.slot, { desc, shape });
  }
  shapeOf(desc) {
    const R = this.R;
    switch (desc.type) {
      case SPHERE: return new R.Ball(desc.radius);
      case BOX: return new R.Cuboid(...desc.halfExtents);
      case CAPSULE: return new R.Capsule(desc.halfHeight, desc.radius);
      case CYLINDER: return new R.Cylinder(desc.halfHeight, desc.radius);
      case HULL: return R.ColliderDesc.convexHull(Float32Array.from(desc.vertices))?.shape ?? refuse('Rapier finds no hull of these points');
      case MESH: return new R.TriMesh(Float32Array.from(desc.vertices), desc.indices, R.TriMeshFlags.FIX_INTERNAL_EDGES);
      case HEIGHT_FIELD: {
        const { vertices, indices } = meshOfHeightField(desc);
        return new R.TriMesh(vertices, indices, R.TriMeshFlags.FIX_INTERNAL_EDGES);
      }
      case PLANE: return new R.HalfSpace({ x: 0, y: 1, z: 0 });
      default: return refuse(`shapes of type ${desc.type}`);
    }
  }

  createBody(desc) {
    const R = this.R;
    const kind = [R.RigidBodyDesc.fixed, R.RigidBodyDesc.kinematicVelocityBased, R.RigidBodyDesc.dynamic][desc.motion]();
    kind.setTranslation(...desc.pose.position).setRotation(quaternion(desc.pose.orientation));
    if (desc.motion !== STATIC) kind.setLinvel(...desc.linear).setAngvel(vector(desc.angular));
    kind.setGravityScale(desc.gravityScale).setLinearDamping(desc.linearDamping).setAngularDamping(desc.angularDamping);
    kind.setCcdEnabled((desc.flags & CCD) !== 0);
    kind.setCanSleep(this.needs.has('sleeping') && this.settings.sleeping && (desc.flags & NEVER_SLEEPS) === 0);
    if (desc.motion === DYNAMIC)
      kind.setAdditionalMassProperties(desc.mass, vector(desc.centre), vector(desc.inertia), quaternion(desc.inertiaOrientation));
    const free = (bit) => (desc.locks & bit) === 0, turns = (desc.flags & NO_ROTATION) === 0;
    const body = this.world.createRigidBody(kind);
    body.setEnabledTranslations(free(1), free(2), free(4), false);
    body.setEnabledRotations(turns && free(8), turns && free(16), turns && free(32), false);
    this.bodies.set(desc.slot, { desc, body, colliders: [] });
    this.byHandle.set(body.handle, desc.slot);
    if (desc.shape >= 0) this.parts(desc.shape).forEach((part, child) => this.attach(desc, body, part, child));
    if ((desc.flags & ASLEEP) !== 0) body.sleep();
  }
  attach(desc, body, part, child) {
    const R = this.R, material = part.material ?? desc.material;
    const kind = new R.ColliderDesc(this.shapes.get(part.slot).shape).setDensity(0);
    kind.setTranslation(...part.pose.position).setRotation(quaternion(part.pose.orientation));
    kind.setFriction(Math.sqrt(material.friction)).setFrictionCombineRule(R.CoefficientCombineRule.Multiply);
    kind.setRestitution(material.restitution).setRestitutionCombineRule(R.CoefficientCombineRule.Max);
    kind.setSensor((desc.flags & SENSOR) !== 0);
    if (this.needs.has('sensors')) kind.setActiveCollisionTypes(R.ActiveCollisionTypes.ALL);
    if (this.needs.has('filters')) kind.setActiveHooks(R.ActiveHooks.FILTER_CONTACT_PAIRS | R.ActiveHooks.FILTER_INTERSECTION_PAIRS);
    const collider = this.world.createCollider(kind, body);
    this.owners.set(collider.handle, { slot: desc.slot, child: this.parts(desc.shape).length > 1 ? child : 0 });
    this.bodies.get(desc.slot).colliders.push({ collider, ownMaterial: part.material !== null });
  }
  destroyBody(slot) {
    const { body, colliders } = this.bodies.get(slot);
    for (const { collider } of colliders) this.owners.delete(collider.handle);
    this.byHandle.delete(body.handle);
    this.world.removeRigidBody(body);
    this.bodies.delete(slot);
  }

  pose(slot) {
    const { body } = this.bodies.get(slot), r = body.rotation();
    return [...array(body.translation()), r.x, r.y, r.z, r.w];
  }
  velocity(slot) {
    const { body } = this.bodies.get(slot);
    return [...array(body.linvel()), ...array(body.angvel())];
  }
  awake(slot) {
    const { desc, body } = this.bodies.get(slot);
    return [desc.motion === DYNAMIC && body.isSleeping() ? 0 : 1];
  }
  setPose(slot, position, orientation) {
    const { body } = this.bodies.get(slot);
    body.setTranslation(vector(position), true);
    body.setRotation(quaternion(orientation), true);
  }
  setVelocity(slot, linear, angular) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    body.setLinvel(vector(linear), true);
    body.setAngvel(vector(angular), true);
  }
  setAwake(slot, awake) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return;
    if (awake) body.wakeUp();
    else body.sleep();
  }
  setMaterial(slot, friction, restitution) {
    for (const { collider, ownMaterial } of this.bodies.get(slot).colliders) {
      if (ownMaterial) continue;
      collider.setFriction(Math.sqrt(friction));
      collider.setRestitution(restitution);
    }
  }
  setGravityScale(slot, factor) { this.bodies.get(slot).body.setGravityScale(factor, true); }
  setDamping(slot, linear, angular) {
    const { body } = this.bodies.get(slot);
    body.setLinearDamping(linear);
    body.setAngularDamping(angular);
  }
  setFilter(slot, filter) {
    this.bodies.get(slot).desc.filter = filter;
    this.hook(slot);
  }
  setException(a, b, touch) {
    super.setException(a, b, touch);
    for (const slot of [a, b]) {
      this.hook(slot);
      if (this.bodies.get(slot).desc.motion === DYNAMIC) this.bodies.get(slot).body.wakeUp();
    }
  }
  hook(slot) {
    const R = this.R;
    for (const { collider } of this.bodies.get(slot).colliders)
      collider.setActiveHooks(R.ActiveHooks.FILTER_CONTACT_PAIRS | R.ActiveHooks.FILTER_INTERSECTION_PAIRS);
  }
  addForce(slot, force, torque) {
    const { body } = this.bodies.get(slot);
    body.addForce(vector(force), true);
    body.addTorque(vector(torque), true);
    (this.pushed ??= []).push(slot);
  }

  // --- step ----------------------------------------------------------------------------------------------------------

  step(dt) {
    this.world.timestep = dt;
    this.world.step(this.queue, this.hooks);
  }
  afterStep() {
    for (const slot of this.pushed ?? []) {
      this.bodies.get(slot)?.body.resetForces(false);
      this.bodies.get(slot)?.body.resetTorques(false);
    }
    this.pushed = [];
    this.rows = null;
    return {
      touching: this.tellsTouches ? this.touching() : [],
      contacts: this.needs.has('contacts') ? this.contacts().length / 16 : NaN,
    };
  }
  eachPair(visit) {
    for (const [slot, { colliders }] of this.bodies)
      for (const { collider } of colliders)
        this.world.contactPairsWith(collider, (other) => {
          if (collider.handle < other.handle) visit(collider, other, slot, this.owners.get(other.handle).slot);
        });
  }
  touching() {
    const pairs = [];
    this.eachPair((one, two, a, b) => {
      let near = false;
      this.world.contactPair(one, two, (manifold) => {
        for (let i = 0; i < manifold.numContacts(); ++i) near ||= manifold.contactDist(i) < TOUCH;
      });
      if (near) pairs.push(a, b);
    });
    for (const [slot, { desc, colliders }] of this.bodies) {
      if ((desc.flags & SENSOR) === 0) continue;
      for (const { collider } of colliders)
        this.world.intersectionPairsWith(collider, (other) => {
          const b = this.owners.get(other.handle).slot;
          if (this.collides(slot, b)) pairs.push(slot, b);
        });
    }
    return pairs;
  }
  contacts() { return (this.rows ??= this.contactRows()); }
  contactRows() {
    const rows = [];
    this.eachPair((one, two, a, b) => {
      this.world.contactPair(one, two, (manifold, flipped) => {
        const normal = scale(flipped ? -1 : 1, array(manifold.normal()));
        const [first, local] = flipped ? [two, 'localContactPoint1'] : [one, 'localContactPoint1'];
        const q = first.rotation(), at = array(first.translation());
        for (let i = 0; i < manifold.numContacts(); ++i) {
          const distance = manifold.contactDist(i);
          const point = add(at, rotate([q.x, q.y, q.z, q.w], array(manifold[local](i))));
          const middle = add(point, scale(0.5 * distance * (flipped ? -1 : 1), normal));
          rows.push(a, b, this.owners.get(one.handle).child, this.owners.get(two.handle).child, ...middle, ...normal,
            -distance, manifold.contactImpulse(i), NaN, NaN, NaN, 0);
        }
      });
    });
    return rows;
  }

  // --- joints: all as Rapier's generic joint --------------------------------------------------------------------------

  createJoint(desc) {
    const R = this.R, a = desc.a < 0 ? this.ground : this.bodies.get(desc.a).body, b = this.bodies.get(desc.b).body;
    const modes = axisModes(desc);
    let mask = 0;
    modes.forEach((mode, axis) => { if (mode === LOCKED) mask |= 1 << axis; });
    const data = R.JointData.generic(vector(desc.frameA.position), vector(desc.frameB.position), { x: 1, y: 0, z: 0 }, mask);
    const joint = this.world.createImpulseJoint(data, a, b, true);
    joint.setLocalFrame1(vector(desc.frameA.position), quaternion(desc.frameA.orientation));
    joint.setLocalFrame2(vector(desc.frameB.position), quaternion(desc.frameB.orientation));
    joint.setContactsEnabled(desc.collideConnected || desc.a < 0);
    modes.forEach((mode, axis) => {
      const { limit } = desc.axes[axis];
      if (mode === LIMITED) joint.rawSet.jointSetLimits(joint.handle, axis, limit.lower, limit.upper);
    });
    this.joints.set(desc.slot, { desc, joint });
    this.drive(desc, joint);
  }
  drive(desc, joint) {
    const R = this.R;
    desc.axes.forEach(({ motor, spring }, axis) => {
      const raw = joint.rawSet, handle = joint.handle;
      if (motor.enabled && spring.enabled) refuse('a motor and a spring on one axis of a joint');
      if (motor.enabled) {
        raw.jointConfigureMotorModel(handle, axis, R.MotorModel.ForceBased);
        raw.jointConfigureMotorVelocity(handle, axis, motor.target, 1e9);
        raw.jointSetMotorMaxForce(handle, axis, motor.most);
      } else if (spring.enabled) {
        const w = 2 * Math.PI * spring.frequency, byForce = spring.byStiffness;
        raw.jointConfigureMotorModel(handle, axis, byForce ? R.MotorModel.ForceBased : R.MotorModel.AccelerationBased);
        raw.jointConfigureMotor(handle, axis, spring.rest, 0, byForce ? spring.frequency : w * w, byForce ? spring.ratio : 2 * spring.ratio * w);
        raw.jointSetMotorMaxForce(handle, axis, 3e38);
      } else {
        raw.jointConfigureMotor(handle, axis, 0, 0, 0, 0);
        raw.jointSetMotorMaxForce(handle, axis, 0);
      }
    });
  }
  setMotors(slot, motors) {
    const { desc, joint } = this.joints.get(slot);
    desc.axes.forEach((axis, i) => { axis.motor = motors[i]; });
    this.drive(desc, joint);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
  destroyJoint(slot) {
    this.world.removeImpulseJoint(this.joints.get(slot).joint, true);
    this.joints.delete(slot);
  }

  // --- queries -------------------------------------------------------------------------------------------------------

  // Over all colliders: Rapier's tree does not know who came or was moved since the last step.

  /** Calls visit(collider, slot, child) for all that a filter sees. */
  eachSeen(filter, visit) {
    for (const [slot, { colliders }] of this.bodies)
      if (this.sees(filter, slot))
        for (const { collider } of colliders) visit(collider, slot, this.owners.get(collider.handle).child);
  }
  castRay({ origin, translation, filter }) {
    const ray = new this.R.Ray(vector(origin), vector(translation)), hits = [];
    this.eachSeen(filter, (collider, body, child) => {
      const hit = collider.castRayAndGetNormal(ray, 1, true);
      if (hit === null) return;
      const fraction = hit.timeOfImpact;
      hits.push({ body, child, fraction, position: add(origin, scale(fraction, translation)), normal: array(hit.normal) });
    });
    return hits;
  }
  castShape({ shape, pose, translation, filter }) {
    const cast = this.shapes.get(shape).shape, still = vector([0, 0, 0]), hits = [];
    this.eachSeen(filter, (collider, body, child) => {
      const hit = collider.castShape(still, cast, vector(pose.position), quaternion(pose.orientation), vector(translation), 0, 1, true);
      if (hit === null) return;
      const place = collider.translation(), turned = collider.rotation();
      const turn = [turned.x, turned.y, turned.z, turned.w];
      hits.push({ body, child, fraction: hit.time_of_impact, position: add(array(place), rotate(turn, array(hit.witness1))),
        normal: rotate(turn, array(hit.normal1)) });
    });
    return hits;
  }
  overlapShape({ shape, pose, filter }) {
    const over = this.shapes.get(shape).shape, hits = [];
    this.eachSeen(filter, (collider, body, child) => {
      if (collider.intersectsShape(over, vector(pose.position), quaternion(pose.orientation))) hits.push({ body, child });
    });
    return hits;
  }
}

/** Of each of the six axes: free, locked or limited. */
function axisModes(desc) {
  const free = { [BALL]: [3, 4, 5], [HINGE]: [3], [SLIDER]: [0], [FIXED]: [], [UNIVERSAL]: [3, 4] }[desc.type];
  if (desc.type === DISTANCE) refuse('distance joints');
  return desc.axes.map(({ mode, limit }, axis) => {
    if (desc.type === GENERIC) return mode;
    if (!free.includes(axis)) return LOCKED;
    return limit.enabled ? LIMITED : 0;
  });
}
