// cannon-es, in JavaScript and double precision: package cannon-es.
import { BALL, BOX, CAPSULE, CYLINDER, DYNAMIC, FIXED, HINGE, KINEMATIC, NEVER_SLEEPS, NO_ROTATION, PLANE, SENSOR, SPHERE, STATIC, ASLEEP } from '../rows.mjs';
import { add, compose, cross, dot, inverse, rotate, scale, sub } from '../algebra.mjs';
import { USUAL, WorldBase, SUBSTEPS, boolSetting, choiceSetting, floatSetting, inFrame, intSetting, principalFrame, refuse } from '../base.mjs';
import { load, missing, versionOf } from '../packages.mjs';

const PACKAGE = 'cannon-es';
const SEGMENTS = 16;  // of a cylinder
const TOUCH = 1e-3;  // m
const FROM_Z = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];  // cannon's planes look along z
const array = ({ x, y, z }) => [x, y, z];

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'cannon-es, JavaScript', device: 'js', precision: 'f64', deterministic: true,
    settings: [
      SUBSTEPS,
      intSetting('iterations', 'quality', [1, 10000], 10, 'sweeps of the Gauss-Seidel solver', { unit: '1' }),
      floatSetting('tolerance', 'behaviour', [0, 1], 1e-7, 'change of a sweep at which the solver ends', { unit: '1' }),
      floatSetting('contact_stiffness', 'behaviour', [1, 1e12], 1e7, 'stiffness of contacts and of friction', { unit: 'N/m' }),
      floatSetting('contact_relaxation', 'behaviour', [1, 1e3], 3, 'steps in which a contact comes to rest', { unit: '1' }),
      choiceSetting('broad_phase', 'speed', ['naive', 'sap'], 'naive: all pairs; sap: sweep and prune along one axis', { creation_only: true }),
      choiceSetting('friction', 'behaviour', ['shared', 'points'], 'shared: the contact points of two bodies share the bound of their friction; points: each has all of it', { creation_only: true }),
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
    ],
    capabilities: [
      ...USUAL,
      ['shape', 'mesh|height_field', '*', 'none', "cannon's meshes know spheres and planes alone"],
      ['shape', 'hull', '*', 'none', 'the adapter does not find the faces that cannon wants'],
      ['shape', 'cylinder', '*', 'approximate', 'a prism of 16 sides'],
      ['shape', 'capsule', '*', 'approximate', 'two spheres and a prism of 16 sides'],
      ['shape', 'plane', 'static', 'native'],
      ['pair', 'cylinder|capsule|compound', '*', 'approximate', 'prisms'],
      ['need', 'friction', '*', 'approximate', 'bounded by the weight of the lighter of the two, not by the force between them; none without gravity'],
      ['need', 'restitution', '*', 'none', 'soft contacts give back less than half: a ball of half a ton and restitution .8 rebounds with .35'],
      ['joint', 'ball|hinge|fixed', '*', 'native'],
      ['joint_feature', 'hinge', 'motors', 'native'],
      ['joint_feature', 'ball|hinge|fixed', 'reaction', 'native'],
      ['joint_feature', 'ball|hinge|fixed', 'breaks', 'emulated', 'the reaction is compared after each step'],
      ['query', 'ray', '*', 'native', 'over all bodies'],
      ['write', 'gravity_scale', '*', 'emulated', 'by forces'],
      ['write', 'damping|filter|awake', '*', 'native'],
      ['need', 'joints|sleeping|damping|axis_locks|filters|queries|joint_reactions', '*', 'native'],
      ['need', 'events|contacts|sensors', '*', 'native'],
      ['need', 'contact_impulses', '*', 'native', 'where a step has parts, those of the last times their number'],
      ['event', '*', '*', 'emulated', 'by comparing one step with the next'],
    ],
  };
}

export async function createWorld(init) {
  return new CannonWorld(await load(PACKAGE, 'dist/cannon-es.js'), init);
}

