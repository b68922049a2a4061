// One world. MuJoCo compiles a model of all of it: what comes or goes makes it anew when it is next needed, and what moves
// is carried over. A step is MuJoCo's own, phase by phase, with contacts' materials and motors' speeds put in between.
import { DISTANCE, DYNAMIC, KINEMATIC, NO_ROTATION, STATIC } from '../../rows.mjs';
import { add, cross, length, multiply, rotate, scale, sub, unrotate } from '../../algebra.mjs';
import { WorldBase, refuse } from '../../base.mjs';
import { Failure } from '../../failure.mjs';
import { Contacts, Impulses, driveSurfaces, judge, knowsContacts } from './contacts.mjs';
import { centreOf, spread, turnedBy } from './mass.mjs';
import { Model, three, wxyz, xyzw } from './model.mjs';
import { castRay } from './rays.mjs';
import { gatherReactions } from './reactions.mjs';
import { applyToModel, isEuler } from './settings.mjs';
import { freeVelocity, pushTree, readState, velocityOfCentre, writeFree, writeState } from './state.mjs';
import { growTree, isPlainBall } from './tree.mjs';

const FRICTION = 1;  // as mjtConstraint counts
const CONTACT_FULL = 1, CONSTRAINT_FULL = 2;  // as mjtWarning does
const TURNS = 0b111000;
const WORLD_LOST = -13;

/** By a vector of axis times angle, world axes. */
function turned(q, by) {
  const angle = length(by), half = angle === 0 ? 0.5 : Math.sin(angle / 2) / angle;
  const [x, y, z, w] = multiply([...scale(half, by), Math.cos(angle / 2)], q), n = 1 / Math.hypot(x, y, z, w);
  return [n * x, n * y, n * z, n * w];
}
const normalized = (q) => turned(q, [0, 0, 0]);

export class MujocoWorld extends WorldBase {
  constructor(M, init) {
    super(init);
    if (!knowsContacts(M)) refuse(`the package's MuJoCo ${M.mj_versionString()} lays contacts out otherwise than 3.14, which this adapter knows; install the version of its lock file`);
    this.M = M;
    this.gravity = init.gravity;
    this.pushes = [];
    this.impulses = new Impulses();
    this.model = null;
    this.stale = true;  // what lives has changed since the model was made
    this.asked = this.needs.has('joint_reactions') || this.needs.has('events');
  }
  get meets() { return this.needs.has('collision') || this.needs.has('sensors'); }
  get rolls() { return this.needs.has('rolling_friction'); }

  setGravity(gravity) {
    this.gravity = gravity;
    if (!this.stale) this.model.model.opt.gravity.set(gravity);
  }
  applySettings(changed) {
    super.applySettings(changed);
    if (!this.stale) applyToModel(this.settings, this.model.traits, this.model.model);
  }

  // --- bodies --------------------------------------------------------------------------------------------------------

  createBody(desc) {
    const still = desc.motion === STATIC;
    this.bodies.set(desc.slot, {
      slot: desc.slot, desc, pose: { position: desc.pose.position, orientation: normalized(desc.pose.orientation) },
      velocity: still ? [0, 0, 0] : desc.linear, spin: still ? [0, 0, 0] : desc.angular, rolling: 0, spinning: 0, written: true,
    });
    this.stale = true;
  }
  destroyBody(slot) {
    this.bodies.delete(slot);
    this.impulses = new Impulses();
    this.stale = true;
  }
  partsOf({ desc }) { return desc.shape < 0 ? [] : this.parts(desc.shape); }

  pose(slot) {
    const { position, orientation } = this.bodies.get(slot).pose;
    return [...position, ...orientation];
  }
  velocity(slot) {
    const { velocity, spin } = this.bodies.get(slot);
    return [...velocity, ...spin];
  }
  awake() { return [1]; }
  setPose(slot, position, orientation) {
    Object.assign(this.bodies.get(slot), { pose: { position, orientation: normalized(orientation) }, written: true });
  }
  setVelocity(slot, velocity, spin) {
    if (this.bodies.get(slot).desc.motion !== STATIC) Object.assign(this.bodies.get(slot), { velocity, spin, written: true });
  }
  setMaterial(slot, friction, restitution) { Object.assign(this.bodies.get(slot).desc.material, { friction, restitution }); }
  setSurfaceVelocity(slot, surfaceVelocity) { this.bodies.get(slot).desc.material.surfaceVelocity = surfaceVelocity; }
  setRollingFriction(slot, rolling, spinning) { Object.assign(this.bodies.get(slot), { rolling, spinning }); }
  setGravityScale(slot, factor) { this.bodies.get(slot).desc.gravityScale = factor; }
  setDamping(slot, linear, angular) { Object.assign(this.bodies.get(slot).desc, { linearDamping: linear, angularDamping: angular }); }
  setFilter(slot, filter) { this.bodies.get(slot).desc.filter = filter; }

