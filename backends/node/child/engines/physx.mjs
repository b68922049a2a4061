// PhysX 5.6 by NVIDIA, on the CPU: package physx-js-webidl.
import { readFileSync } from 'node:fs';
import { BALL, BOX, CAPSULE, CCD, DISTANCE, DYNAMIC, FIXED, GENERIC, HEIGHT_FIELD, HINGE, HULL, KINEMATIC, LIMITED, LOCKED, MESH,
  NEVER_SLEEPS, NO_ROTATION, PLANE, SENSOR, SLIDER, SPHERE, STATIC, ASLEEP, meshOfHeightField } from '../rows.mjs';
import { add, compose, dot, length, multiply, scale } from '../algebra.mjs';
import { USUAL, WorldBase, SUBSTEPS, boolSetting, choiceSetting, floatSetting, intSetting, refuse } from '../base.mjs';
import { fileOf, load, missing, versionOf } from '../packages.mjs';

const PACKAGE = 'physx-js-webidl';
const GYROSCOPIC = 1 << 10;  // PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, which the package does not name
const KILL = 1;  // PxFilterFlag
const TOUCH = 1e-3;  // m: contacts are told before they touch
const MOST_POINTS = 64;  // that are read of one pair of shapes
const ALONG_Y = [0, 0, Math.SQRT1_2, Math.SQRT1_2];  // PhysX's capsules lie along x, and so do the normals of planes
const array = ({ x, y, z }) => [x, y, z];

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'PhysX 5.6.1, WebAssembly, CPU', precision: 'f32', deterministic: true,
    settings: [
      SUBSTEPS,
      intSetting('position_iterations', 'quality', [1, 255], 4, 'sweeps of the solver over positions', { unit: '1' }),
      intSetting('velocity_iterations', 'quality', [0, 255], 1, 'sweeps of the solver over velocities', { unit: '1' }),
      choiceSetting('solver', 'behaviour', ['pgs', 'tgs'], 'pgs: projected Gauss-Seidel; tgs: temporal Gauss-Seidel, which tells no torques of joints', { creation_only: true }),
      floatSetting('bounce_threshold', 'behaviour', [0.001, 1e4], 2, 'slower impacts do not bounce', { unit: 'm/s' }),
      floatSetting('max_angular_velocity', 'behaviour', [0, 1e6], 100, 'faster bodies are slowed to it', { unit: 'rad/s', creation_only: true }),
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
    ],
    capabilities: [
      ...USUAL,
      ['shape', 'cylinder', '*', 'none', 'PhysX has cylinders as convex cores, which this package does not let bodies have'],
      ['shape', 'plane', 'static', 'native'],
      ['joint', 'ball|hinge|slider|fixed|generic', '*', 'native', 'all by the joint of six axes'],
      ['joint', 'universal', '*', 'none', 'the joint of six axes does not hold two axes square while both turn'],
      ['joint', 'distance', '*', 'native'],
      ['joint_feature', 'hinge|slider|distance', 'limits', 'native'],
      ['joint_feature', 'hinge|slider', 'motors|springs|stiffness', 'native'],
      ['joint_feature', 'ball|hinge|slider|fixed|distance|generic', 'reaction', 'native'],
      ['joint_feature', 'ball|hinge|slider|fixed|distance|generic', 'breaks', 'emulated', 'the reaction is compared after each step'],
      ['query', 'ray', '*', 'native', 'over all bodies'],
      ['query', 'cast|overlap', 'sphere|box|capsule|hull', 'native', 'over all bodies'],
      ['write', 'damping|filter|awake', '*', 'native'],
      ['need', 'joints|ccd|sleeping|gyroscopic|damping|axis_locks|filters|queries|joint_reactions', '*', 'native'],
      ['need', 'events|contacts|sensors', '*', 'native', 'by contact reports, which call JavaScript'],
      ['event', '*', '*', 'emulated', 'by comparing one step with the next'],
      ['child_material', '*', '*', 'native'],
    ],
  };
}

/** The package takes Node for a shell that it was not built for, and a page for a page. */
async function loadAsPage() {
  const { process } = globalThis;
  const wasmBinary = readFileSync(fileOf(PACKAGE, 'physx-js-webidl.wasm'));
  const { default: PhysX } = await load(PACKAGE, 'physx-js-webidl.mjs');
  globalThis.process = undefined;
  globalThis.window = {};
  try {
    return await PhysX({ wasmBinary });
  } finally {
    globalThis.process = process;
    delete globalThis.window;
  }
}

