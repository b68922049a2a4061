// ammo.js, Bullet 2.8 compiled to JavaScript: package ammo.js.
import { setFlagsFromString } from 'node:v8';
import { BALL, BOX, CAPSULE, CCD, CYLINDER, DYNAMIC, FIXED, GENERIC, HEIGHT_FIELD, HINGE, HULL, KINEMATIC, LIMITED, LOCKED, MESH,
  NEVER_SLEEPS, NO_ROTATION, PLANE, SENSOR, SLIDER, SPHERE, STATIC, ASLEEP, meshOfHeightField } from '../rows.mjs';
import { add, compose, inverse, multiply, pairKey, scale } from '../algebra.mjs';
import { USUAL, WorldBase, SUBSTEPS, boolSetting, choiceSetting, floatSetting, inFrame, principalFrame, refuse } from '../base.mjs';
import { load, missing, versionOf } from '../packages.mjs';

const PACKAGE = 'ammo.js';
const ISLAND_SLEEPING = 2, DISABLE_DEACTIVATION = 4, KINEMATIC_OBJECT = 2, NO_CONTACT_RESPONSE = 4, EVERYTHING = -1;
const TOUCH = 1e-3;  // m: contacts are told before they touch
const Z_TO_X = [0, Math.SQRT1_2, 0, Math.SQRT1_2];  // Bullet's hinges turn about z
const array = (v) => [v.x(), v.y(), v.z()];

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'ammo.js: Bullet in JavaScript', device: 'js', precision: 'f32', deterministic: true,
    settings: [
      SUBSTEPS,
      floatSetting('margin', 'behaviour', [0, 1], 0.04, 'rounding of boxes and cylinders; around a hull it would lie outside, which has none', { unit: 'm', creation_only: true }),
      choiceSetting('compile', 'speed', ['as_it_runs', 'ahead'], 'ahead: all of it, for some seconds at the start of a world; what comes out is the same', { creation_only: true }),
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
    ],
    capabilities: [
      ...USUAL,
      ['need', 'restitution', '*', 'approximate', 'Bullet multiplies the two: the larger where all that is dynamic has the same, else the geometric mean'],
      ['need', 'friction', '*', 'approximate', 'right on the mean, it swings about that from step to step'],
      ['joint', 'ball|hinge|slider|generic', '*', 'native'],
      ['joint', 'fixed', '*', 'emulated', 'by the constraint of six axes'],
      ['shape', 'plane', 'static', 'native'],
      ['pair', 'capsule', 'mesh|height_field', 'approximate', 'a capsule that lies on triangles begins to roll by itself, at .1 m/s after two seconds'],
      ['joint_feature', 'hinge|slider', 'limits', 'native'],
      ['joint_feature', 'hinge', 'motors', 'native'],
      ['write', 'damping|awake', '*', 'native'],
      ['need', 'joints|sleeping|damping|axis_locks|events|contacts|sensors', '*', 'native'],
      ['need', 'ccd', '*', 'approximate', 'a sphere within the body is swept; not while the body has exceptions, which Bullet does not ask of'],
      ['event', 'contact_begin|contact_end|sensor_enter|sensor_leave|wake|sleep', '*', 'emulated', 'by comparing one step with the next'],
    ],
  };
}

/** As asm.js all of it is compiled before any of it runs, which on few cores takes seconds. */
export async function createWorld(init) {
  if (init.settings.compile === 'as_it_runs') setFlagsFromString('--no-validate-asm');
  const { default: Ammo } = await load(PACKAGE, 'ammo.js');  // loaded means ready: nothing in it waits
  return new AmmoWorld(Ammo, init);
}

class AmmoWorld extends WorldBase {
  constructor(A, init) {
    super(init);
    this.A = A;
    this.temporary = [];
    this.most = 0;  // restitution of what is dynamic
    this.bounces = false;  // whether anything has any
    this.slots = new Map();  // a body's place in memory to its slot
    this.apart = new Map();  // pairs that are excepted, to constraints
    const rules = new A.btDefaultCollisionConfiguration();
    this.dispatcher = new A.btCollisionDispatcher(rules);
    this.world = new A.btDiscreteDynamicsWorld(this.dispatcher, new A.btDbvtBroadphase(), new A.btSequentialImpulseConstraintSolver(), rules);
    this.owned = [];
    this.ground = this.makeBody(new A.btSphereShape(1), 0, { position: [0, 0, 0], orientation: [0, 0, 0, 1] }, [0, 0, 0]);
    this.setGravity(init.gravity);
  }
  vec([x, y, z]) { return this.keep(new this.A.btVector3(x, y, z)); }
  transform({ position, orientation: [x, y, z, w] }) {
    const n = 1 / Math.hypot(x, y, z, w), made = this.keep(new this.A.btTransform());
    made.setIdentity();
    made.setOrigin(this.vec(position));
    made.setRotation(this.keep(new this.A.btQuaternion(n * x, n * y, n * z, n * w)));
    return made;
  }
  keep(object) { return this.temporary.push(object), object; }
  sweep() {
    for (const object of this.temporary) this.A.destroy(object);
    this.temporary = [];
  }
  setGravity(gravity) {
    this.gravity = gravity;
    this.world.setGravity(this.vec(gravity));  // what is scaled is given the rest as a force
    for (const slot of this.bodies.keys()) this.setAwake(slot, true);
    this.sweep();
  }