  addForce(slot, force, torque) { this.pushes.push({ slot, force, torque }); }
  addImpulse(slot, impulse) { this.push(this.bodies.get(slot), impulse, [0, 0, 0]); }
  addAngularImpulse(slot, twist) { this.push(this.bodies.get(slot), [0, 0, 0], twist); }
  addImpulseAt(slot, impulse, point) {
    const body = this.bodies.get(slot);
    this.push(body, impulse, cross(sub(point, centreOf(body)), impulse));
  }
  /** Changes the velocity at once: of a body in a tree with all that hangs on it. */
  push(body, impulse, twist) {
    if (body.desc.motion !== DYNAMIC) return;
    this.prepare();
    if (body.link !== null || body.children.length > 0) return pushTree(this.model, body, impulse, twist);
    body.velocity = add(body.velocity, scale(1 / body.desc.mass, impulse));
    body.spin = add(body.spin, turnedBy(body, twist));
    [body.velocity, body.spin] = freeVelocity(body);
    body.written = true;
  }

  /** The model is that of the world, and what was written is in its data. */
  prepare() {
    if (this.stale) {
      const tree = growTree(this.bodies, this.joints);
      this.model?.delete();
      this.model = null;
      this.model = new Model(this.M, tree, { joints: this.joints, settings: this.settings, rolls: this.rolls, collides: this.meets, partsOf: (body) => this.partsOf(body) });
      this.model.model.opt.gravity.set(this.gravity);
      this.stale = false;
    }
    writeState(this.model);
  }

  // --- the step ------------------------------------------------------------------------------------------------------

  step(dt) {
    this.prepare();
    const { substeps } = this.settings, h = dt / substeps, begin = this.begin();
    this.model.model.opt.timestep = h;
    for (;;) {
      this.impulses = new Impulses();
      for (const joint of this.joints.values()) Object.assign(joint, { force: [0, 0, 0], torque: [0, 0, 0] });
      if (this.hadRoom(() => { for (let part = 0; part < substeps; ++part) this.subStep(h, part); })) break;
      this.model.grow();
      this.goBack(begin);
    }
    this.pushes = [];
    readState(this.model);
  }
  /** All that a step begins with. */
  begin() {
    return {
      state: ['qpos', 'qvel', 'qacc_warmstart'].map((name) => [name, this.model.d(name).slice()]),
      poses: [...this.bodies.values()].filter(({ desc }) => desc.motion === KINEMATIC).map((body) => [body, body.pose]),
    };
  }
  goBack({ state, poses }) {
    for (const [name, numbers] of state) this.model.d(name).set(numbers);
    for (const [body, pose] of poses) body.pose = pose;
  }
  /** Whether MuJoCo had room for all that it found; where it had not the step is done again with more. */
  hadRoom(run) {
    try {
      run();
    } catch (error) {
      if (/memory|stack|arena/i.test(error.message)) return false;
      throw new Failure(WORLD_LOST, `${error.message.split('\n')[0]}; destroy the world`);
    }
    const told = this.model.data.warning;  // the data's own: to delete it would free what they still use
    return [CONTACT_FULL, CONSTRAINT_FULL].every((which) => {
      const warning = told.get(which), { number } = warning;
      warning.delete();
      return number === 0;
    });
  }

