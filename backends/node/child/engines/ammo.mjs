// ammo.js, Bullet 2.8 compiled to JavaScript: package ammo.js.
import { BALL, BOX, CAPSULE, CYLINDER, DYNAMIC, FIXED, GENERIC, HEIGHT_FIELD, HINGE, HULL, KINEMATIC, LIMITED, LOCKED, MESH,
  NEVER_SLEEPS, NO_ROTATION, SLIDER, SPHERE, STATIC, ASLEEP, meshOfHeightField } from '../rows.mjs';
import { compose, inverse, multiply, scale } from '../algebra.mjs';
import { USUAL, WorldBase, SUBSTEPS, boolSetting, floatSetting, inFrame, principalFrame, refuse } from '../base.mjs';
import { load, missing, versionOf } from '../packages.mjs';

const PACKAGE = 'ammo.js';
const ISLAND_SLEEPING = 2, DISABLE_DEACTIVATION = 4, KINEMATIC_OBJECT = 2;
const Z_TO_X = [0, Math.SQRT1_2, 0, Math.SQRT1_2];  // Bullet's hinges turn about z
const array = (v) => [v.x(), v.y(), v.z()];

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'ammo.js: Bullet in JavaScript', device: 'js', precision: 'f32', deterministic: true,
    settings: [
      SUBSTEPS,
      floatSetting('margin', 'behaviour', [0, 1], 0.04, 'rounding of shapes', { unit: 'm', creation_only: true }),
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
    ],
    capabilities: [
      ...USUAL,
      ['shape', 'hull', '*', 'approximate', 'the margin lies around it: it stands off by twice that'],
      ['need', 'restitution', '*', 'approximate', "Bullet multiplies the two, each of ours is the pair's where both are equal"],
      ['joint', 'ball|hinge|slider|fixed|generic', '*', 'native'],
      ['joint_feature', 'slider', 'limits', 'native'],
      ['write', 'damping|awake', '*', 'native'],
      ['need', 'joints|sleeping|damping|axis_locks', '*', 'native'],
      ['event', 'wake|sleep', '*', 'emulated', 'by comparing one step with the next'],
    ],
  };
}

export async function createWorld(init) {
  const { default: Ammo } = await load(PACKAGE, 'ammo.js');  // loaded means ready: nothing in it waits
  return new AmmoWorld(Ammo, init);
}

class AmmoWorld extends WorldBase {
  constructor(A, init) {
    super(init);
    this.A = A;
    this.temporary = [];
    const rules = new A.btDefaultCollisionConfiguration();
    this.world = new A.btDiscreteDynamicsWorld(new A.btCollisionDispatcher(rules), new A.btDbvtBroadphase(), new A.btSequentialImpulseConstraintSolver(), rules);
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
    this.world.setGravity(this.vec([0, 0, 0]));  // each body is given its own, by its scale
    for (const slot of this.bodies.keys()) this.setAwake(slot, true);
    this.sweep();
  }