  /** Of what is made for a body, all goes with it. */
  own(object) { return this.owned.push(object), object; }
  makeShape(desc) { return this.own(this.newShape(desc)); }
  newShape(desc) {
    const A = this.A, { margin } = this.settings;
    let shape;
    switch (desc.type) {
      case PLANE: return new A.btStaticPlaneShape(this.vec([0, 1, 0]), 0);
      case SPHERE: return new A.btSphereShape(desc.radius);
      case BOX: shape = new A.btBoxShape(this.vec(desc.halfExtents)); break;
      case CAPSULE: return desc.halfHeight === 0 ? new A.btSphereShape(desc.radius) : new A.btCapsuleShape(desc.radius, 2 * desc.halfHeight);
      case CYLINDER: shape = new A.btCylinderShape(this.vec([desc.radius, desc.halfHeight, desc.radius])); break;
      case HULL:
        shape = new A.btConvexHullShape();
        for (let i = 0; i < desc.vertices.length; i += 3) shape.addPoint(this.vec(desc.vertices.subarray(i, i + 3)));
        break;
      case MESH:
      case HEIGHT_FIELD: {
        const { vertices, indices } = desc.type === MESH ? desc : meshOfHeightField(desc), mesh = this.own(new A.btTriangleMesh());
        const corner = (k) => this.vec(vertices.subarray(3 * indices[k], 3 * indices[k] + 3));
        for (let i = 0; i < indices.length; i += 3) mesh.addTriangle(corner(i), corner(i + 1), corner(i + 2), false);
        return new A.btBvhTriangleMeshShape(mesh, true, true);
      }
      default: return refuse(`shapes of type ${desc.type}`);
    }
    shape.setMargin(desc.type === HULL ? 0 : margin);
    return shape;
  }
  /** Bullet's bodies have their origin at the centre of mass, and their axes along the principal ones. */
  shapeOfBody(desc, frame) {
    const A = this.A;
    const parts = desc.shape < 0 ? [] : this.parts(desc.shape);
    const plain = parts.length === 1 && [...frame.position, ...parts[0].pose.position].every((x) => x === 0) &&
      Math.abs(multiply(inverse(frame).orientation, parts[0].pose.orientation)[3]) === 1;
    if (plain) return this.makeShape(parts[0].desc);
    const whole = this.own(new A.btCompoundShape(true));
    for (const part of parts) whole.addChildShape(this.transform(inFrame(frame, part.pose)), this.makeShape(part.desc));
    return whole;
  }
  makeBody(shape, mass, place, inertia) {
    const A = this.A, state = this.own(new A.btDefaultMotionState(this.transform(place)));
    const info = new A.btRigidBodyConstructionInfo(mass, state, shape, this.vec(inertia)), body = new A.btRigidBody(info);
    A.destroy(info);
    return body;
  }

