// Havok Physics as Babylon.js ships it: package @babylonjs/havok.
import { readFileSync } from 'node:fs';
import { BALL, CAPSULE, CYLINDER, BOX, DISTANCE, DYNAMIC, FIXED, GENERIC, HEIGHT_FIELD, HINGE, HULL, LIMITED, LOCKED, MESH,
  NO_ROTATION, SENSOR, SLIDER, SPHERE, STATIC, ASLEEP, NEVER_SLEEPS, COMPOUND, meshOfHeightField } from '../rows.mjs';
import { add, dot, length, multiply, pairKey, rotate, scale, sub, unrotate } from '../algebra.mjs';
import { USUAL, WorldBase, SUBSTEPS, boolSetting, refuse } from '../base.mjs';
import { fileOf, load, missing, versionOf } from '../packages.mjs';

const PACKAGE = '@babylonjs/havok';
const TOUCH = 1e-3;  // m: contacts are told before they touch

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'Havok Physics for Babylon.js, WebAssembly', precision: 'f32', deterministic: true,
    settings: [
      SUBSTEPS,
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
    ],
    capabilities: [
      ...USUAL,
      ['joint', 'ball|hinge|slider|fixed|distance|generic', '*', 'native'],
      ['joint_feature', 'hinge|slider|distance|generic', 'limits', 'native'],
      ['joint_feature', 'hinge|slider|generic', 'motors', 'native'],
      ['joint_feature', 'hinge|slider', 'springs', 'native'],
      ['joint_feature', 'slider', 'stiffness', 'native'],
      ['joint_feature', 'hinge', 'stiffness', 'none', 'a torque bends it by a twentieth too little'],
      ['joint_feature', 'ball|hinge|slider|fixed|distance|generic', 'reaction', 'native'],
      ['joint_feature', 'ball|hinge|slider|fixed|distance|generic', 'breaks', 'emulated', 'the reaction is compared after each step'],
      ['query', 'ray|cast|overlap', '*', 'native'],
      ['need', 'restitution', '*', 'approximate', 'a bounce keeps about .88 of the speed that restitution asks for'],
      ['write', 'damping', '*', 'native'],
      ['need', 'joints|sleeping|ccd|damping|queries|events|contacts|sensors|joint_reactions', '*', 'native'],
      ['write', 'awake', '*', 'native'],
      ['shape', 'cylinder', '*', 'approximate', 'a prism of 16 sides'],
      ['pair', 'cylinder', '*', 'approximate', 'prisms'],
      ['write', 'gravity_scale', '*', 'approximate', 'Havok brakes bodies that are slower than about .1 m/s'],
      ['query', 'cast', '*', 'approximate', 'Havok rounds edges by some millimetres'],
      ['joint_feature', 'distance|generic', 'limits', 'approximate', 'Havok brakes bodies that are slower than about .1 m/s'],
      ['joint_feature', 'slider', 'limits|motors', 'approximate', 'Havok brakes bodies that are slower than about .1 m/s'],
      ['event', '*', '*', 'emulated', 'by comparing one step with the next'],
      ['child_material', '*', '*', 'native'],
    ],
  };
}

export async function createWorld(init) {
  const { default: HavokPhysics } = await load(PACKAGE, 'lib/esm/HavokPhysics_es.js');
  const hp = await HavokPhysics({ wasmBinary: readFileSync(fileOf(PACKAGE, 'lib/esm/HavokPhysics.wasm')) });
  return new HavokWorld(hp, init);
}

/** The value of a call that answers [result, value], or the result. */
function ok(answer) {
  const [result, value] = Array.isArray(answer) ? answer : [answer];
  const code = result?.value ?? result;
  if (code !== 0) throw new Error(`Havok answered ${code}`);
  return value;
}

class HavokWorld extends WorldBase {
  constructor(hp, init) {
    super(init);
    this.hp = hp;
    this.world = ok(hp.HP_World_Create());
    this.slots = new Map();  // Havok's number of a body to our slot
    this.rows = [];
    this.apart = new Map();  // pairs that are excepted, to Havok's constraints
    this.sensed = new Map();  // pairs that overlap a trigger, and in how many parts
    this.ground = ok(hp.HP_Body_Create());
    ok(hp.HP_Body_SetMotionType(this.ground, hp.MotionType.STATIC));
    ok(hp.HP_World_AddBody(this.world, this.ground, false));
    ok(hp.HP_World_SetSpeedLimit(this.world, 1e6, 1e6));
    this.setGravity(init.gravity);
  }
  setGravity(gravity) { ok(this.hp.HP_World_SetGravity(this.world, gravity)); }

