// Jolt Physics by Jorrit Rouwe: package jolt-physics, single precision, one thread.
import { BALL, BOX, CAPSULE, CYLINDER, DISTANCE, DYNAMIC, FIXED, GENERIC, HEIGHT_FIELD, HINGE, HULL, LOCKED, MESH, NO_ROTATION,
  PLANE, SLIDER, SPHERE, STATIC, UNIVERSAL, CCD, SENSOR, ASLEEP, NEVER_SLEEPS, COMPOUND, meshOfHeightField } from '../rows.mjs';
import { add, compose, dot, length, rotate, scale, sub } from '../algebra.mjs';
import { USUAL, WorldBase, boolSetting, floatSetting, intSetting, refuse } from '../base.mjs';
import { load, missing, versionOf } from '../packages.mjs';
import { impulsesOf } from './jolt/reactions.mjs';

const PACKAGE = 'jolt-physics';
const MOST_CONTACTS = 10240;  // pairs in contact: what the package's temporary memory holds; Jolt ignores more
const array = (v) => [v.GetX(), v.GetY(), v.GetZ()];

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'Jolt Physics, WebAssembly; at most 10240 pairs in contact', precision: 'f32', deterministic: true,
    settings: [
      intSetting('velocity_steps', 'quality', [2, 255], 10, 'iterations of the velocity solver', { unit: '1' }),
      intSetting('position_steps', 'quality', [0, 255], 2, 'iterations of the position solver', { unit: '1' }),
      intSetting('collision_steps', 'quality', [1, 256], 1, 'sub-steps with collision detection', { unit: '1' }),
      floatSetting('baumgarte', 'behaviour', [0, 1], 0.2, 'share of the position error that an update corrects', { unit: '1' }),
      floatSetting('penetration_slop', 'behaviour', [0, 1], 0.02, 'overlap that is left alone', { unit: 'm' }),
      floatSetting('speculative_distance', 'behaviour', [0, 1], 0.02, 'contacts are found before they touch', { unit: 'm' }),
      floatSetting('restitution_threshold', 'behaviour', [0, 1e4], 1, 'slower impacts do not bounce', { unit: 'm/s' }),
      floatSetting('convex_radius', 'behaviour', [0, 1], 0.05, 'rounding of boxes, cylinders and hulls in the search for closest points', { unit: 'm', creation_only: true }),
      floatSetting('max_angular_velocity', 'behaviour', [0, 1e6], 47.1238898, 'faster bodies are slowed to it', { unit: 'rad/s', creation_only: true }),
      boolSetting('sleeping', 'behaviour', true, 'bodies at rest are put to sleep, where the world declares sleeping'),
      boolSetting('warm_starting', 'behaviour', true, 'impulses of the step before are a first guess'),
    ],
    capabilities: [
      ...USUAL,
      ['shape', 'plane', 'static', 'native', 'a kilometre wide'],
      ['shape', 'mesh', 'kinematic', 'native'],
      ['joint', 'ball|hinge|slider|fixed|distance', '*', 'native'],
      ['joint', 'universal|generic', '*', 'emulated', "Jolt's six-axis constraint"],
      ['joint_feature', 'hinge|slider|distance', 'limits', 'native'],
      ['joint_feature', 'generic', 'limits', 'emulated'],
      ['joint_feature', 'hinge|slider', 'motors', 'native'],
      ['joint_feature', 'hinge|slider|distance', 'springs', 'native'],
      ['joint_feature', 'hinge|slider', 'stiffness', 'native'],
      ['joint_feature', 'ball|hinge|slider|fixed|distance', 'reaction', 'native', 'from the impulses of the velocity solver'],
      ['joint_feature', 'ball|hinge|slider|fixed|distance', 'breaks', 'emulated', 'the reaction is compared after each step'],
      ['query', 'ray|overlap', '*', 'native'],
      ['query', 'cast', '*', 'approximate', 'edges are rounded by the convex radius'],
      ['query', 'cast', 'sphere|capsule', 'native'],
      ['write', 'damping|filter|awake|surface_velocity', '*', 'native'],
      ['need', 'joints|ccd|sleeping|gyroscopic|damping|axis_locks|filters|queries|joint_reactions', '*', 'native'],
      ['need', 'events|contacts|sensors|surface_velocity', '*', 'emulated', 'by the contact listener, which calls JavaScript'],
      ['child_material', '*', '*', 'emulated', 'by the contact listener, which calls JavaScript'],
      ['event', '*', '*', 'emulated', 'by comparing one step with the next'],
    ],
  };
}