  createBody(desc) {
    const A = this.A, frame = principalFrame(desc), moves = desc.motion === DYNAMIC, still = (desc.flags & NO_ROTATION) !== 0;
    this.owned = [];
    const body = this.makeBody(this.shapeOfBody(desc, frame), moves ? desc.mass : 0, compose(desc.pose, frame), moves && !still ? desc.inertia : [0, 0, 0]);
    this.bodies.set(desc.slot, { desc, body, frame, owned: this.owned });
    this.slots.set(this.A.getPointer(body), desc.slot);
    this.setMaterial(desc.slot, desc.material.friction, desc.material.restitution);
    this.setDamping(desc.slot, desc.linearDamping, desc.angularDamping);
    if (desc.motion === KINEMATIC) body.setCollisionFlags(body.getCollisionFlags() | KINEMATIC_OBJECT);
    const free = (bits) => this.vec(bits.map((bit) => (desc.locks & bit ? 0 : 1)));
    body.setLinearFactor(free([1, 2, 4]));
    body.setAngularFactor(still ? this.vec([0, 0, 0]) : free([8, 16, 32]));
    if ((desc.flags & SENSOR) !== 0) body.setCollisionFlags(body.getCollisionFlags() | NO_CONTACT_RESPONSE);
    this.hang(desc, body);
    this.sweepFast(desc.slot);
    if (desc.motion !== STATIC) {
      body.setLinearVelocity(this.vec(desc.linear));
      body.setAngularVelocity(this.vec(desc.angular));
    }
    const sleeps = this.needs.has('sleeping') && this.settings.sleeping && (desc.flags & NEVER_SLEEPS) === 0;
    if (!sleeps || desc.motion === KINEMATIC) body.setActivationState(DISABLE_DEACTIVATION);
    else if ((desc.flags & ASLEEP) !== 0) body.setActivationState(ISLAND_SLEEPING);
    this.sweep();
  }
  sweepFast(slot) {
    const { desc, body } = this.bodies.get(slot);
    if ((desc.flags & CCD) === 0 || desc.shape < 0) return;
    const excepted = Array.from(this.apart.keys()).some((key) => [Math.floor(key / 4294967296), key % 4294967296].includes(slot));
    const inner = excepted ? 0 : Math.min(...this.parts(desc.shape).map((part) => innerRadius(part.desc)));
    body.setCcdMotionThreshold(0.5 * inner);  // 0: never
    body.setCcdSweptSphereRadius(0.5 * inner);
  }
  hang(desc, body) {
    if ((desc.flags & SENSOR) !== 0) this.world.addRigidBody(body, 1, EVERYTHING);
    else this.world.addRigidBody(body);
  }
  /** A pair that has a manifold goes on by it, whoever has said since that the two do not touch. */
  forgetPair(a, b) {
    for (let i = 0, count = this.dispatcher.getNumManifolds(); i < count; ++i) {
      const manifold = this.dispatcher.getManifoldByIndexInternal(i), key = pairKey(...[manifold.getBody0(), manifold.getBody1()].map((body) => this.slots.get(this.A.getPointer(body)) ?? -1));
      if (key !== pairKey(a, b)) continue;
      const slot = this.bodies.get(a).desc.motion === DYNAMIC ? a : b, { desc, body } = this.bodies.get(slot);
      this.world.removeRigidBody(body);
      return this.hang(desc, body);
    }
  }
  destroyBody(slot) {
    const { body, owned } = this.bodies.get(slot);
    this.world.removeRigidBody(body);
    this.slots.delete(this.A.getPointer(body));
    for (const object of [body, ...owned.reverse()]) this.A.destroy(object);
    this.bodies.delete(slot);
    for (const other of this.bodies.keys()) this.setAwake(other, true);
  }
  pose(slot) {
    const { body, frame } = this.bodies.get(slot), place = body.getWorldTransform(), position = array(place.getOrigin()), r = place.getRotation();
    const pose = compose({ position, orientation: [r.x(), r.y(), r.z(), r.w()] }, inverse(frame));
    return [...pose.position, ...pose.orientation];
  }
  velocity(slot) {
    const { body } = this.bodies.get(slot), linear = array(body.getLinearVelocity());
    return [...linear, ...array(body.getAngularVelocity())];
  }
  awake(slot) {
    const { body, desc } = this.bodies.get(slot);
    return [desc.motion !== DYNAMIC || body.isActive() ? 1 : 0];
  }
  setPose(slot, position, orientation) {
    const { body, frame } = this.bodies.get(slot), place = this.transform(compose({ position, orientation }, frame));
    body.setWorldTransform(place);
    body.setCenterOfMassTransform(place);
    body.getMotionState().setWorldTransform(place);
    this.setAwake(slot, true);
    this.sweep();
  }
  setVelocity(slot, linear, angular) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    this.setAwake(slot, true);
    body.setLinearVelocity(this.vec(linear));
    body.setAngularVelocity(this.vec(angular));
    this.sweep();
  }
  setAwake(slot, awake) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return;
    if (awake) body.activate(true);
    else body.forceActivationState(ISLAND_SLEEPING);
  }
  setMaterial(slot, friction, restitution) {
    const { body, desc } = this.bodies.get(slot);
    Object.assign(desc.material, { friction, restitution });
    body.setFriction(Math.sqrt(friction));
    const most = desc.motion === DYNAMIC ? Math.max(this.most, restitution) : this.most, bounces = this.bounces || restitution > 0;
    if (most === this.most && bounces === this.bounces) return body.setRestitution(this.factor(desc));
    Object.assign(this, { most, bounces });
    for (const other of this.bodies.values()) other.body.setRestitution(this.factor(other.desc));
  }
  /** So that what is dynamic and what is not come to the larger of the two, where all that is dynamic has the same. */
  factor({ motion, material: { restitution } }) {
    if (!this.bounces) return 0;
    const root = (e) => Math.sqrt(Math.max(e, 1e-6));
    return motion === DYNAMIC ? root(restitution) : Math.max(restitution, this.most) / root(this.most);
  }
  setGravityScale(slot, factor) {
    this.bodies.get(slot).desc.gravityScale = factor;
    this.setAwake(slot, true);
  }
  // Bullet takes v (1 - d)^dt; ours is v exp(-c dt).
  setDamping(slot, linear, angular) { this.bodies.get(slot).body.setDamping(-Math.expm1(-linear), -Math.expm1(-angular)); }
  addForce(slot, force, torque) { (this.pushes ??= []).push({ slot, force, torque }); }

  step(dt) {
    const h = dt / this.settings.substeps;
    if (h !== this.h) {
      this.h = h;
      for (const { desc, joint } of this.joints.values()) this.drive(desc, joint);
    }
    for (let part = 0; part < this.settings.substeps; ++part) {
      this.push();
      this.drag(h);
      this.world.stepSimulation(h, 0);
    }
    this.pushes = [];
  }
  push() {
    for (const { slot, force, torque } of this.pushes ?? []) {
      const { body } = this.bodies.get(slot);
      this.setAwake(slot, true);
      body.applyCentralForce(this.vec(force));
      body.applyTorque(this.vec(torque));
    }
    for (const { desc, body } of this.bodies.values())
      if (desc.motion === DYNAMIC && desc.gravityScale !== 1 && body.isActive()) body.applyCentralForce(this.vec(scale(desc.mass * (desc.gravityScale - 1), this.gravity)));
    this.sweep();
  }
  /** Kinematic bodies go by their velocity through their motion state, from which Bullet takes them. */
  drag(h) {
    for (const [slot, { desc, body, frame }] of this.bodies) {
      if (desc.motion !== KINEMATIC) continue;
      const row = this.velocity(slot), turn = Math.hypot(...row.slice(3)) * h, s = turn > 0 ? Math.sin(turn / 2) * h / turn : 0;
      const pose = this.pose(slot), place = { position: pose.slice(0, 3).map((x, k) => x + h * row[k]), orientation: multiply([...scale(s, row.slice(3)), Math.cos(turn / 2)], pose.slice(3)) };
      body.getMotionState().setWorldTransform(this.transform(compose(place, frame)));
    }
  }
  afterStep() {
    this.sweep();
    this.rows = this.tellsTouches || this.needs.has('contacts') ? this.contactRows() : [];
    return this.told(this.rows, TOUCH);
  }
  contacts() { return this.solidRows(this.rows); }
  contactRows() {
    const rows = [];
    for (let i = 0, count = this.dispatcher.getNumManifolds(); i < count; ++i) {
      const manifold = this.dispatcher.getManifoldByIndexInternal(i);
      const [a, b] = [manifold.getBody0(), manifold.getBody1()].map((body) => this.slots.get(this.A.getPointer(body)));
      if (a === undefined || b === undefined || !this.collides(a, b)) continue;
      for (let k = 0, points = manifold.getNumContacts(); k < points; ++k) {
        const point = manifold.getContactPoint(k), middle = scale(0.5, add(array(point.getPositionWorldOnA()), array(point.getPositionWorldOnB())));
        rows.push(a, b, 0, 0, ...middle, ...scale(-1, array(point.get_m_normalWorldOnB())), -point.getDistance(), NaN, NaN, NaN, NaN, 0);
      }
    }
    return rows;
  }

  createJoint(desc) {
    const A = this.A, ends = [desc.a, desc.b].map((slot) => (slot < 0 ? { body: this.ground, frame: { position: [0, 0, 0], orientation: [0, 0, 0, 1] } } : this.bodies.get(slot)));
    const [a, b] = [desc.frameA, desc.frameB].map((pose, i) => inFrame(ends[i].frame, pose)), [one, two] = ends.map(({ body }) => body);
    const about = ({ position, orientation }) => this.transform({ position, orientation: multiply(orientation, Z_TO_X) });
    let joint;
    switch (desc.type) {
      case BALL: joint = new A.btPoint2PointConstraint(one, two, this.vec(a.position), this.vec(b.position)); break;
      case HINGE: joint = new A.btHingeConstraint(one, two, about(a), about(b), true); this.limit(desc, joint); break;
      case SLIDER: {
        const { limit } = desc.axes[0];
        joint = new A.btSliderConstraint(one, two, this.transform(a), this.transform(b), true);
        joint.setLowerLinLimit(limit.enabled ? limit.lower : 1);
        joint.setUpperLinLimit(limit.enabled ? limit.upper : -1);
        joint.setLowerAngLimit(0);
        joint.setUpperAngLimit(0);
        break;
      }
      case FIXED:
      case GENERIC: joint = this.sixAxes(desc, one, two, a, b); break;
      default: refuse(`joints of type ${desc.type}`);
    }
    this.world.addConstraint(joint, !desc.collideConnected);
    if (!desc.collideConnected && desc.a >= 0) this.forgetPair(desc.a, desc.b);
    this.joints.set(desc.slot, { desc, joint });
    this.part(desc, 1);
    this.drive(desc, joint);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
    this.sweep();
  }
  // In Bullet lower above upper is free, equal is locked.
  sixAxes(desc, one, two, a, b) {
    const joint = new this.A.btGeneric6DofConstraint(one, two, this.transform(a), this.transform(b), true);
    const [lower, upper] = [1, -1].map((free, side) => desc.axes.map(({ mode, limit }) => (mode === LOCKED || desc.type === FIXED ? 0 : mode === LIMITED ? [limit.lower, limit.upper][side] : free)));
    joint.setLinearLowerLimit(this.vec(lower.slice(0, 3)));
    joint.setLinearUpperLimit(this.vec(upper.slice(0, 3)));
    joint.setAngularLowerLimit(this.vec(lower.slice(3)));
    joint.setAngularUpperLimit(this.vec(upper.slice(3)));
    return joint;
  }
  limit({ axes }, hinge) {
    const { limit } = axes[3];
    if (limit.enabled) hinge.setLimit(limit.lower, limit.upper, 0.9, 0.3, 0);  // softness and bias as Bullet has them; no bounce
  }
  // Bullet bounds a motor's impulse in a step.
  drive(desc, joint) {
    const { motor } = desc.axes[3];
    if (desc.type === HINGE) joint.enableAngularMotor(motor.enabled, motor.target, motor.most * (this.h ?? 0));
  }
  setMotors(slot, motors) {
    const { desc, joint } = this.joints.get(slot);
    desc.axes.forEach((axis, i) => { axis.motor = motors[i]; });
    this.drive(desc, joint);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
  /** A pair is kept apart by a constraint that leaves it all axes. */
  setException(a, b, touch) {
    super.setException(a, b, touch);
    const key = pairKey(a, b), before = this.apart.get(key);
    if (touch && before) {
      this.world.removeConstraint(before);
      this.A.destroy(before);
      this.apart.delete(key);
    } else if (!touch && !before) {
      const [one, two] = [a, b].map((slot) => this.bodies.get(slot).body), free = { mode: 0, limit: {} };
      const origin = { position: [0, 0, 0], orientation: [0, 0, 0, 1] }, link = this.sixAxes({ axes: Array(6).fill(free) }, one, two, origin, origin);
      this.world.addConstraint(link, true);
      this.apart.set(key, link);
    }
    this.forgetPair(a, b);
    for (const slot of [a, b]) this.sweepFast(slot);
    for (const slot of [a, b]) this.setAwake(slot, true);
    this.sweep();
  }
  destroyJoint(slot) {
    const { desc, joint } = this.joints.get(slot);
    this.world.removeConstraint(joint);
    this.A.destroy(joint);
    this.joints.delete(slot);
    this.part(desc, -1);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
}

/** About the radius of the largest sphere within. */
function innerRadius(desc) {
  switch (desc.type) {
    case SPHERE:
    case CAPSULE: return desc.radius;
    case BOX: return Math.min(...desc.halfExtents);
    case CYLINDER: return Math.min(desc.radius, desc.halfHeight);
    default: {
      const along = (axis) => Array.from(desc.vertices).filter((_, i) => i % 3 === axis), wide = [0, 1, 2].map((axis) => Math.max(...along(axis)) - Math.min(...along(axis)));
      return 0.25 * Math.min(...wide);
    }
  }
}
