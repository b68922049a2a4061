// Havok Physics as Babylon.js ships it: package @babylonjs/havok.
import { readFileSync } from 'node:fs';
import { BALL, CAPSULE, CYLINDER, BOX, DYNAMIC, FIXED, GENERIC, HEIGHT_FIELD, HINGE, HULL, LIMITED, LOCKED, MESH,
  NO_ROTATION, SLIDER, SPHERE, STATIC, ASLEEP, NEVER_SLEEPS, COMPOUND, meshOfHeightField } from '../rows.mjs';
import { add, rotate, scale } from '../algebra.mjs';
import { USUAL, WorldBase, SUBSTEPS, boolSetting, refuse } from '../base.mjs';
import { fileOf, load, missing, versionOf } from '../packages.mjs';

const PACKAGE = '@babylonjs/havok';

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'Havok Physics for Babylon.js, WebAssembly', precision: 'f32', deterministic: true,
    settings: [
      SUBSTEPS,
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
    ],
    capabilities: [
      ...USUAL,
      ['joint', 'ball|hinge|slider|fixed|generic', '*', 'native'],
      ['joint', 'distance', '*', 'none', 'limits of translations, set through this package, hold bodies where they are'],
      ['joint_feature', 'hinge', 'limits', 'native'],
      ['joint_feature', 'hinge|slider|generic', 'motors', 'native'],
      ['query', 'ray', '*', 'approximate', 'Havok rounds cylinders'],
      ['need', 'restitution', '*', 'approximate', 'a bounce keeps about .88 of the speed that restitution asks for'],
      ['write', 'damping', '*', 'native'],
      ['need', 'joints|sleeping|damping|queries', '*', 'native'],
      ['write', 'awake', '*', 'native'],
      ['event', 'wake|sleep', '*', 'emulated', 'by comparing one step with the next'],
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
      case HULL: return this.withMemory([desc.vertices], (at) => ok(hp.HP_Shape_CreateConvexHull(at, desc.vertices.length / 3)));
      case MESH:
      case HEIGHT_FIELD: {
        const { vertices, indices } = desc.type === MESH ? desc : meshOfHeightField(desc);
        return this.withMemory([vertices, indices], (v, i) => ok(hp.HP_Shape_CreateMesh(v, vertices.length / 3, i, indices.length / 3)));
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
    this.bodies.set(desc.slot, { desc, body, made });
    this.slots.set(body[0], desc.slot);
  }
  destroyBody(slot) {
    const hp = this.hp, { body, made } = this.bodies.get(slot);
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

  // Havok takes impulses only: a force is given in equal parts before each sub-step.
  step(dt) {
    const hp = this.hp, parts = this.settings.substeps, h = dt / parts;
    ok(hp.HP_World_SetIdealStepTime(this.world, h));
    for (let part = 0; part < parts; ++part) {
      for (const { slot, force, torque } of this.pushes ?? []) {
        const { body, desc } = this.bodies.get(slot), [position, orientation] = ok(hp.HP_Body_GetQTransform(body));
        this.setAwake(slot, true);
        ok(hp.HP_Body_ApplyImpulse(body, add(position, rotate(orientation, desc.centre)), scale(h, force)));
        ok(hp.HP_Body_ApplyAngularImpulse(body, scale(h, torque)));
      }
      ok(hp.HP_World_Step(this.world, h));
    }
    this.pushes = [];
  }
  afterStep() { return {}; }

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
    this.joints.set(desc.slot, { desc, joint });
    this.drive(desc, joint);
    ok(hp.HP_Constraint_SetEnabled(joint, 1));
  }
  axis(number) {
    const a = this.hp.ConstraintAxis;
    return [a.LINEAR_X, a.LINEAR_Y, a.LINEAR_Z, a.ANGULAR_X, a.ANGULAR_Y, a.ANGULAR_Z][number];
  }
  drive(desc, joint) {
    const hp = this.hp, { NONE, VELOCITY } = hp.ConstraintMotorType;
    desc.axes.forEach(({ motor }, axis) => {
      if (!motor.enabled && desc.type !== GENERIC && desc.type !== HINGE && desc.type !== SLIDER) return;
      ok(hp.HP_Constraint_SetAxisMotorType(joint, this.axis(axis), motor.enabled ? VELOCITY : NONE));
      if (!motor.enabled) return;
      ok(hp.HP_Constraint_SetAxisMotorTarget(joint, this.axis(axis), motor.target));
      ok(hp.HP_Constraint_SetAxisMotorMaxForce(joint, this.axis(axis), motor.most));
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
    ok(this.hp.HP_Constraint_SetEnabled(joint, 0));
    ok(this.hp.HP_Constraint_Release(joint));
    this.joints.delete(slot);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }

  castRay({ origin, translation, filter }) {
    const hp = this.hp;
    this.collector ??= ok(hp.HP_QueryCollector_Create(1024));
    ok(hp.HP_World_CastRayWithCollector(this.world, this.collector, [origin, add(origin, translation), [0xffffffff, 0xffffffff], false, [0n]]));
    const hits = [], count = ok(hp.HP_QueryCollector_GetNumHits(this.collector));
    for (let i = 0; i < count; ++i) {
      const answer = hp.HP_QueryCollector_GetCastRayResult(this.collector, i)[1];
      const [fraction, [body, , , position, normal]] = answer, slot = this.slots.get(body[0]);
      if (slot !== undefined && this.sees(filter, slot)) hits.push({ body: slot, fraction, position, normal });
    }
    return hits;
  }
}

/** Of each of the six axes: free, locked or limited. */
function axisModes(desc) {
  const free = { [BALL]: [3, 4, 5], [HINGE]: [3], [SLIDER]: [0], [FIXED]: [] }[desc.type];
  return desc.axes.map(({ mode, limit }, axis) => {
    if (desc.type === GENERIC) return mode;
    if (!free.includes(axis)) return LOCKED;
    return limit.enabled ? LIMITED : 0;
  });
}