class CannonWorld extends WorldBase {
  constructor(C, init) {
    super(init);
    this.C = C;
    this.world = new C.World({ gravity: this.vec(init.gravity), allowSleep: this.needs.has('sleeping') && init.settings.sleeping });
    this.world.broadphase = init.settings.broad_phase === 'sap' ? new C.SAPBroadphase(this.world) : new C.NaiveBroadphase();
    const plain = this.world.broadphase.needBroadphaseCollision.bind(this.world.broadphase);
    this.world.broadphase.needBroadphaseCollision = (a, b) => (this.watches(a, b) || plain(a, b)) && this.collides(a.slot, b.slot);
    const solve = this.world.solver.solve.bind(this.world.solver);
    if (init.settings.friction === 'shared') this.world.solver.solve = (h, world) => (this.share(), solve(h, world));
    this.world.defaultContactMaterial.friction = 0;
    this.rows = [];
    this.materials = new Map();
    this.ground = new C.Body({ type: C.Body.STATIC });
    this.applySettings({});
  }
  vec([x, y, z]) { return new this.C.Vec3(x, y, z); }
  quat([x, y, z, w]) { return new this.C.Quaternion(x, y, z, w); }
  /** Sensors see also what cannon would not collide, as a static body and a kinematic one. */
  watches(a, b) { return [a, b].some(({ slot }) => (this.bodies.get(slot).desc.flags & SENSOR) !== 0); }

  applySettings(changed) {
    super.applySettings(changed);
    this.world.solver.iterations = this.settings.iterations;
    this.world.solver.tolerance = this.settings.tolerance;
    for (const contact of this.world.contactmaterials) this.harden(contact);
  }
  harden(contact) {
    contact.contactEquationStiffness = contact.frictionEquationStiffness = this.settings.contact_stiffness;
    contact.contactEquationRelaxation = contact.frictionEquationRelaxation = this.settings.contact_relaxation;
  }
  // What cannon calls a friction's or a motor's largest force bounds the impulse of a step: it is given that.
  rub(contact) { contact.friction = contact.coefficient * (this.h ?? 0); }
  /** Before a step is solved. cannon's own way to it, enableFrictionReduction, confuses the arms of the two bodies. */
  share() {
    const counts = new Map(), key = ({ bi, bj }) => `${bi.id} ${bj.id}`;
    for (const rub of this.world.frictionEquations) counts.set(key(rub), (counts.get(key(rub)) ?? 0) + 1);
    for (const rub of this.world.frictionEquations) {
      rub.maxForce *= 2 / counts.get(key(rub));  // two directions a point
      rub.minForce = -rub.maxForce;
    }
  }
  setGravity(gravity) { this.world.gravity.set(...gravity); }

  /** One of cannon's materials for each pair of coefficients, with the pair's own for any two of them. */
  material(friction, restitution) {
    const key = `${friction} ${restitution}`;
    if (this.materials.has(key)) return this.materials.get(key);
    const material = Object.assign(new this.C.Material(), { mine: { friction, restitution } });
    this.materials.set(key, material);
    for (const { mine } of this.materials.values()) {
      const other = this.materials.get(`${mine.friction} ${mine.restitution}`);
      const contact = new this.C.ContactMaterial(material, other, { restitution: Math.max(restitution, mine.restitution) });
      contact.coefficient = Math.sqrt(friction * mine.friction);
      this.harden(contact);
      this.rub(contact);
      this.world.addContactMaterial(contact);
    }
    return material;
  }

  /** A shape of ours as those of cannon's, each with its place. */
  pieces(desc, pose) {
    const C = this.C, straight = { position: [0, 0, 0], orientation: [0, 0, 0, 1] };
    const at = (shape, local = straight) => ({ shape, pose: compose(pose, local) });
    switch (desc.type) {
      case SPHERE: return [at(new C.Sphere(desc.radius))];
      case BOX: return [at(new C.Box(this.vec(desc.halfExtents)))];
      case CYLINDER: return [at(new C.Cylinder(desc.radius, desc.radius, 2 * desc.halfHeight, SEGMENTS))];
      case CAPSULE: {
        const ends = [-1, 1].map((side) => at(new C.Sphere(desc.radius), { position: [0, side * desc.halfHeight, 0], orientation: [0, 0, 0, 1] }));
        return desc.halfHeight === 0 ? [ends[0]] : [...ends, at(new C.Cylinder(desc.radius, desc.radius, 2 * desc.halfHeight, SEGMENTS))];
      }
      case PLANE: return [at(new C.Plane(), { position: [0, 0, 0], orientation: FROM_Z })];
      default: return refuse(`shapes of type ${desc.type}`);
    }
  }