export async function createWorld(init) {
  return new PhysXWorld(await loadAsPage(), init);
}

class PhysXWorld extends WorldBase {
  constructor(P, init) {
    super(init);
    this.P = P;
    this.temporary = [];
    this.top = P.PxTopLevelFunctions.prototype;
    const version = P.PHYSICS_VERSION;
    this.foundation = this.top.CreateFoundation(version, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
    this.scales = new P.PxTolerancesScale();
    this.physics = this.top.CreatePhysics(version, this.foundation, this.scales);
    this.top.InitExtensions(this.physics);
    const desc = new P.PxSceneDesc(this.scales), filter = new P.PassThroughFilterShaderImpl();
    desc.gravity = this.vec(init.gravity);
    desc.cpuDispatcher = this.top.DefaultCpuDispatcherCreate(0);
    desc.solverType = init.settings.solver === 'tgs' ? P.PxSolverTypeEnum.eTGS : P.PxSolverTypeEnum.ePGS;
    desc.flags.raise(P.PxSceneFlagEnum.eENABLE_ENHANCED_DETERMINISM);
    if (this.needs.has('ccd')) desc.flags.raise(P.PxSceneFlagEnum.eENABLE_CCD);
    const pair = P.PxPairFlagEnum, tells = this.tellsTouches || this.needs.has('contacts');
    const told = tells ? pair.eNOTIFY_TOUCH_FOUND | pair.eNOTIFY_TOUCH_PERSISTS | pair.eNOTIFY_CONTACT_POINTS : 0;
    const flags = pair.eCONTACT_DEFAULT | told | (this.needs.has('ccd') ? pair.eDETECT_CCD_CONTACT : 0), seen = pair.eDETECT_DISCRETE_CONTACT | told;
    filter.outputPairFlags = flags;
    filter.filterShader = (attributes0, a, a1, a2, a3, attributes1, b) => {
      filter.outputPairFlags = this.isSensor(a) || this.isSensor(b) ? seen : flags;
      return this.collides(a, b) ? 0 : KILL;
    };
    this.rows = [];
    this.owners = new Map();  // a shape's place in memory to { slot, child }
    if (tells) desc.simulationEventCallback = this.listener();
    if (this.needs.has('sensors')) desc.kineKineFilteringMode = desc.staticKineFilteringMode = P.PxPairFilteringModeEnum.eKEEP;
    this.filter = filter;
    this.top.setupPassThroughFilterShader(desc, filter);
    this.scene = this.physics.createScene(desc);
    this.applySettings({});
    this.sweep();
  }

  vec([x, y, z]) { return this.keep(new this.P.PxVec3(x, y, z)); }
  transform({ position, orientation: [x, y, z, w] }) {
    const n = 1 / Math.hypot(x, y, z, w);
    return this.keep(new this.P.PxTransform(this.vec(position), this.keep(new this.P.PxQuat(n * x, n * y, n * z, n * w))));
  }
  keep(object) { return this.temporary.push(object), object; }
  sweep() {
    for (const object of this.temporary) this.P.destroy(object);
    this.temporary = [];
  }

  applySettings(changed) {
    super.applySettings(changed);
    this.scene.setBounceThresholdVelocity(this.settings.bounce_threshold);
    for (const { desc, actor } of this.bodies.values())
      if (desc.motion === DYNAMIC) actor.setSolverIterationCounts(this.settings.position_iterations, this.settings.velocity_iterations);
  }
  setGravity(gravity) {
    this.scene.setGravity(this.vec(gravity));
    for (const slot of this.bodies.keys()) this.setAwake(slot, true);
    this.sweep();
  }

  listener() {
    const { P } = this, callback = new P.PxSimulationEventCallbackImpl(), at = P.NativeArrayHelpers.prototype;
    for (const unused of ['onConstraintBreak', 'onWake', 'onSleep', 'onTrigger']) callback[unused] = () => {};
    this.points = new P.PxArray_PxContactPairPoint(MOST_POINTS);
    callback.onContact = (header, pairs, count) => {
      const first = P.wrapPointer(pairs, P.PxContactPair);
      for (let i = 0; i < count; ++i) this.note(at.getContactPairAt(first, i));
    };
    return callback;
  }
  /** Rows of a pair of shapes; the impulse is that of the normal alone. */
  note(pair) {
    const [a, b] = [0, 1].map((i) => this.owners.get(this.P.getPointer(pair.get_shapes(i))));
    if (a === undefined || b === undefined) return;
    for (let i = 0, count = pair.extractContacts(this.points.begin(), MOST_POINTS); i < count; ++i) {
      const { position, normal, separation, impulse } = this.points.get(i), way = scale(-1, array(normal));  // PhysX's is from b to a
      this.rows.push(a.slot, b.slot, a.child, b.child, ...array(position), ...way, -separation, Math.abs(dot(way, array(impulse))), NaN, NaN, NaN, 0);
    }
  }

  // --- shapes --------------------------------------------------------------------------------------------------------

  createShape(desc) {
    this.shapes.set(desc.slot, { desc, ...(desc.type === 8 ? {} : this.geometry(desc)) });
    this.sweep();
  }
  /** A geometry, and how it lies in the shape's frame. */
  geometry(desc) {
    const P = this.P, straight = [0, 0, 0, 1];
    switch (desc.type) {
      case SPHERE: return { geometry: new P.PxSphereGeometry(desc.radius), turn: straight };
      case BOX: return { geometry: new P.PxBoxGeometry(...desc.halfExtents), turn: straight };
      case CAPSULE:
        return desc.halfHeight === 0 ? { geometry: new P.PxSphereGeometry(desc.radius), turn: straight }
          : { geometry: new P.PxCapsuleGeometry(desc.radius, desc.halfHeight), turn: ALONG_Y };
      case PLANE: return { geometry: new P.PxPlaneGeometry(), turn: ALONG_Y };
      case HULL: return { geometry: this.hull(desc.vertices), turn: straight };
      case MESH: return { geometry: this.mesh(desc), turn: straight };
      case HEIGHT_FIELD: return { geometry: this.mesh(meshOfHeightField(desc)), turn: straight };
      default: return refuse(`shapes of type ${desc.type}`);
    }
  }
  points(data, vertices) {
    const points = this.keep(new this.P.PxArray_PxVec3(vertices.length / 3));
    for (let i = 0; i < vertices.length; i += 3) points.set(i / 3, this.vec(vertices.subarray(i, i + 3)));
    Object.assign(data, { count: vertices.length / 3, stride: 12, data: points.begin() });
  }
  hull(vertices) {
    const P = this.P, desc = this.keep(new P.PxConvexMeshDesc());
    this.points(desc.points, vertices);
    desc.flags = this.keep(new P.PxConvexFlags(P.PxConvexFlagEnum.eCOMPUTE_CONVEX));
    const made = this.top.CreateConvexMesh(this.keep(new P.PxCookingParams(this.scales)), desc);
    if (P.getPointer(made) === 0) refuse('PhysX makes no hull of these points');
    return new P.PxConvexMeshGeometry(made);
  }
  mesh({ vertices, indices }) {
    const P = this.P, desc = this.keep(new P.PxTriangleMeshDesc()), numbers = this.keep(new P.PxArray_PxU32(indices.length));
    this.points(desc.points, vertices);
    indices.forEach((index, i) => numbers.set(i, index));
    Object.assign(desc.triangles, { count: indices.length / 3, stride: 12, data: numbers.begin() });
    const made = this.top.CreateTriangleMesh(this.keep(new P.PxCookingParams(this.scales)), desc);
    if (P.getPointer(made) === 0) refuse('PhysX makes no mesh of these triangles');
    return new P.PxTriangleMeshGeometry(made);
  }
  partsOf(desc) {
    if (desc.shape < 0) return [];
    return this.parts(desc.shape).map((part) => {
      const { geometry, turn } = this.shapes.get(part.slot);
      return { geometry, type: part.desc.type, material: part.material, local: { position: part.pose.position, orientation: multiply(part.pose.orientation, turn) } };
    });
  }

  // --- bodies --------------------------------------------------------------------------------------------------------

  createBody(desc) {
    const P = this.P, place = this.transform(desc.pose);
    const actor = desc.motion === STATIC ? this.physics.createRigidStatic(place) : this.physics.createRigidDynamic(place);
    const flags = this.keep(new P.PxShapeFlags(P.PxShapeFlagEnum.eSIMULATION_SHAPE)), shapes = [];
    const parts = this.partsOf(desc);
    for (const [child, part] of parts.entries()) {
      const { friction, restitution } = part.material ?? desc.material, material = this.physics.createMaterial(0, 0, 0);
      this.dress(material, friction, restitution);
      const shape = this.physics.createShape(part.geometry, material, true, flags);
      shape.setLocalPose(this.transform(part.local));
      shape.setSimulationFilterData(this.keep(new P.PxFilterData(desc.slot, 0, 0, 0)));
      actor.attachShape(shape);
      shapes.push({ shape, material, own: part.material !== null });
      this.owners.set(P.getPointer(shape), { slot: desc.slot, child: parts.length > 1 ? child : 0 });
    }
    this.bodies.set(desc.slot, { desc, actor, shapes, parts, linear: desc.linear, angular: desc.angular });
    if (desc.motion === KINEMATIC) actor.setRigidBodyFlag(P.PxRigidBodyFlagEnum.eKINEMATIC, true);
    if (desc.motion === DYNAMIC) this.endow(desc, actor);
    this.scene.addActor(actor);
    if (desc.motion === DYNAMIC) {
      actor.setLinearVelocity(this.vec(desc.linear));
      actor.setAngularVelocity(this.vec(desc.angular));
      if ((desc.flags & ASLEEP) !== 0) actor.putToSleep();
    }
    this.sweep();
  }
  dress(material, friction, restitution) {
    const mode = this.P.PxCombineModeEnum;
    material.setStaticFriction(Math.sqrt(friction));
    material.setDynamicFriction(Math.sqrt(friction));
    material.setFrictionCombineMode(mode.eMULTIPLY);
    material.setRestitution(restitution);
    material.setRestitutionCombineMode(mode.eMAX);
  }
  endow(desc, actor) {
    const P = this.P, still = (desc.flags & NO_ROTATION) !== 0;
    actor.setMass(desc.mass);
    actor.setMassSpaceInertiaTensor(this.vec(still ? [0, 0, 0] : desc.inertia));
    actor.setCMassLocalPose(this.transform({ position: desc.centre, orientation: desc.inertiaOrientation }));
    actor.setLinearDamping(desc.linearDamping);
    actor.setAngularDamping(desc.angularDamping);
    actor.setMaxAngularVelocity(this.settings.max_angular_velocity);
    actor.setSolverIterationCounts(this.settings.position_iterations, this.settings.velocity_iterations);
    if ((desc.flags & CCD) !== 0) actor.setRigidBodyFlag(P.PxRigidBodyFlagEnum.eENABLE_CCD, true);
    if (this.needs.has('gyroscopic')) actor.setRigidBodyFlag(GYROSCOPIC, true);
    if (desc.gravityScale !== 1) actor.setActorFlag(P.PxActorFlagEnum.eDISABLE_GRAVITY, true);
    const locks = desc.locks | (still ? 56 : 0);
    actor.setRigidDynamicLockFlags(this.keep(new P.PxRigidDynamicLockFlags(locks)));
    const sleeps = this.needs.has('sleeping') && this.settings.sleeping && (desc.flags & NEVER_SLEEPS) === 0;
    if (!sleeps) {
      actor.setSleepThreshold(0);
      actor.setStabilizationThreshold(0);
    }
  }
  destroyBody(slot) {
    const { actor, shapes } = this.bodies.get(slot);
    for (const { shape } of shapes) this.owners.delete(this.P.getPointer(shape));
    this.scene.removeActor(actor, true);
    actor.release();
    this.bodies.delete(slot);
  }
  pose(slot) {
    const { p, q } = this.bodies.get(slot).actor.getGlobalPose();
    return [p.x, p.y, p.z, q.x, q.y, q.z, q.w];
  }
  velocity(slot) {
    const { desc, actor, linear, angular } = this.bodies.get(slot);
    if (desc.motion === STATIC) return [0, 0, 0, 0, 0, 0];
    if (desc.motion === KINEMATIC) return [...linear, ...angular];
    return [...array(actor.getLinearVelocity()), ...array(actor.getAngularVelocity())];
  }
  awake(slot) {
    const { desc, actor } = this.bodies.get(slot);
    return [desc.motion === DYNAMIC && actor.isSleeping() ? 0 : 1];
  }
  setPose(slot, position, orientation) {
    const { actor } = this.bodies.get(slot);
    actor.setGlobalPose(this.transform({ position, orientation }), true);
    this.sweep();
  }
  setVelocity(slot, linear, angular) {
    const body = this.bodies.get(slot);
    if (body.desc.motion === KINEMATIC) Object.assign(body, { linear, angular });
    if (body.desc.motion !== DYNAMIC) return;
    body.actor.setLinearVelocity(this.vec(linear), true);
    body.actor.setAngularVelocity(this.vec(angular), true);
    this.sweep();
  }
  setAwake(slot, awake) {
    const { desc, actor } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return;
    if (awake) actor.wakeUp();
    else actor.putToSleep();
  }
  setMaterial(slot, friction, restitution) {
    for (const { material, own } of this.bodies.get(slot).shapes) if (!own) this.dress(material, friction, restitution);
  }
  setGravityScale(slot, factor) {
    const { desc, actor } = this.bodies.get(slot);
    desc.gravityScale = factor;
    if (desc.motion === DYNAMIC) actor.setActorFlag(this.P.PxActorFlagEnum.eDISABLE_GRAVITY, factor !== 1);
    this.setAwake(slot, true);
  }
  setDamping(slot, linear, angular) {
    const { desc, actor } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return;
    actor.setLinearDamping(linear);
    actor.setAngularDamping(angular);
  }
  setFilter(slot, filter) {
    const { desc, actor } = this.bodies.get(slot);
    desc.filter = filter;
    this.scene.resetFiltering(actor);
    this.setAwake(slot, true);
  }
  setException(a, b, touch) {
    super.setException(a, b, touch);
    this.lookAgain(a, b);
  }
  lookAgain(...slots) {
    for (const slot of slots) {
      if (slot < 0) continue;
      this.scene.resetFiltering(this.bodies.get(slot).actor);
      this.setAwake(slot, true);
    }
  }
  addForce(slot, force, torque) { (this.pushes ??= []).push({ slot, force, torque }); }

  // --- step ----------------------------------------------------------------------------------------------------------

  step(dt) {
    this.h = dt / this.settings.substeps;
    const before = this.rows;
    for (let part = 0; part < this.settings.substeps; ++part) {
      this.rows = [];
      this.push();
      this.scene.simulate(this.h);
      this.scene.fetchResults(true);
    }
    this.pushes = [];
    this.rows = this.withSleepers(before, this.rows);
  }
  push() {
    const P = this.P, gravity = this.scene.getGravity(), g = array(gravity);
    for (const { slot, force, torque } of this.pushes ?? []) {
      const { actor } = this.bodies.get(slot);
      actor.addForce(this.vec(force), P.PxForceModeEnum.eFORCE, true);
      actor.addTorque(this.vec(torque), P.PxForceModeEnum.eFORCE, true);
    }
    for (const [slot, { desc, actor, linear, angular }] of this.bodies) {
      if (desc.motion === DYNAMIC && desc.gravityScale !== 1 && !actor.isSleeping())  // PhysX knows gravity on and off
        actor.addForce(this.vec(scale(desc.gravityScale, g)), P.PxForceModeEnum.eACCELERATION, false);
      if (desc.motion === KINEMATIC && (length(linear) > 0 || length(angular) > 0)) this.aim(slot, actor, linear, angular);
    }
    this.sweep();
  }
  aim(slot, actor, linear, angular) {
    const pose = this.pose(slot), turn = length(angular) * this.h, s = turn > 0 ? Math.sin(turn / 2) / length(angular) : 0;
    actor.setKinematicTarget(this.transform({
      position: add(pose.slice(0, 3), scale(this.h, linear)),
      orientation: multiply([...scale(s, angular), Math.cos(turn / 2)], pose.slice(3)) }));
  }
  afterStep() { return this.told(this.rows, TOUCH); }
  contacts() { return this.solidRows(this.rows); }

  // --- joints --------------------------------------------------------------------------------------------------------

  createJoint(desc) {
    const P = this.P, a = desc.a < 0 ? P.wrapPointer(0, P.PxRigidActor) : this.bodies.get(desc.a).actor, b = this.bodies.get(desc.b).actor;
    const frames = [a, this.transform(desc.frameA), b, this.transform(desc.frameB)];
    const joint = desc.type === DISTANCE ? this.distance(desc, frames) : this.sixAxes(desc, frames);
    joint.setConstraintFlag(P.PxConstraintFlagEnum.eCOLLISION_ENABLED, true);  // who touches whom is our filter's
    this.joints.set(desc.slot, { desc, joint });
    this.part(desc, 1);
    if (!desc.collideConnected) this.lookAgain(desc.a, desc.b);
    this.sweep();
  }
  distance(desc, frames) {
    const { P } = this, joint = this.top.DistanceJointCreate(this.physics, ...frames), { limit } = desc.axes[0];
    joint.setMinDistance(limit.enabled ? limit.lower : desc.restLength);
    joint.setMaxDistance(limit.enabled ? limit.upper : desc.restLength);
    joint.setDistanceJointFlag(P.PxDistanceJointFlagEnum.eMIN_DISTANCE_ENABLED, true);
    joint.setDistanceJointFlag(P.PxDistanceJointFlagEnum.eMAX_DISTANCE_ENABLED, true);
    joint.setTolerance(0);
    return joint;
  }
  sixAxes(desc, frames) {
    const P = this.P, joint = this.top.D6JointCreate(this.physics, ...frames), { PxD6AxisEnum: axis, PxD6MotionEnum: motion } = P;
    const axes = [axis.eX, axis.eY, axis.eZ, axis.eTWIST, axis.eSWING1, axis.eSWING2];
    axisModes(desc).forEach((mode, i) => {
      joint.setMotion(axes[i], [motion.eFREE, motion.eLOCKED, motion.eLIMITED][mode]);
      if (mode !== LIMITED) return;
      const { lower, upper } = desc.axes[i].limit, hard = this.keep(new P.PxSpring(0, 0));
      if (i < 3) joint.setLinearLimit(axes[i], this.keep(new P.PxJointLinearLimitPair(lower, upper, hard)));
      else if (i === 3) joint.setTwistLimit(this.keep(new P.PxJointAngularLimitPair(lower, upper)));
      else refuse('limits of the second and third rotation');
    });
    this.drive(desc, joint);
    return joint;
  }
  drive(desc, joint) {
    const P = this.P, axis = { [HINGE]: 3, [SLIDER]: 0 }[desc.type];
    if (axis === undefined) return;
    const { motor, spring } = desc.axes[axis], turns = axis === 3, w = 2 * Math.PI * spring.frequency, none = this.vec([0, 0, 0]);
    if (motor.enabled && spring.enabled) refuse('a motor and a spring on one axis of a joint');
    const [stiffness, damping] = spring.byStiffness ? [spring.frequency, spring.ratio] : [w * w, 2 * spring.ratio * w];
    const drive = spring.enabled ? new P.PxD6JointDrive(stiffness, damping, 3e38, !spring.byStiffness) : new P.PxD6JointDrive(0, motor.enabled ? 1e9 : 0, motor.enabled ? motor.most : 0, false);
    joint.setDrive(turns ? P.PxD6DriveEnum.eTWIST : P.PxD6DriveEnum.eX, this.keep(drive));
    const rest = spring.enabled ? spring.rest : 0, speed = motor.enabled ? motor.target : 0;
    joint.setDrivePosition(this.transform(turns ? { position: [0, 0, 0], orientation: [Math.sin(rest / 2), 0, 0, Math.cos(rest / 2)] } : { position: [rest, 0, 0], orientation: [0, 0, 0, 1] }));
    if (turns) joint.setDriveVelocity(none, this.vec([-speed, 0, 0]));  // PhysX counts it the other way round
    else joint.setDriveVelocity(this.vec([speed, 0, 0]), none);
    joint.setConstraintFlag(P.PxConstraintFlagEnum.eDRIVE_LIMITS_ARE_FORCES, true);
  }
  setMotors(slot, motors) {
    const { desc, joint } = this.joints.get(slot);
    desc.axes.forEach((axis, i) => { axis.motor = motors[i]; });
    this.drive(desc, joint);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
    this.sweep();
  }
  destroyJoint(slot) {
    const { desc, joint } = this.joints.get(slot);
    joint.release();
    this.joints.delete(slot);
    this.part(desc, -1);
    this.lookAgain(desc.a, desc.b);
  }

  reaction(slot) {
    const { desc, joint } = this.joints.get(slot), force = this.vec([0, 0, 0]), torque = this.vec([0, 0, 0]);
    joint.getConstraint().getForce(force, torque);
    const row = scale(-1, array(force)), turning = scale(-1, array(torque));  // PhysX tells those on a
    this.sweep();
    if (this.settings.solver === 'pgs') return [...row, ...turning];
    return desc.type === BALL || desc.type === DISTANCE ? [...row, 0, 0, 0] : [...row, NaN, NaN, NaN];
  }

  // --- queries: over all bodies ---------------------------------------------------------------------------------------

  eachSeen(filter, visit) {
    for (const [slot, { parts }] of this.bodies) {
      if (!this.sees(filter, slot)) continue;
      const row = this.pose(slot), pose = { position: row.slice(0, 3), orientation: row.slice(3) };
      parts.forEach((part, child) => visit(slot, parts.length > 1 ? child : 0, part.geometry, this.transform(compose(pose, part.local)), part.type));
    }
  }
  castRay({ origin, translation, filter }) {
    const P = this.P, far = length(translation), hit = (this.hit ??= new P.PxRaycastHit()), hits = [];
    const flags = (this.hitFlags ??= new P.PxHitFlags(P.PxHitFlagEnum.ePOSITION | P.PxHitFlagEnum.eNORMAL)), from = this.vec(origin), way = this.vec(scale(1 / far, translation));
    this.eachSeen(filter, (body, child, geometry, pose) => {
      if (P.PxGeometryQuery.prototype.raycast(from, way, geometry, pose, far, flags, 1, hit) === 0) return;
      hits.push({ body, child, fraction: hit.distance / far, position: array(hit.position), normal: array(hit.normal) });
    });
    this.sweep();
    return hits;
  }
  castShape({ shape, pose, translation, filter }) {
    const P = this.P, far = length(translation), hit = (this.swept ??= new P.PxSweepHit()), hits = [], thrown = this.shapes.get(shape), { geometry, turn } = thrown;
    const flags = (this.hitFlags ??= new P.PxHitFlags(P.PxHitFlagEnum.ePOSITION | P.PxHitFlagEnum.eNORMAL)), way = this.vec(scale(1 / far, translation));
    const place = this.transform({ position: pose.position, orientation: multiply(pose.orientation, turn) });
    this.eachSeen(filter, (body, child, other, at, type) => {
      if (P.PxGeometryQuery.prototype.overlap(geometry, place, other, at))  // a sweep from within a mesh sees what it leaves by
        return hits.push({ body, child, fraction: 0, position: pose.position, normal: scale(-1 / far, translation) });
      const meshed = type === MESH || type === HEIGHT_FIELD;  // which PhysX says boxes meet up to some centimetres too early
      const moved = meshed && thrown.desc.type === BOX ? (thrown.hull ??= this.hull(corners(thrown.desc.halfExtents))) : geometry;
      if (P.PxGeometryQuery.prototype.sweep(way, far, moved, place, other, at, hit, flags, 0))
        hits.push({ body, child, fraction: Math.max(0, hit.distance / far), position: array(hit.position), normal: array(hit.normal) });
    });
    this.sweep();
    return hits;
  }
  overlapShape({ shape, pose, filter }) {
    const { geometry, turn } = this.shapes.get(shape), hits = [];
    const place = this.transform({ position: pose.position, orientation: multiply(pose.orientation, turn) });
    this.eachSeen(filter, (body, child, other, at) => {
      if (this.P.PxGeometryQuery.prototype.overlap(geometry, place, other, at)) hits.push({ body, child });
    });
    this.sweep();
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
const corners = ([x, y, z]) => Float32Array.from([-x, x].flatMap((a) => [-y, y].flatMap((b) => [-z, z].flatMap((c) => [a, b, c]))));