  // --- shapes: Havok's materials are of shapes, so each body gets its own ---------------------------------------------

  makeShape(desc) {
    const hp = this.hp, along = [0, desc.halfHeight, 0];
    switch (desc.type) {
      case SPHERE: return ok(hp.HP_Shape_CreateSphere([0, 0, 0], desc.radius));
      case BOX: return ok(hp.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], scale(2, desc.halfExtents)));
      case CAPSULE: return ok(hp.HP_Shape_CreateCapsule(scale(-1, along), along, desc.radius));
      case CYLINDER: return ok(hp.HP_Shape_CreateCylinder(scale(-1, along), along, desc.radius));
      case HULL: return this.withMemory([Float32Array.from(desc.vertices)], (at) => ok(hp.HP_Shape_CreateConvexHull(at, desc.vertices.length / 3)));
      case MESH:
      case HEIGHT_FIELD: {
        const { vertices, indices } = desc.type === MESH ? desc : meshOfHeightField(desc);
        return this.withMemory([Float32Array.from(vertices), indices], (v, i) => ok(hp.HP_Shape_CreateMesh(v, vertices.length / 3, i, indices.length / 3)));
      }
      default: return refuse(`shapes of type ${desc.type}`);
    }
  }
  /** Arrays copied to Havok's memory while `use` runs. */
  withMemory(arrays, use) {
    const places = arrays.map((array) => {
      const at = this.hp._malloc(array.byteLength);
      new Uint8Array(this.hp.HEAPU8.buffer, at, array.byteLength).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
      return at;
    });
    try {
      return use(...places);
    } finally {
      for (const at of places) this.hp._free(at);
    }
  }
  shapeOfBody(desc) {
    const hp = this.hp, own = [];
    const make = (part) => {
      const shape = this.makeShape(part.desc), material = part.material ?? desc.material;
      this.dress(shape, material.friction, material.restitution);
      if ((desc.flags & SENSOR) !== 0) ok(hp.HP_Shape_SetTrigger(shape, true));
      own.push({ shape, ownMaterial: part.material !== null });
      return shape;
    };
    const parts = this.parts(desc.shape);
    if (this.shapes.get(desc.shape).desc.type !== COMPOUND) return { shape: make(parts[0]), own };
    const container = ok(hp.HP_Shape_CreateContainer());
    for (const part of parts)
      ok(hp.HP_Shape_AddChild(container, make(part), [part.pose.position, part.pose.orientation, [1, 1, 1]]));
    return { shape: container, own, container };
  }
  dress(shape, friction, restitution) {
    const { MaterialCombine: combine } = this.hp;
    ok(this.hp.HP_Shape_SetMaterial(shape, [friction, friction, restitution, combine.GEOMETRIC_MEAN, combine.MAXIMUM]));
  }

  // --- bodies --------------------------------------------------------------------------------------------------------

  createBody(desc) {
    const hp = this.hp, body = ok(hp.HP_Body_Create());
    const made = desc.shape < 0 ? { own: [] } : this.shapeOfBody(desc);
    if (made.shape) ok(hp.HP_Body_SetShape(body, made.shape));
    ok(hp.HP_Body_SetMotionType(body, [hp.MotionType.STATIC, hp.MotionType.KINEMATIC, hp.MotionType.DYNAMIC][desc.motion]));
    if (desc.motion === DYNAMIC) {
      const still = (desc.flags & NO_ROTATION) !== 0;
      ok(hp.HP_Body_SetMassProperties(body, [desc.centre, desc.mass, still ? [0, 0, 0] : scale(1 / desc.mass, desc.inertia), desc.inertiaOrientation]));
    }
    ok(hp.HP_Body_SetQTransform(body, [desc.pose.position, desc.pose.orientation]));
    ok(hp.HP_Body_SetLinearDamping(body, desc.linearDamping));
    ok(hp.HP_Body_SetAngularDamping(body, desc.angularDamping));
    ok(hp.HP_Body_SetGravityFactor(body, desc.gravityScale));
    if (desc.motion !== STATIC) {
      ok(hp.HP_Body_SetLinearVelocity(body, desc.linear));
      ok(hp.HP_Body_SetAngularVelocity(body, desc.angular));
    }
    ok(hp.HP_World_AddBody(this.world, body, (desc.flags & ASLEEP) !== 0));
    const sleeps = this.needs.has('sleeping') && this.settings.sleeping && (desc.flags & NEVER_SLEEPS) === 0;
    if (!sleeps && desc.motion === DYNAMIC) ok(hp.HP_Body_SetActivationControl(body, hp.ActivationControl.ALWAYS_ACTIVE));
    if (this.tellsTouches || this.needs.has('contacts')) ok(hp.HP_Body_SetEventMask(body, hp.EventType.COLLISION_STARTED.value | hp.EventType.COLLISION_CONTINUED.value));
    this.bodies.set(desc.slot, { desc, body, made });
    this.slots.set(body[0], desc.slot);
  }
  destroyBody(slot) {
    const hp = this.hp, { body, made } = this.bodies.get(slot);
    for (const [key, { a, b }] of this.sensed) if (a === slot || b === slot) this.sensed.delete(key);
    ok(hp.HP_World_RemoveBody(this.world, body));
    ok(hp.HP_Body_Release(body));
    for (const { shape } of made.own) ok(hp.HP_Shape_Release(shape));
    if (made.container) ok(hp.HP_Shape_Release(made.container));
    this.slots.delete(body[0]);
    this.bodies.delete(slot);
  }
  pose(slot) { return ok(this.hp.HP_Body_GetQTransform(this.bodies.get(slot).body)).flat(); }
  velocity(slot) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return [0, 0, 0, 0, 0, 0];
    return [...ok(this.hp.HP_Body_GetLinearVelocity(body)), ...ok(this.hp.HP_Body_GetAngularVelocity(body))];
  }
  awake(slot) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return [1];
    return [ok(this.hp.HP_Body_GetActivationState(body)).value === this.hp.ActivationState.ACTIVE.value ? 1 : 0];
  }
  setPose(slot, position, orientation) {
    ok(this.hp.HP_Body_SetQTransform(this.bodies.get(slot).body, [position, orientation]));
    this.setAwake(slot, true);
  }
  setVelocity(slot, linear, angular) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    this.setAwake(slot, true);
    ok(this.hp.HP_Body_SetLinearVelocity(body, linear));
    ok(this.hp.HP_Body_SetAngularVelocity(body, angular));
  }
  setAwake(slot, awake) {
    const { body, desc } = this.bodies.get(slot), { ACTIVE, INACTIVE } = this.hp.ActivationState;
    if (desc.motion === DYNAMIC) ok(this.hp.HP_Body_SetActivationState(body, awake ? ACTIVE : INACTIVE));
  }
  setMaterial(slot, friction, restitution) {
    for (const { shape, ownMaterial } of this.bodies.get(slot).made.own) if (!ownMaterial) this.dress(shape, friction, restitution);
  }
  setGravityScale(slot, factor) { ok(this.hp.HP_Body_SetGravityFactor(this.bodies.get(slot).body, factor)); }
  setDamping(slot, linear, angular) {
    ok(this.hp.HP_Body_SetLinearDamping(this.bodies.get(slot).body, linear));
    ok(this.hp.HP_Body_SetAngularDamping(this.bodies.get(slot).body, angular));
  }
  addForce(slot, force, torque, dt) { (this.pushes ??= []).push({ slot, force, torque }); }

  // Havok takes impulses only, and by moments of inertia that it rounds: a force is a change of velocity before each
  // sub-step.
  step(dt) {
    const hp = this.hp, parts = this.settings.substeps, h = dt / parts;
    ok(hp.HP_World_SetIdealStepTime(this.world, h));
    for (let part = 0; part < parts; ++part) {
      for (const { slot, force, torque } of this.pushes ?? []) {
        const { desc } = this.bodies.get(slot), row = this.velocity(slot), axes = multiply(this.pose(slot).slice(3), desc.inertiaOrientation);
        const still = (desc.flags & NO_ROTATION) !== 0, turning = unrotate(axes, torque).map((t, k) => (still || desc.inertia[k] === 0 ? 0 : t / desc.inertia[k]));
        this.setVelocity(slot, add(row.slice(0, 3), scale(h / desc.mass, force)), add(row.slice(3), scale(h, rotate(axes, turning))));
      }
      ok(hp.HP_World_Step(this.world, h));
    }
    this.pushes = [];
    this.h = h;
  }
  afterStep() {
    this.rows = this.tellsTouches || this.needs.has('contacts') ? this.withSleepers(this.rows, this.contactRows()) : [];
    const answer = this.told(this.rows, TOUCH);
    if (this.needs.has('sensors')) answer.touching.push(...this.sensedPairs());
    return answer;
  }
  contacts() { return this.rows; }
  /** Child of a compound that a hit is on: its shape is the child's own. */
  childHit(slot, collider) {
    const { own, container } = this.bodies.get(slot).made;
    return container === undefined ? 0 : Math.max(0, own.findIndex(({ shape }) => shape[0] === collider[0]));
  }
  /** Child of a compound that a contact is on. */
  childOf(slot, path) {
    if (this.bodies.get(slot).made.container === undefined) return 0;
    const [result, , child] = this.hp.HP_Shape_PathIterator_GetNext(path);
    return result.value === 0 ? child : 0;
  }
  // Of the last sub-step; the impulse is that of the normal alone. Where nothing happened Havok answers a failure, and 0.
  contactRows() {
    const hp = this.hp, rows = [];
    for (let [, event] = hp.HP_World_GetCollisionEvents(this.world); event; event = hp.HP_World_GetNextCollisionEvent(Number(this.world[0]), event)) {
      const [, one, two, impulse] = ok(hp.HP_Event_AsCollision(event)), [a, b] = [one, two].map(([body]) => this.slots.get(body[0]));
      if (a === undefined || b === undefined) continue;
      const [p, q, normal] = [one[3], two[3], one[4]], depth = dot(normal, sub(p, q));
      rows.push(a, b, this.childOf(a, one[2]), this.childOf(b, two[2]), ...scale(0.5, add(p, q)), ...normal, depth, impulse, NaN, NaN, NaN, 0);
    }
    return rows;
  }
  sensedPairs() {
    const hp = this.hp, ENTERED = 8;
    for (let [, event] = hp.HP_World_GetTriggerEvents(this.world); event; event = hp.HP_World_GetNextTriggerEvent(this.world, event)) {
      const [, one, , two] = ok(hp.HP_Event_AsTrigger(event)), [a, b] = [one, two].map((body) => this.slots.get(body[0]));
      if (a === undefined || b === undefined) continue;
      const entered = new Int32Array(hp.HEAPU8.buffer, event, 1)[0] === ENTERED;  // the call leaves the type out
      const key = pairKey(a, b), parts = (this.sensed.get(key)?.parts ?? 0) + (entered ? 1 : -1);
      if (parts > 0) this.sensed.set(key, { a, b, parts });
      else this.sensed.delete(key);
    }
    return [...this.sensed.values()].flatMap(({ a, b }) => [a, b]);
  }

  // --- joints --------------------------------------------------------------------------------------------------------

  createJoint(desc) {
    const hp = this.hp, { ConstraintAxisLimitMode: mode } = hp, joint = ok(hp.HP_Constraint_Create());
    const parent = desc.a < 0 ? this.ground : this.bodies.get(desc.a).body, child = this.bodies.get(desc.b).body;
    ok(hp.HP_Constraint_SetParentBody(joint, parent));
    ok(hp.HP_Constraint_SetChildBody(joint, child));
    const axes = ({ orientation }) => [rotate(orientation, [1, 0, 0]), rotate(orientation, [0, 1, 0])];
    ok(hp.HP_Constraint_SetAnchorInParent(joint, desc.frameA.position, ...axes(desc.frameA)));
    ok(hp.HP_Constraint_SetAnchorInChild(joint, desc.frameB.position, ...axes(desc.frameB)));
    ok(hp.HP_Constraint_SetCollisionsEnabled(joint, desc.collideConnected ? 1 : 0));
    const limit = (axis, lower, upper) => {
      ok(hp.HP_Constraint_SetAxisMode(joint, this.axis(axis), mode.LIMITED));
      ok(hp.HP_Constraint_SetAxisMinLimit(joint, this.axis(axis), lower));
      ok(hp.HP_Constraint_SetAxisMaxLimit(joint, this.axis(axis), upper));
    };
    axisModes(desc).forEach((how, axis) => {
      if (how === LOCKED) ok(hp.HP_Constraint_SetAxisMode(joint, this.axis(axis), mode.LOCKED));
      if (how === LIMITED) limit(axis, desc.axes[axis].limit.lower, desc.axes[axis].limit.upper);
    });
    if (desc.type === DISTANCE) {
      const { limit: { enabled, lower, upper } } = desc.axes[0];
      hp.HP_Constraint_SetAxisMode(joint, this.axis(6), mode.LIMITED);  // which answers a failure, and is done
      ok(hp.HP_Constraint_SetAxisMinLimit(joint, this.axis(6), enabled ? lower : desc.restLength));
      ok(hp.HP_Constraint_SetAxisMaxLimit(joint, this.axis(6), enabled ? upper : desc.restLength));
    }
    this.joints.set(desc.slot, { desc, joint });
    this.drive(desc, joint);
    ok(hp.HP_Constraint_SetEnabled(joint, 1));
  }
  /** A pair is kept apart by a constraint that leaves it all axes. */
  setException(a, b, touch) {
    super.setException(a, b, touch);
    const key = pairKey(a, b), before = this.apart.get(key);
    if (touch && before) this.release(before);
    if (touch) this.apart.delete(key);
    else if (!before) this.apart.set(key, this.linkOf(a, b));
    for (const slot of [a, b]) this.setAwake(slot, true);
  }
  linkOf(a, b) {
    const hp = this.hp, link = ok(hp.HP_Constraint_Create()), frame = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
    ok(hp.HP_Constraint_SetParentBody(link, this.bodies.get(a).body));
    ok(hp.HP_Constraint_SetChildBody(link, this.bodies.get(b).body));
    ok(hp.HP_Constraint_SetAnchorInParent(link, ...frame));
    ok(hp.HP_Constraint_SetAnchorInChild(link, ...frame));
    ok(hp.HP_Constraint_SetCollisionsEnabled(link, 0));
    ok(hp.HP_Constraint_SetEnabled(link, 1));
    return link;
  }
  release(constraint) {
    ok(this.hp.HP_Constraint_SetEnabled(constraint, 0));
    ok(this.hp.HP_Constraint_Release(constraint));
  }
  axis(number) {
    const a = this.hp.ConstraintAxis;
    return [a.LINEAR_X, a.LINEAR_Y, a.LINEAR_Z, a.ANGULAR_X, a.ANGULAR_Y, a.ANGULAR_Z, a.LINEAR_DISTANCE][number];
  }
  drive(desc, joint) {
    const hp = this.hp, { NONE, VELOCITY, SPRING_FORCE, SPRING_ACCELERATION } = hp.ConstraintMotorType;
    if (desc.type !== GENERIC && desc.type !== HINGE && desc.type !== SLIDER) return;
    desc.axes.forEach(({ motor, spring }, number) => {
      const axis = this.axis(number), w = 2 * Math.PI * spring.frequency;
      if (motor.enabled && spring.enabled) refuse('a motor and a spring on one axis of a joint');
      if (motor.enabled) {
        ok(hp.HP_Constraint_SetAxisMotorType(joint, axis, VELOCITY));
        ok(hp.HP_Constraint_SetAxisMotorTarget(joint, axis, motor.target));
        ok(hp.HP_Constraint_SetAxisMotorMaxForce(joint, axis, motor.most));
      } else if (spring.enabled) {
        ok(hp.HP_Constraint_SetAxisMotorType(joint, axis, spring.byStiffness ? SPRING_FORCE : SPRING_ACCELERATION));
        hp.HP_Constraint_SetAxisMotorPositionTarget(joint, axis, spring.rest);  // which answers a failure, and is done
        hp.HP_Constraint_SetAxisMotorVelocityTarget(joint, axis, 0);
        ok(hp.HP_Constraint_SetAxisMotorStiffness(joint, axis, spring.byStiffness ? spring.frequency : w * w));
        ok(hp.HP_Constraint_SetAxisMotorDamping(joint, axis, spring.byStiffness ? spring.ratio : 2 * spring.ratio * w));
        ok(hp.HP_Constraint_SetAxisMotorMaxForce(joint, axis, 1e30));
      } else {
        ok(hp.HP_Constraint_SetAxisMotorType(joint, axis, NONE));
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
    const { desc, joint } = this.joints.get(slot);
    this.release(joint);
    this.joints.delete(slot);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }

  /** On b, from the impulses of the last sub-step. */
  reaction(slot) {
    const [result, linear, angular] = this.hp.HP_Constraint_GetAppliedImpulses(this.joints.get(slot).joint);
    ok(result);
    return scale(1 / (this.h ?? 1), linear).concat(scale(1 / (this.h ?? 1), angular));
  }

  // --- queries -------------------------------------------------------------------------------------------------------

  castRay({ origin, translation, filter }) {
    const hp = this.hp;
    this.collector ??= ok(hp.HP_QueryCollector_Create(1024));
    ok(hp.HP_World_CastRayWithCollector(this.world, this.collector, [origin, add(origin, translation), [0xffffffff, 0xffffffff], false, [0n]]));
    const hits = [], count = ok(hp.HP_QueryCollector_GetNumHits(this.collector));
    for (let i = 0; i < count; ++i) {
      const answer = hp.HP_QueryCollector_GetCastRayResult(this.collector, i)[1];
      const [fraction, [body, collider, , position, normal]] = answer, slot = this.slots.get(body[0]);
      if (slot !== undefined && this.sees(filter, slot)) hits.push({ body: slot, child: this.childHit(slot, collider), fraction, position, normal });
    }
    return hits;
  }
  /** A shape of Havok's own for queries, made at the first. */
  probe(slot) {
    const shape = this.shapes.get(slot);
    return (shape.probe ??= this.makeShape(shape.desc));
  }
  destroyShape(slot) {
    const { probe } = this.shapes.get(slot);
    if (probe) ok(this.hp.HP_Shape_Release(probe));
    super.destroyShape(slot);
  }
  /** Calls visit(first number, hit, slot) for all that a filter sees. */
  eachHit(filter, read, visit) {
    for (let i = 0, count = ok(this.hp.HP_QueryCollector_GetNumHits(this.collector)); i < count; ++i) {
      const [number, , hit] = ok(this.hp[read](this.collector, i)), slot = this.slots.get(hit[0][0]);
      if (slot !== undefined && this.sees(filter, slot)) visit(number, hit, slot);
    }
  }
  castShape({ shape, pose, translation, filter }) {
    const hp = this.hp;
    // Havok's casts see nothing that overlaps at the start.
    const hits = this.overlapShape({ shape, pose, filter }).map((hit) => ({ ...hit, fraction: 0, position: pose.position, normal: scale(-1 / length(translation), translation) }));
    ok(hp.HP_World_ShapeCastWithCollector(this.world, this.collector, [this.probe(shape), pose.orientation, pose.position, add(pose.position, translation), false, [0n]]));
    this.eachHit(filter, 'HP_QueryCollector_GetShapeCastResult', (fraction, [, collider, , position, normal], body) =>
      hits.push({ body, child: this.childHit(body, collider), fraction, position, normal }));
    return hits;
  }
  overlapShape({ shape, pose, filter }) {
    const hp = this.hp, hits = [];
    this.collector ??= ok(hp.HP_QueryCollector_Create(1024));
    ok(hp.HP_World_ShapeProximityWithCollector(this.world, this.collector, [this.probe(shape), pose.position, pose.orientation, 0, false, [0n]]));
    this.eachHit(filter, 'HP_QueryCollector_GetShapeProximityResult', (distance, [, collider], body) => {
      if (distance <= 0) hits.push({ body, child: this.childHit(body, collider) });
    });
    return hits;
  }
}

/** Of each of the six axes: free, locked or limited. */
function axisModes(desc) {
  const free = { [BALL]: [3, 4, 5], [HINGE]: [3], [SLIDER]: [0], [FIXED]: [] }[desc.type];
  return desc.axes.map(({ mode, limit }, axis) => {
    if (desc.type === DISTANCE) return 0;
    if (desc.type === GENERIC) return mode;
    if (!free.includes(axis)) return LOCKED;
    return limit.enabled ? LIMITED : 0;
  });
}