  createBody(desc) {
    const C = this.C, frame = principalFrame(desc), place = compose(desc.pose, frame);
    const body = new C.Body({
      type: [C.Body.STATIC, C.Body.KINEMATIC, C.Body.DYNAMIC][desc.motion], mass: desc.motion === DYNAMIC ? desc.mass : 0,
      position: this.vec(place.position), quaternion: this.quat(place.orientation),
      material: this.material(desc.material.friction, desc.material.restitution),
      linearFactor: this.vec([1, 2, 4].map((bit) => (desc.locks & bit ? 0 : 1))),
      angularFactor: this.vec([8, 16, 32].map((bit) => (desc.locks & bit ? 0 : 1))),
    });
    body.slot = desc.slot;
    if (desc.shape >= 0)
      for (const [child, part] of this.parts(desc.shape).entries())
        for (const { shape, pose } of this.pieces(part.desc, inFrame(frame, part.pose))) {
          shape.child = child;
          if (part.material !== null) shape.material = this.material(part.material.friction, part.material.restitution);
          body.addShape(shape, this.vec(pose.position), this.quat(pose.orientation));
        }
    body.collisionResponse = (desc.flags & SENSOR) === 0;
    body.allowSleep = (desc.flags & NEVER_SLEEPS) === 0;
    this.bodies.set(desc.slot, { desc, body, frame });
    if (desc.motion === DYNAMIC) this.endow(desc, body);
    if (desc.motion !== STATIC) {
      body.velocity.set(...desc.linear);
      body.angularVelocity.set(...desc.angular);
    }
    this.setDamping(desc.slot, desc.linearDamping, desc.angularDamping);
    this.world.addBody(body);
    if ((desc.flags & ASLEEP) !== 0) body.sleep();
  }
  // What addShape guessed from bounding boxes is put right.
  endow(desc, body) {
    const still = (desc.flags & NO_ROTATION) !== 0;
    body.fixedRotation = still;
    body.inertia.set(...desc.inertia);
    body.invInertia.set(...(still ? [0, 0, 0] : desc.inertia.map((i) => 1 / i)));
    body.updateInertiaWorld(true);
  }
  destroyBody(slot) {
    this.world.removeBody(this.bodies.get(slot).body);
    this.bodies.delete(slot);
    for (const other of this.bodies.values()) other.body.wakeUp();
  }
  pose(slot) {
    const { body: { position, quaternion: q }, frame } = this.bodies.get(slot);
    const pose = compose({ position: array(position), orientation: [q.x, q.y, q.z, q.w] }, inverse(frame));
    return [...pose.position, ...pose.orientation];
  }
  velocity(slot) {
    const { body } = this.bodies.get(slot);
    return [...array(body.velocity), ...array(body.angularVelocity)];
  }
  awake(slot) {
    const { body, desc } = this.bodies.get(slot);
    return [desc.motion === DYNAMIC && body.sleepState === this.C.Body.SLEEPING ? 0 : 1];
  }
  setPose(slot, position, orientation) {
    const { body, frame } = this.bodies.get(slot), place = compose({ position, orientation }, frame);
    body.position.set(...place.position);
    body.quaternion.set(...place.orientation);
    body.aabbNeedsUpdate = true;
    body.updateInertiaWorld(true);
    body.wakeUp();
  }
  setVelocity(slot, linear, angular) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    body.velocity.set(...linear);
    body.angularVelocity.set(...angular);
    body.wakeUp();
  }
  setAwake(slot, awake) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return;
    if (awake) body.wakeUp();
    else body.sleep();
  }
  setMaterial(slot, friction, restitution) { this.bodies.get(slot).body.material = this.material(friction, restitution); }
  setGravityScale(slot, factor) {
    this.bodies.get(slot).desc.gravityScale = factor;
    this.setAwake(slot, true);
  }
  // cannon takes v (1 - d)^dt; ours is v exp(-c dt).
  setDamping(slot, linear, angular) {
    const { body } = this.bodies.get(slot);
    body.linearDamping = -Math.expm1(-linear);
    body.angularDamping = -Math.expm1(-angular);
  }
  setFilter(slot, filter) {
    this.bodies.get(slot).desc.filter = filter;
    for (const { body } of this.bodies.values()) body.wakeUp();
  }
  setException(a, b, touch) {
    super.setException(a, b, touch);
    for (const slot of [a, b]) this.setAwake(slot, true);
  }
  addForce(slot, force, torque) { (this.pushes ??= []).push({ slot, force, torque }); }

  step(dt) {
    const { substeps } = this.settings, h = dt / substeps;
    if (h !== this.h) {
      this.h = h;
      for (const contact of this.world.contactmaterials) if (contact.coefficient !== undefined) this.rub(contact);
      for (const { desc, joint } of this.joints.values()) if (desc.type === HINGE) this.drive(desc, joint);
    }
    const tells = this.tellsTouches || this.needs.has('contacts');
    for (let part = 0; part < substeps; ++part) {
      this.push();
      if (tells) for (const { body } of this.bodies.values()) body.found = array(body.position);
      this.world.step(h);
    }
    this.pushes = [];
    this.rows = tells ? this.withSleepers(this.rows, this.contactRows()) : [];
  }
  push() {
    const g = array(this.world.gravity);
    for (const { slot, force, torque } of this.pushes ?? []) {
      const { body } = this.bodies.get(slot);
      body.wakeUp();
      body.force.vadd(this.vec(force), body.force);
      body.torque.vadd(this.vec(torque), body.torque);
    }
    for (const { desc, body } of this.bodies.values())
      if (desc.motion === DYNAMIC && desc.gravityScale !== 1) body.force.vadd(this.vec(scale(desc.mass * (desc.gravityScale - 1), g)), body.force);
  }
  afterStep() { return this.told(this.rows, TOUCH); }
  contacts() { return this.solidRows(this.rows); }
  /** As they were found, where the bodies were then. */
  contactRows() {
    const rows = [], rubbed = this.needs.has('contact_impulses') ? this.frictions() : new Map();
    for (const { bi, bj, si, sj, ri, rj, ni, multiplier } of this.world.contacts) {
      const one = add(bi.found, array(ri)), two = add(bj.found, array(rj)), normal = array(ni), { sum, count } = rubbed.get(`${bi.id} ${bj.id}`) ?? { sum: [0, 0, 0], count: 1 };
      rows.push(bi.slot, bj.slot, si.child, sj.child, ...scale(0.5, add(one, two)), ...normal, dot(normal, sub(one, two)),
        multiplier * this.h * this.settings.substeps, ...scale(1 / count, sum), 0);
    }
    return rows;
  }
  /** Impulses of friction by pair, and over how many points they spread. */
  frictions() {
    const pairs = new Map();
    for (const { bi, bj } of this.world.contacts) {
      const key = `${bi.id} ${bj.id}`;
      pairs.set(key, { sum: [0, 0, 0], count: (pairs.get(key)?.count ?? 0) + 1 });
    }
    for (const { bi, bj, t, multiplier } of this.world.frictionEquations) {
      const way = pairs.has(`${bi.id} ${bj.id}`) ? 1 : -1, pair = pairs.get(way > 0 ? `${bi.id} ${bj.id}` : `${bj.id} ${bi.id}`);
      if (pair) pair.sum = add(pair.sum, scale(way * multiplier * this.h * this.settings.substeps, array(t)));
    }
    return pairs;
  }

  createJoint(desc) {
    const C = this.C, ends = [desc.a, desc.b].map((slot) => (slot < 0 ? { body: this.ground, frame: { position: [0, 0, 0], orientation: [0, 0, 0, 1] } } : this.bodies.get(slot)));
    const [a, b] = [desc.frameA, desc.frameB].map((pose, i) => inFrame(ends[i].frame, pose));
    const along = ({ orientation }) => this.vec(rotate(orientation, [1, 0, 0])), options = { collideConnected: true };
    let joint;
    if (desc.type === BALL) joint = new C.PointToPointConstraint(ends[0].body, this.vec(a.position), ends[1].body, this.vec(b.position));
    else if (desc.type === HINGE) {
      joint = new C.HingeConstraint(ends[0].body, ends[1].body, { pivotA: this.vec(a.position), pivotB: this.vec(b.position), axisA: along(a), axisB: along(b), ...options });
      this.drive(desc, joint);
    } else if (desc.type === FIXED) joint = this.lock(ends, a, b);
    else refuse(`joints of type ${desc.type}`);
    this.world.addConstraint(joint);
    this.joints.set(desc.slot, { desc, joint, arm: b.position });
    this.part(desc, 1);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
  // cannon locks two bodies as they stand: they stand as the frames say while it looks.
  lock(ends, a, b) {
    const [{ body: one }, { body: two }] = ends, kept = [two.position.clone(), two.quaternion.clone()];
    const q = one.quaternion, place = compose(compose({ position: array(one.position), orientation: [q.x, q.y, q.z, q.w] }, a), inverse(b));
    two.position.set(...place.position);
    two.quaternion.set(...place.orientation);
    const joint = new this.C.LockConstraint(one, two);
    two.position.copy(kept[0]);
    two.quaternion.copy(kept[1]);
    return joint;
  }
  drive(desc, joint) {
    const { motor } = desc.axes[3];
    if (desc.axes[3].limit.enabled || desc.axes[3].spring.enabled) refuse('limits and springs of hinges');
    if (!motor.enabled) return joint.disableMotor();
    joint.enableMotor();
    joint.setMotorSpeed(-motor.target);
    joint.setMotorMaxForce(motor.most * (this.h ?? 0));
  }
  setMotors(slot, motors) {
    const { desc, joint } = this.joints.get(slot);
    desc.axes.forEach((axis, i) => { axis.motor = motors[i]; });
    if (desc.type === HINGE) this.drive(desc, joint);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
  destroyJoint(slot) {
    const { desc, joint } = this.joints.get(slot);
    this.world.removeConstraint(joint);
    this.joints.delete(slot);
    this.part(desc, -1);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
  /** The sum of its equations: what each does to b, at b's centre of mass, moved to the frame's origin. */
  reaction(slot) {
    const { desc, joint, arm } = this.joints.get(slot), { body } = this.bodies.get(desc.b), { x, y, z, w } = body.quaternion;
    let force = [0, 0, 0], torque = [0, 0, 0];
    for (const { jacobianElementB: { spatial, rotational }, multiplier, enabled } of joint.equations) {
      if (!enabled) continue;
      force = add(force, scale(multiplier, array(spatial)));
      torque = add(torque, scale(multiplier, array(rotational)));
    }
    return [...force, ...sub(torque, cross(rotate([x, y, z, w], arm), force))];
  }

  castRay({ origin, translation, filter }) {
    const C = this.C, ray = new C.Ray(this.vec(origin), this.vec(add(origin, translation))), far = Math.hypot(...translation), hits = [];
    for (const [slot, { body }] of this.bodies) {
      if (!this.sees(filter, slot)) continue;
      const result = new C.RaycastResult();
      ray.mode = C.RAY_MODES.CLOSEST;
      ray.intersectBody(body, result);
      if (result.hasHit)
        hits.push({ body: slot, child: result.shape.child, fraction: result.distance / far, position: array(result.hitPointWorld), normal: array(result.hitNormalWorld) });
    }
    return hits;
  }
}