  subStep(h, part) {
    const { M, model: { model: m, data: d } } = this, contacts = this.solve(h);
    this.impulses.gather(this, contacts, h, part);
    if (this.asked && this.joints.size > 0) gatherReactions(this.model, this.joints, 1 / this.settings.substeps);
    if (isEuler(this.settings)) M.mj_Euler(m, d);
    else M.mj_implicit(m, d);
    this.holdLocks(h);
    this.moveKinematics(h);
  }
  /** As mj_forward, whose phases these are. */
  solve(h) {
    const { M, model: { model: m, data: d } } = this;
    M.mj_kinematics(m, d);
    M.mj_comPos(m, d);
    M.mj_tendon(m, d);
    M.mj_makeM(m, d);
    M.mj_factorM(m, d);
    M.mj_collision(m, d);
    const contacts = new Contacts(this.model), seen = judge(this, contacts, h);
    for (let at = 0; at < seen.length; at += 2) this.impulses.touch(seen[at], seen[at + 1]);
    M.mj_makeConstraint(m, d);
    M.mj_island(m, d);
    M.mj_projectConstraint(m, d);
    M.mj_transmission(m, d);
    M.mj_fwdVelocity(m, d);
    this.applyForces(h);
    this.driveMotors();
    if (this.needs.has('surface_velocity')) driveSurfaces(this, contacts);
    M.mj_fwdActuation(m, d);
    M.mj_fwdAcceleration(m, d);
    M.mj_fwdConstraint(m, d);
    return contacts;
  }

  /** The host's forces, gravity that is scaled, and damping, as a force that gives exp(-c h) whatever c is. */
  applyForces(h) {
    const { model, gravity } = this, applied = model.d('xfrc_applied'), pushed = new Map();
    for (const { slot, force, torque } of this.pushes) pushed.set(slot, { force, torque });
    for (const body of model.bodies) {
      if (body === null || body.desc.motion === STATIC) continue;
      const { desc, id } = body, push = pushed.get(body.slot);
      if (desc.motion === KINEMATIC) {
        applied.set(scale(-model.m('body_mass')[id], gravity), 6 * id);
        continue;
      }
      let force = scale((desc.gravityScale - 1) * desc.mass, gravity), torque = [0, 0, 0];
      if (push) [force, torque] = [add(force, push.force), push.torque];
      const damped = desc.linearDamping !== 0 || desc.angularDamping !== 0, fast = this.isFast(body, h);
      if (damped || fast) {
        const axes = multiply(xyzw(model.d('xquat'), 4 * id), desc.inertiaOrientation), rate = (c) => Math.expm1(-c * h) / h;
        const w = unrotate(axes, three(model.d('cvel'), 6 * id)), spin = spread(desc.inertia, w);
        force = add(force, scale(rate(desc.linearDamping) * desc.mass, velocityOfCentre(model, body)));
        torque = add(torque, rotate(axes, scale(rate(desc.angularDamping), spin)));
        if (fast) torque = add(torque, rotate(axes, cross(w, spin)));
      }
      applied.set([...force, ...torque], 6 * id);
    }
  }
  /**
   * With its Euler MuJoCo's gyroscopic torque is that of the sub-step's beginning, and a tumbling body gains by it: at half
   * a radian an eighth in every sub-step, without end. From there on it turns without that torque, and gains nothing.
   */
  isFast(body, h) {
    if (!isEuler(this.settings) || body.link !== null || (body.desc.flags & NO_ROTATION) !== 0) return false;
    return length(three(this.model.d('qvel'), this.model.firstDof(body) + 3)) * h > 0.5;
  }
  /** A motor is dry friction against a speed that is not 0: no more force than it may have. */
  driveMotors() {
    const driven = [...this.joints.values()].filter(({ isLink, desc }) => isLink && desc.axes.some(({ motor }) => motor.enabled));
    if (driven.length === 0) return;
    const { model, model: { data } } = this, speeds = new Map();
    for (const { desc, axisJoint } of driven)
      axisJoint.forEach((joint, axis) => {
        if (joint >= 0 && desc.axes[axis].motor.enabled) speeds.set(model.m('jnt_dofadr')[joint], desc.axes[axis].motor.target);
      });
    const aims = data.efc_aref, rates = data.efc_KBIP, types = data.efc_type, ids = data.efc_id;
    for (let row = data.ne; row < data.ne + data.nf; ++row)
      if (types[row] === FRICTION && speeds.has(ids[row])) aims[row] += rates[4 * row + 1] * speeds.get(ids[row]);
  }
  /** One or two turns about the world's axes that are taken away: MuJoCo turns bodies about their own. */
  holdLocks(h) {
    const { model } = this;
    for (const body of model.bodies) {
      const locks = body === null ? 0 : body.desc.locks & TURNS;
      if (locks === 0 || locks === TURNS || body.desc.motion !== DYNAMIC || (body.desc.flags & NO_ROTATION) !== 0) continue;
      const at = model.m('jnt_qposadr')[body.firstJoint] + 3, dof = model.firstDof(body) + 3, q = model.d('qpos'), v = model.d('qvel');
      const spin = rotate(xyzw(q, at), three(v, dof)).map((x, k) => (locks & (8 << k) ? 0 : x));
      const now = turned(xyzw(model.d('xquat'), 4 * body.id), scale(h, spin));  // from where the sub-step began
      q.set(wxyz(now), at);
      v.set(unrotate(now, spin), dof);
    }
  }
  /** MuJoCo takes them for very heavy bodies; where they are, and how fast, is ours. */
  moveKinematics(h) {
    for (const body of this.bodies.values()) {
      if (body.desc.motion !== KINEMATIC) continue;
      body.pose = { position: add(body.pose.position, scale(h, body.velocity)), orientation: turned(body.pose.orientation, scale(h, body.spin)) };
      writeFree(this.model, body);
    }
  }
  afterStep() { return { contacts: this.impulses.solved, touching: this.tellsTouches ? [...this.impulses.touching.values()].flat() : [] }; }
  contacts() { return this.impulses.rows(); }