export async function createWorld(init) {
  const { default: initJolt } = await load(PACKAGE, 'dist/jolt-physics.wasm-compat.js');
  return new JoltWorld(await initJolt(), init);
}

class JoltWorld extends WorldBase {
  constructor(J, init) {
    super(init);
    this.J = J;
    this.temporary = [];
    const settings = new J.JoltSettings(), layers = new J.ObjectLayerPairFilterTable(2), broad = new J.BroadPhaseLayerInterfaceTable(2, 2);
    layers.EnableCollision(0, 1);
    layers.EnableCollision(1, 1);
    broad.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
    broad.MapObjectToBroadPhaseLayer(1, new J.BroadPhaseLayer(1));
    settings.mObjectLayerPairFilter = layers;
    settings.mBroadPhaseLayerInterface = broad;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(broad, 2, layers, 2);
    settings.mMaxBodies = 65536;
    settings.mMaxBodyPairs = 65536;
    settings.mMaxContactConstraints = MOST_CONTACTS;
    this.jolt = new J.JoltInterface(settings);
    J.destroy(settings);
    this.system = this.jolt.GetPhysicsSystem();
    this.interface = this.system.GetBodyInterface();
    this.slotOfId = new Map();
    this.rows = [];
    this.setGravity(init.gravity);
    this.groups();
    if (this.tellsTouches || this.needs.has('contacts') || this.needs.has('surface_velocity')) this.listen();
    this.applySettings({});
  }

  /** Temporary objects of Jolt's heap live until the next sweep. */
  vec([x, y, z]) { return this.keep(new this.J.Vec3(x, y, z)); }
  at([x, y, z]) { return this.keep(new this.J.RVec3(x, y, z)); }
  quat([x, y, z, w]) {
    const n = 1 / Math.hypot(x, y, z, w);
    return this.keep(new this.J.Quat(n * x, n * y, n * z, n * w));
  }
  keep(object) { return this.temporary.push(object), object; }
  sweep() {
    for (const object of this.temporary) this.J.destroy(object);
    this.temporary = [];
  }

  setGravity(gravity) {
    this.system.SetGravity(this.vec(gravity));
    this.sweep();
  }
  applySettings(changed) {
    super.applySettings(changed);
    const s = this.settings, p = this.system.GetPhysicsSettings();
    p.mNumVelocitySteps = s.velocity_steps;
    p.mNumPositionSteps = s.position_steps;
    p.mBaumgarte = s.baumgarte;
    p.mPenetrationSlop = s.penetration_slop;
    p.mSpeculativeContactDistance = s.speculative_distance;
    p.mMinVelocityForRestitution = s.restitution_threshold;
    p.mConstraintWarmStart = s.warm_starting;
    p.mAllowSleeping = s.sleeping && this.needs.has('sleeping');
    this.system.SetPhysicsSettings(p);
  }

  /** Filters, exceptions and joints: a group filter in JavaScript, of those bodies alone that need one. */
  groups() {
    const J = this.J, filter = new J.GroupFilterJS();
    filter.CanCollide = (one, two) => this.collides(J.wrapPointer(one, J.CollisionGroup).GetGroupID(), J.wrapPointer(two, J.CollisionGroup).GetGroupID());
    filter.AddRef?.();
    this.groupFilter = filter;
  }
  grouped(slot) {
    const { body } = this.bodies.get(slot), group = body.GetCollisionGroup();
    group.SetGroupFilter(this.groupFilter);
    this.interface.InvalidateContactCache(body.GetID());
  }

  // --- shapes --------------------------------------------------------------------------------------------------------