  makeShape(desc) {
    const A = this.A, { margin } = this.settings;
    let shape;
    switch (desc.type) {
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
        const { vertices, indices } = desc.type === MESH ? desc : meshOfHeightField(desc), mesh = new A.btTriangleMesh();
        const corner = (k) => this.vec(vertices.subarray(3 * indices[k], 3 * indices[k] + 3));
        for (let i = 0; i < indices.length; i += 3) mesh.addTriangle(corner(i), corner(i + 1), corner(i + 2), false);
        return new A.btBvhTriangleMeshShape(mesh, true, true);
      }
      default: return refuse(`shapes of type ${desc.type}`);
    }
    shape.setMargin(margin);
    return shape;
  }
  /** Bullet's bodies have their origin at the centre of mass, and their axes along the principal ones. */
  shapeOfBody(desc, frame) {
    const A = this.A, whole = new A.btCompoundShape(true);
    const parts = desc.shape < 0 ? [] : this.parts(desc.shape);
    const plain = parts.length === 1 && [...frame.position, ...parts[0].pose.position].every((x) => x === 0) &&
      Math.abs(multiply(inverse(frame).orientation, parts[0].pose.orientation)[3]) === 1;
    if (plain) return this.makeShape(parts[0].desc);
    for (const part of parts) whole.addChildShape(this.transform(inFrame(frame, part.pose)), this.makeShape(part.desc));
    return whole;
  }
  makeBody(shape, mass, place, inertia) {
    const A = this.A, state = new A.btDefaultMotionState(this.transform(place));
    const info = new A.btRigidBodyConstructionInfo(mass, state, shape, this.vec(inertia)), body = new A.btRigidBody(info);
    A.destroy(info);
    return body;
  }

  createBody(desc) {
    const A = this.A, frame = principalFrame(desc), moves = desc.motion === DYNAMIC, still = (desc.flags & NO_ROTATION) !== 0;
    const body = this.makeBody(this.shapeOfBody(desc, frame), moves ? desc.mass : 0, compose(desc.pose, frame), moves && !still ? desc.inertia : [0, 0, 0]);
    this.bodies.set(desc.slot, { desc, body, frame });
    this.setMaterial(desc.slot, desc.material.friction, desc.material.restitution);
    this.setDamping(desc.slot, desc.linearDamping, desc.angularDamping);
    if (desc.motion === KINEMATIC) body.setCollisionFlags(body.getCollisionFlags() | KINEMATIC_OBJECT);
    const free = (bits) => this.vec(bits.map((bit) => (desc.locks & bit ? 0 : 1)));
    body.setLinearFactor(free([1, 2, 4]));
    body.setAngularFactor(still ? this.vec([0, 0, 0]) : free([8, 16, 32]));
    this.world.addRigidBody(body);
    if (desc.motion !== STATIC) {
      body.setLinearVelocity(this.vec(desc.linear));
      body.setAngularVelocity(this.vec(desc.angular));
    }
    const sleeps = this.needs.has('sleeping') && this.settings.sleeping && (desc.flags & NEVER_SLEEPS) === 0;
    if (!sleeps || desc.motion === KINEMATIC) body.setActivationState(DISABLE_DEACTIVATION);
    else if ((desc.flags & ASLEEP) !== 0) body.setActivationState(ISLAND_SLEEPING);
    this.sweep();
  }
  destroyBody(slot) {
    const { body } = this.bodies.get(slot);
    this.world.removeRigidBody(body);
    this.A.destroy(body);
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
    const { body } = this.bodies.get(slot);
    body.setFriction(Math.sqrt(friction));
    body.setRestitution(Math.sqrt(restitution));
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
      if (desc.motion === DYNAMIC && body.isActive()) body.applyCentralForce(this.vec(scale(desc.mass * desc.gravityScale, this.gravity)));
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
    return {};
  }

  createJoint(desc) {
    const A = this.A, ends = [desc.a, desc.b].map((slot) => (slot < 0 ? { body: this.ground, frame: { position: [0, 0, 0], orientation: [0, 0, 0, 1] } } : this.bodies.get(slot)));
    const [a, b] = [desc.frameA, desc.frameB].map((pose, i) => inFrame(ends[i].frame, pose)), [one, two] = ends.map(({ body }) => body);
    const about = ({ position, orientation }) => this.transform({ position, orientation: multiply(orientation, Z_TO_X) });
    let joint;
    switch (desc.type) {
      case BALL: joint = new A.btPoint2PointConstraint(one, two, this.vec(a.position), this.vec(b.position)); break;
      case HINGE: joint = new A.btHingeConstraint(one, two, about(a), about(b), true); break;
      case SLIDER: {
        const { limit } = desc.axes[0];
        joint = new A.btSliderConstraint(one, two, this.transform(a), this.transform(b), true);
        joint.setLowerLinLimit(limit.enabled ? limit.lower : 1);
        joint.setUpperLinLimit(limit.enabled ? limit.upper : -1);
        joint.setLowerAngLimit(0);
        joint.setUpperAngLimit(0);
        break;
      }
      case FIXED: joint = new A.btFixedConstraint(one, two, this.transform(a), this.transform(b)); break;
      case GENERIC: joint = this.sixAxes(desc, one, two, a, b); break;
      default: refuse(`joints of type ${desc.type}`);
    }
    this.world.addConstraint(joint, !desc.collideConnected);
    this.joints.set(desc.slot, { desc, joint });
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
    this.sweep();
  }
  // In Bullet lower above upper is free, equal is locked.
  sixAxes(desc, one, two, a, b) {
    const joint = new this.A.btGeneric6DofConstraint(one, two, this.transform(a), this.transform(b), true);
    const [lower, upper] = [1, -1].map((free, side) => desc.axes.map(({ mode, limit }) => (mode === LOCKED ? 0 : mode === LIMITED ? [limit.lower, limit.upper][side] : free)));
    joint.setLinearLowerLimit(this.vec(lower.slice(0, 3)));
    joint.setLinearUpperLimit(this.vec(upper.slice(0, 3)));
    joint.setAngularLowerLimit(this.vec(lower.slice(3)));
    joint.setAngularUpperLimit(this.vec(upper.slice(3)));
    return joint;
  }
  setMotors() { refuse('motors'); }
  destroyJoint(slot) {
    const { desc, joint } = this.joints.get(slot);
    this.world.removeConstraint(joint);
    this.A.destroy(joint);
    this.joints.delete(slot);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
}