  // --- joints --------------------------------------------------------------------------------------------------------

  createJoint(desc) {
    const a = desc.a < 0 ? null : this.bodies.get(desc.a), b = this.bodies.get(desc.b), rod = desc.type === DISTANCE;
    if (rod && desc.axes[0].motor.enabled) refuse("MuJoCo's rods have no motors; leave motors[0] out or take a slider");
    if (!rod && [a, b].some((body) => body !== null && body.desc.locks !== 0))
      refuse("a body with locked axes has joints other than distance, which MuJoCo's trees cannot have; lock the joint's axes instead");
    const joint = { slot: desc.slot, desc, a, b, isLink: false, axisJoint: [-1, -1, -1, -1, -1, -1], equality: -1, tendon: -1, force: [0, 0, 0], torque: [0, 0, 0] };
    this.joints.set(desc.slot, joint);
    this.regrow(() => this.joints.delete(desc.slot));
    this.part(desc, 1);
  }
  /** Throws, with what was done undone, where the joints are no tree that MuJoCo can have. */
  regrow(undo) {
    this.stale = true;
    try {
      growTree(this.bodies, this.joints);
    } catch (error) {
      undo();
      throw error;
    }
  }
  destroyJoint(slot) {
    this.part(this.joints.get(slot).desc, -1);
    this.joints.delete(slot);
    this.stale = true;
  }
  /** A ball that gets its first motor becomes three hinges: the model is made anew. */
  setMotors(slot, motors) {
    const joint = this.joints.get(slot), { desc } = joint, before = desc.axes.map(({ motor }) => motor), ball = isPlainBall(desc), fits = !this.stale && joint.isLink;
    const put = (all) => desc.axes.forEach((axis, i) => { axis.motor = all[i]; });
    if (desc.type === DISTANCE && motors[0].enabled) refuse("MuJoCo's rods have no motors; take a slider");
    put(motors);
    if (fits && isPlainBall(desc) === ball) this.model.applyMotors(joint);
    else this.regrow(() => put(before));
  }
  /** On b at frame b's origin: the mean over the last step, or where nobody asked before it what its end was like. */
  reaction(slot) {
    const joint = this.joints.get(slot);
    if (!this.asked && !this.stale) gatherReactions(this.model, this.joints, 1);
    this.asked = true;
    return [...joint.force, ...joint.torque];
  }

  /** MuJoCo's geoms are where its last sub-step began until they are asked again. */
  castRay(ray) {
    this.prepare();
    this.M.mj_kinematics(this.model.model, this.model.data);
    return castRay(this.model, ray, (slot) => this.sees(ray.filter, slot));
  }
}