  createShape(desc) {
    const shape = this.makeShape(desc);
    shape.AddRef();
    this.sweep();
    this.shapes.set(desc.slot, { desc, shape });
  }
  destroyShape(slot) {
    this.shapes.get(slot).shape.Release();
    this.shapes.delete(slot);
  }
  /** The shape of settings, of which Jolt counts references. */
  cook(settings) {
    const result = settings.Create();
    if (result.HasError()) throw new Error(`Jolt refuses the shape: ${result.GetError().c_str()}`);
    const shape = result.Get();
    shape.AddRef();
    this.J.destroy(settings);
    return shape;
  }
  makeShape(desc) {
    const J = this.J, rounding = (smallest) => Math.min(this.settings.convex_radius, 0.5 * smallest);
    switch (desc.type) {
      case SPHERE: return new J.SphereShape(desc.radius);
      case BOX: return new J.BoxShape(this.vec(desc.halfExtents), rounding(Math.min(...desc.halfExtents)));
      case CAPSULE: return desc.halfHeight === 0 ? new J.SphereShape(desc.radius) : new J.CapsuleShape(desc.halfHeight, desc.radius);
      case CYLINDER: return new J.CylinderShape(desc.halfHeight, desc.radius, rounding(Math.min(desc.halfHeight, desc.radius)));
      case HULL: {
        const settings = new J.ConvexHullShapeSettings();
        for (let i = 0; i < desc.vertices.length; i += 3) settings.mPoints.push_back(this.vec(desc.vertices.subarray(i, i + 3)));
        settings.mMaxConvexRadius = this.settings.convex_radius;
        return this.cook(settings);
      }
      case MESH:
      case HEIGHT_FIELD: return this.makeMesh(desc.type === MESH ? desc : meshOfHeightField(desc));
      case PLANE: return new J.PlaneShape(this.keep(new J.Plane(this.vec([0, 1, 0]), 0)), null, 1000);
      case COMPOUND: {
        const settings = new J.StaticCompoundShapeSettings();
        for (const child of desc.children)
          settings.AddShapeShape(this.vec(child.pose.position), this.quat(child.pose.orientation), this.shapes.get(child.shape).shape, 0);
        return this.cook(settings);
      }
      default: return refuse(`shapes of type ${desc.type}`);
    }
  }
  makeMesh({ vertices, indices }) {
    const J = this.J, points = this.keep(new J.VertexList()), triangles = this.keep(new J.IndexedTriangleList());
    for (let i = 0; i < vertices.length; i += 3) points.push_back(this.keep(new J.Float3(...vertices.subarray(i, i + 3))));
    for (let i = 0; i < indices.length; i += 3) triangles.push_back(this.keep(new J.IndexedTriangle(...indices.subarray(i, i + 3), 0, i / 3)));
    return this.cook(new J.MeshShapeSettings(points, triangles, this.keep(new J.PhysicsMaterialList())));
  }
  /** With the centre of mass where the descriptor has it. */
  shapeOfBody(desc) {
    const J = this.J;
    const shape = desc.shape < 0 ? this.cook(new J.EmptyShapeSettings()) : this.shapes.get(desc.shape).shape;
    const offset = sub(desc.centre, array(shape.GetCenterOfMass()));
    return desc.motion === DYNAMIC && length(offset) > 1e-6 ? new J.OffsetCenterOfMassShape(shape, this.vec(offset)) : shape;
  }

  // --- bodies --------------------------------------------------------------------------------------------------------

  createBody(desc) {
    const J = this.J;
    const settings = new J.BodyCreationSettings(this.shapeOfBody(desc), this.at(desc.pose.position), this.quat(desc.pose.orientation),
      [J.EMotionType_Static, J.EMotionType_Kinematic, J.EMotionType_Dynamic][desc.motion], desc.motion === STATIC ? 0 : 1);
    if (desc.motion !== STATIC) {
      settings.mLinearVelocity = this.vec(desc.linear);
      settings.mAngularVelocity = this.vec(desc.angular);
    }
    settings.mLinearDamping = desc.linearDamping;
    settings.mAngularDamping = desc.angularDamping;
    settings.mGravityFactor = desc.gravityScale;
    settings.mFriction = desc.material.friction;
    settings.mRestitution = desc.material.restitution;
    settings.mMaxLinearVelocity = 1e6;
    settings.mMaxAngularVelocity = this.settings.max_angular_velocity;
    settings.mApplyGyroscopicForce = this.needs.has('gyroscopic');
    settings.mAllowSleeping = (desc.flags & NEVER_SLEEPS) === 0;
    settings.mIsSensor = (desc.flags & SENSOR) !== 0;
    settings.mCollideKinematicVsNonDynamic = this.needs.has('sensors') && desc.motion !== STATIC;
    settings.mMotionQuality = (desc.flags & CCD) !== 0 ? J.EMotionQuality_LinearCast : J.EMotionQuality_Discrete;
    const still = (desc.flags & NO_ROTATION) !== 0;
    settings.mAllowedDOFs = 63 & ~desc.locks & (still ? 7 : 63);
    if (desc.motion === DYNAMIC) {
      if (settings.mAllowedDOFs === 0) refuse('a dynamic body of which all axes are locked');
      settings.mOverrideMassProperties = J.EOverrideMassProperties_MassAndInertiaProvided;
      settings.mMassPropertiesOverride.mMass = desc.mass;
      settings.mMassPropertiesOverride.mInertia = this.inertia(desc, still);
    }
    const body = this.interface.CreateBody(settings);
    if (J.getPointer(body) === 0) refuse('more than 65536 bodies');
    J.destroy(settings);
    const ownMaterials = desc.shape >= 0 && this.parts(desc.shape).some(({ material }) => material !== null);
    if (ownMaterials) this.listen();
    this.bodies.set(desc.slot, { desc, body, ownMaterials });
    this.slotOfId.set(body.GetID().GetIndexAndSequenceNumber(), desc.slot);
    this.interface.AddBody(body.GetID(), (desc.flags & ASLEEP) !== 0 ? J.EActivation_DontActivate : J.EActivation_Activate);
    body.GetCollisionGroup().SetGroupID(desc.slot);
    if (this.needs.has('filters')) this.grouped(desc.slot);
    this.sweep();
  }
  inertia(desc, still) {
    const J = this.J, turn = J.Mat44.prototype.sRotation(this.quat(desc.inertiaOrientation));
    const axes = [turn.GetAxisX(), turn.GetAxisY(), turn.GetAxisZ()].map(array);
    const moments = still ? [1, 1, 1] : desc.inertia;
    const matrix = this.keep(new J.Mat44());
    for (let column = 0; column < 3; ++column) {
      const sum = [0, 1, 2].reduce((so, k) => add(so, scale(moments[k] * axes[k][column], axes[k])), [0, 0, 0]);
      matrix.SetColumn4(column, this.keep(new J.Vec4(...sum, 0)));
    }
    matrix.SetColumn4(3, this.keep(new J.Vec4(0, 0, 0, 1)));
    return matrix;
  }
  destroyBody(slot) {
    const { body } = this.bodies.get(slot), id = body.GetID();
    this.slotOfId.delete(id.GetIndexAndSequenceNumber());
    this.wakeNear(slot);
    this.interface.RemoveBody(id);
    this.interface.DestroyBody(id);
    this.bodies.delete(slot);
  }
  /** Who sleeps on a body that goes or that an exception takes away has to fall. */
  wakeNear(slot) {
    if (!this.needs.has('sleeping')) return;
    const box = this.bodies.get(slot).body.GetWorldSpaceBounds();
    this.all ??= [new this.J.BroadPhaseLayerFilter(), new this.J.ObjectLayerFilter()];
    this.interface.ActivateBodiesInAABox(box, ...this.all);
  }
  pose(slot) {
    const { body } = this.bodies.get(slot), position = array(body.GetPosition()), r = body.GetRotation();
    return [...position, r.GetX(), r.GetY(), r.GetZ(), r.GetW()];
  }
  velocity(slot) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return [0, 0, 0, 0, 0, 0];
    return [...array(body.GetLinearVelocity()), ...array(body.GetAngularVelocity())];
  }
  awake(slot) {
    const { body, desc } = this.bodies.get(slot);
    return [desc.motion !== DYNAMIC || body.IsActive() ? 1 : 0];
  }
  activation(slot) {
    return this.bodies.get(slot).desc.motion === STATIC ? this.J.EActivation_DontActivate : this.J.EActivation_Activate;
  }
  setPose(slot, position, orientation) {
    this.interface.SetPositionAndRotation(this.bodies.get(slot).body.GetID(), this.at(position), this.quat(orientation), this.activation(slot));
    this.sweep();
  }
  setVelocity(slot, linear, angular) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    this.interface.ActivateBody(body.GetID());
    this.interface.SetLinearAndAngularVelocity(body.GetID(), this.vec(linear), this.vec(angular));
    this.sweep();
  }
  setAwake(slot, awake) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion !== DYNAMIC) return;
    if (awake) this.interface.ActivateBody(body.GetID());
    else this.interface.DeactivateBody(body.GetID());
  }
  setMaterial(slot, friction, restitution) {
    const { body, desc } = this.bodies.get(slot);
    Object.assign(desc.material, { friction, restitution });
    body.SetFriction(friction);
    body.SetRestitution(restitution);
    this.interface.InvalidateContactCache(body.GetID());
  }
  setGravityScale(slot, factor) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    this.interface.SetGravityFactor(body.GetID(), factor);
    this.setAwake(slot, true);
  }
  setDamping(slot, linear, angular) {
    const { body, desc } = this.bodies.get(slot);
    if (desc.motion === STATIC) return;
    body.GetMotionProperties().SetLinearDamping(linear);
    body.GetMotionProperties().SetAngularDamping(angular);
  }
  setFilter(slot, filter) {
    this.bodies.get(slot).desc.filter = filter;
    this.grouped(slot);
    this.wakeNear(slot);
  }
  setException(a, b, touch) {
    super.setException(a, b, touch);
    for (const slot of [a, b]) {
      this.grouped(slot);
      this.setAwake(slot, true);
    }
  }
  setSurfaceVelocity(slot, velocity) {
    this.bodies.get(slot).desc.material.surfaceVelocity = velocity;
    this.wakeNear(slot);
  }
  addForce(slot, force, torque) {
    this.interface.AddForceAndTorque(this.bodies.get(slot).body.GetID(), this.vec(force), this.vec(torque), this.J.EActivation_Activate);
  }

  // --- step and contacts ---------------------------------------------------------------------------------------------

  listen() {
    if (this.listener) return;
    const J = this.J, listener = (this.listener = new J.ContactListenerJS());
    listener.OnContactValidate = () => J.ValidateResult_AcceptAllContactsForThisBodyPair;
    listener.OnContactAdded = listener.OnContactPersisted = (one, two, manifold, settings) => this.note(
      J.wrapPointer(one, J.Body), J.wrapPointer(two, J.Body), J.wrapPointer(manifold, J.ContactManifold), J.wrapPointer(settings, J.ContactSettings));
    listener.OnContactRemoved = () => {};
    this.system.SetContactListener(listener);
  }
  slotOf(id) { return this.slotOfId.get(id.GetIndexAndSequenceNumber()); }
  /** Child of a compound: Jolt's numbers of parts of shapes begin with it. */
  childOf(slot, id) {
    const { desc } = this.bodies.get(slot), count = desc.shape < 0 ? 1 : this.parts(desc.shape).length;
    return count > 1 ? id.GetValue() & (2 ** (32 - Math.clz32(count - 1)) - 1) : 0;
  }
  note(one, two, manifold, settings) {
    const a = this.slotOf(one.GetID()), b = this.slotOf(two.GetID());
    const childA = this.childOf(a, manifold.mSubShapeID1), childB = this.childOf(b, manifold.mSubShapeID2);
    this.combine(this.bodies.get(a), childA, this.bodies.get(b), childB, settings);
    if (!this.tellsTouches && !this.needs.has('contacts')) return;
    const normal = array(manifold.mWorldSpaceNormal), base = array(manifold.mBaseOffset);
    const on1 = manifold.mRelativeContactPointsOn1, on2 = manifold.mRelativeContactPointsOn2;
    for (let i = 0; i < on1.size(); ++i) {
      const p = array(on1.at(i)), q = array(on2.at(i)), depth = sub(p, q).reduce((sum, x, k) => sum + x * normal[k], 0);
      this.rows.push(a, b, childA, childB, ...add(base, scale(0.5, add(p, q))), ...normal, depth, NaN, NaN, NaN, NaN, 0);
    }
  }
  /** What of the two materials Jolt does not know. */
  combine(a, childA, b, childB, settings) {
    const [one, two] = [[a, childA], [b, childB]].map(([{ desc, ownMaterials }, child]) => (ownMaterials && this.parts(desc.shape)[child].material) || desc.material);
    if (a.ownMaterials || b.ownMaterials) {
      settings.mCombinedFriction = Math.sqrt(one.friction * two.friction);
      settings.mCombinedRestitution = Math.max(one.restitution, two.restitution);
    }
    if (!this.needs.has('surface_velocity') || [...one.surfaceVelocity, ...two.surfaceVelocity].every((x) => x === 0)) return;
    const [v, w] = [[a, one], [b, two]].map(([{ body }, { surfaceVelocity }]) => {
      const r = body.GetRotation();
      return rotate([r.GetX(), r.GetY(), r.GetZ(), r.GetW()], surfaceVelocity);
    });
    settings.mRelativeLinearSurfaceVelocity = this.vec(sub(w, v));
  }
  step(dt) {
    const before = this.rows;
    this.rows = [];
    this.dt = dt / this.settings.collision_steps;
    this.jolt.Step(dt, this.settings.collision_steps);
    this.rows = this.withSleepers(before, this.rows);
  }
  afterStep() {
    this.sweep();
    return this.told(this.rows, 1e-3);
  }
  contacts() { return this.solidRows(this.rows); }

  // --- joints --------------------------------------------------------------------------------------------------------

  createJoint(desc) {
    const J = this.J, a = desc.a < 0 ? this.world() : this.bodies.get(desc.a).body;
    const joint = this.makeJoint(desc, a, this.bodies.get(desc.b).body);
    joint.AddRef();
    this.joints.set(desc.slot, { desc, joint });
    this.drive(desc, joint);
    this.system.AddConstraint(joint);
    this.part(desc, 1);
    this.regroup(desc);
    this.sweep();
  }
  world() { return this.jolt.sGetFixedToWorldBody(); }
  regroup(desc) {
    for (const end of [desc.a, desc.b]) {
      if (end < 0) continue;
      if (!desc.collideConnected && desc.a >= 0) this.grouped(end);
      this.setAwake(end, true);
    }
  }
  frame(body, { position, orientation }) {
    const centre = body === null ? [0, 0, 0] : array(body.GetShape().GetCenterOfMass());
    return { point: this.at(sub(position, centre)), x: this.vec(rotate(orientation, [1, 0, 0])), y: this.vec(rotate(orientation, [0, 1, 0])) };
  }
  makeJoint(desc, bodyA, bodyB) {
    const J = this.J, shifted = shiftOf(desc);
    const a = this.frame(desc.a < 0 ? null : bodyA, shifted), b = this.frame(bodyB, desc.frameB);
    const set = (settings, values) => Object.assign(settings, { mSpace: J.EConstraintSpace_LocalToBodyCOM, ...values });
    const made = (settings) => {
      const constraint = settings.Create(bodyA, bodyB);
      J.destroy(settings);
      return constraint;
    };
    const { limit: linear, spring } = desc.axes[0], { limit: angular } = desc.axes[3], middle = middleOf(desc);
    switch (desc.type) {
      case BALL: return J.castObject(made(set(new J.PointConstraintSettings(), { mPoint1: a.point, mPoint2: b.point })), J.PointConstraint);
      case HINGE: {
        const s = set(new J.HingeConstraintSettings(), { mPoint1: a.point, mPoint2: b.point, mHingeAxis1: a.x, mHingeAxis2: b.x, mNormalAxis1: a.y, mNormalAxis2: b.y });
        if (angular.enabled) Object.assign(s, { mLimitsMin: Math.max(angular.lower - middle, -Math.PI), mLimitsMax: Math.min(angular.upper - middle, Math.PI) });
        return J.castObject(made(s), J.HingeConstraint);
      }
      case SLIDER: {
        const s = set(new J.SliderConstraintSettings(), { mPoint1: a.point, mPoint2: b.point, mSliderAxis1: a.x, mSliderAxis2: b.x, mNormalAxis1: a.y, mNormalAxis2: b.y });
        s.mAutoDetectPoint = false;
        if (linear.enabled) Object.assign(s, { mLimitsMin: linear.lower - middle, mLimitsMax: linear.upper - middle });
        return J.castObject(made(s), J.SliderConstraint);
      }
      case DISTANCE: {
        const s = set(new J.DistanceConstraintSettings(), { mPoint1: a.point, mPoint2: b.point });
        s.mMinDistance = linear.enabled ? linear.lower : desc.restLength;
        s.mMaxDistance = linear.enabled ? linear.upper : desc.restLength;
        if (spring.enabled) this.soften(s.mLimitsSpringSettings, spring);
        return J.castObject(made(s), J.DistanceConstraint);
      }
      case FIXED: {
        if (this.needs.has('joint_reactions') || this.needs.has('events')) return this.makeSixAxes(desc, a, b, bodyA, bodyB);  // which tells them
        const s = set(new J.FixedConstraintSettings(), { mPoint1: a.point, mPoint2: b.point, mAxisX1: a.x, mAxisX2: b.x, mAxisY1: a.y, mAxisY2: b.y });
        s.mAutoDetectPoint = false;
        return made(s);
      }
      default: return this.makeSixAxes(desc, a, b, bodyA, bodyB);
    }
  }
  // A universal joint's rotations come in the other order: its first body is our second.
  makeSixAxes(desc, frameA, frameB, bodyA, bodyB) {
    const J = this.J, s = new J.SixDOFConstraintSettings(), universal = desc.type === UNIVERSAL;
    const [one, two] = universal ? [frameB, frameA] : [frameA, frameB];
    Object.assign(s, { mSpace: J.EConstraintSpace_LocalToBodyCOM, mSwingType: J.ESwingType_Pyramid,
      mPosition1: one.point, mAxisX1: one.x, mAxisY1: one.y, mPosition2: two.point, mAxisX2: two.x, mAxisY2: two.y });
    desc.axes.forEach(({ mode, limit }, axis) => {
      const how = universal ? (axis === 3 || axis === 4 ? 0 : LOCKED) : desc.type === FIXED ? LOCKED : mode;
      if (how === 0) s.MakeFreeAxis(axis);
      else if (how === LOCKED) s.MakeFixedAxis(axis);
      else s.SetLimitedAxis(axis, limit.lower, limit.upper);
    });
    const made = universal ? s.Create(bodyB, bodyA) : s.Create(bodyA, bodyB);
    J.destroy(s);
    return J.castObject(made, J.SixDOFConstraint);
  }
  soften(settings, spring) {
    const J = this.J;
    settings.mMode = spring.byStiffness ? J.ESpringMode_StiffnessAndDamping : J.ESpringMode_FrequencyAndDamping;
    if (spring.byStiffness) settings.mStiffness = Math.max(spring.frequency, 1e-6 * spring.ratio);  // without any there is no damping either
    else settings.mFrequency = spring.frequency;
    settings.mDamping = spring.ratio;
  }
  drive(desc, joint) {
    if (desc.type !== HINGE && desc.type !== SLIDER) return;
    const J = this.J, hinge = desc.type === HINGE, { motor, spring } = desc.axes[hinge ? 3 : 0], how = joint.GetMotorSettings();
    const most = spring.enabled && !motor.enabled ? 3e38 : motor.most;
    Object.assign(how, hinge ? { mMinTorqueLimit: -most, mMaxTorqueLimit: most } : { mMinForceLimit: -most, mMaxForceLimit: most });
    if (spring.enabled) this.soften(how.mSpringSettings, spring);
    joint.SetMotorState(motor.enabled ? J.EMotorState_Velocity : spring.enabled ? J.EMotorState_Position : J.EMotorState_Off);
    if (hinge) {
      joint.SetTargetAngularVelocity(motor.target);
      joint.SetTargetAngle(spring.rest - middleOf(desc));
    } else {
      joint.SetTargetVelocity(motor.target);
      joint.SetTargetPosition(spring.rest - middleOf(desc));
    }
  }
  setMotors(slot, motors) {
    const { desc, joint } = this.joints.get(slot);
    desc.axes.forEach((axis, i) => { axis.motor = motors[i]; });
    this.drive(desc, joint);
    for (const end of [desc.a, desc.b]) if (end >= 0) this.setAwake(end, true);
  }
  destroyJoint(slot) {
    const { desc, joint } = this.joints.get(slot);
    this.system.RemoveConstraint(joint);
    joint.Release();
    this.part(desc, -1);
    this.regroup(desc);
    this.joints.delete(slot);
  }
  /** On b, from the impulses of the last sub-step. */
  reaction(slot) {
    const { desc, joint } = this.joints.get(slot), [a, b] = [[desc.a, desc.frameA], [desc.b, desc.frameB]].map(([end, frame]) => {
      const row = end < 0 ? [0, 0, 0, 0, 0, 0, 1] : this.pose(end);
      return compose({ position: row.slice(0, 3), orientation: row.slice(3) }, frame);
    });
    return impulsesOf(desc.type, joint, a, b).map((impulse) => (this.dt > 0 ? impulse / this.dt : 0));
  }

  // --- queries -------------------------------------------------------------------------------------------------------

  filters() {
    const J = this.J;
    return (this.everything ??= [new J.BroadPhaseLayerFilter(), new J.ObjectLayerFilter(), new J.BodyFilter(), new J.ShapeFilter()]);
  }
  castRay({ origin, translation, filter }) {
    const J = this.J, collector = this.keep(new J.CastRayAllHitCollisionCollector());
    this.system.GetNarrowPhaseQuery().CastRay(this.keep(new J.RRayCast(this.at(origin), this.vec(translation))), this.keep(new J.RayCastSettings()), collector, ...this.filters());
    const hits = [];
    for (let i = 0; i < collector.mHits.size(); ++i) {
      const hit = collector.mHits.at(i), body = this.slotOf(hit.mBodyID), fraction = hit.mFraction;
      if (!this.sees(filter, body)) continue;
      const position = add(origin, scale(fraction, translation));
      const normal = array(this.bodies.get(body).body.GetWorldSpaceSurfaceNormal(hit.mSubShapeID2, this.at(position)));
      hits.push({ body, child: this.childOf(body, hit.mSubShapeID2), fraction, position, normal });
    }
    this.sweep();
    return hits;
  }
  /** Where a shape's centre of mass is. */
  placeOf(shape, pose) {
    const at = add(pose.position, rotate(pose.orientation, array(shape.GetCenterOfMass())));
    return this.J.RMat44.prototype.sRotationTranslation(this.quat(pose.orientation), this.at(at));
  }
  castShape({ shape, pose, translation, filter }) {
    const J = this.J, collector = this.keep(new J.CastShapeAllHitCollisionCollector()), probe = this.shapes.get(shape).shape, settings = this.keep(new J.ShapeCastSettings());
    settings.mReturnDeepestPoint = settings.mUseShrunkenShapeAndConvexRadius = true;  // with sharp edges some of a hundred casts of boxes at boxes miss
    settings.mBackFaceModeConvex = settings.mBackFaceModeTriangles = J.EBackFaceMode_CollideWithBackFaces;  // else what overlaps at the start may not be seen
    this.system.GetNarrowPhaseQuery().CastShape(this.keep(new J.RShapeCast(probe, this.vec([1, 1, 1]), this.placeOf(probe, pose), this.vec(translation))), settings, this.at([0, 0, 0]), collector, ...this.filters());
    const hits = [];
    for (let i = 0; i < collector.mHits.size(); ++i) {
      const hit = collector.mHits.at(i), body = this.slotOf(hit.mBodyID2), way = array(hit.mPenetrationAxis), position = array(hit.mContactPointOn2);
      if (!this.sees(filter, body)) continue;
      let normal = scale(-1 / length(way), way);
      if (dot(normal, translation) >= 0)  // where two edges barely touch Jolt's axis may point anywhere
        normal = array(this.bodies.get(body).body.GetWorldSpaceSurfaceNormal(hit.mSubShapeID2, this.at(position)));
      hits.push({ body, child: this.childOf(body, hit.mSubShapeID2), fraction: hit.mFraction, position, normal });
    }
    this.sweep();
    return hits;
  }
  overlapShape({ shape, pose, filter }) {
    const J = this.J, collector = this.keep(new J.CollideShapeAllHitCollisionCollector()), probe = this.shapes.get(shape).shape;
    const place = this.placeOf(probe, pose);
    this.system.GetNarrowPhaseQuery().CollideShape(probe, this.vec([1, 1, 1]), place, this.keep(new J.CollideShapeSettings()), this.at([0, 0, 0]), collector, ...this.filters());
    const hits = [];
    for (let i = 0; i < collector.mHits.size(); ++i) {
      const hit = collector.mHits.at(i), body = this.slotOf(hit.mBodyID2);
      if (this.sees(filter, body)) hits.push({ body, child: this.childOf(body, hit.mSubShapeID2) });
    }
    this.sweep();
    return hits;
  }
}

/** Jolt's limits must hold 0: the middle of those that do not. */
function middleOf(desc) {
  const { limit } = desc.axes[desc.type === HINGE ? 3 : 0];
  if (desc.type !== HINGE && desc.type !== SLIDER) return 0;
  return limit.enabled && (limit.lower > 0 || limit.upper < 0) ? 0.5 * (limit.lower + limit.upper) : 0;
}
/** Frame a, moved or turned to that middle. */
function shiftOf(desc) {
  const middle = middleOf(desc), { position, orientation: q } = desc.frameA;
  if (desc.type === SLIDER) return { position: add(position, rotate(q, [middle, 0, 0])), orientation: q };
  const s = Math.sin(middle / 2), c = Math.cos(middle / 2);
  return { position, orientation: [q[3] * s + q[0] * c, q[1] * c + q[2] * s, q[2] * c - q[1] * s, q[3] * c - q[0] * s] };
}
