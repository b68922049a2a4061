// MuJoCo's model and data of a world as it is now, and which of ours each of its things is.
import { DISTANCE, DYNAMIC, HEIGHT_FIELD, KINEMATIC, NO_ROTATION } from '../../rows.mjs';
import { add, conjugate, multiply, rotate, sub } from '../../algebra.mjs';
import { Failure } from '../../failure.mjs';
import { refuse } from '../../base.mjs';
import { applyToModel } from './settings.mjs';
import { HEAVY, axesInOrder, equalitiesOf, heightsOf, modelText, needsEquality } from './text.mjs';
import { ABOUT_X, isPlainBall, openAxes } from './tree.mjs';

const EQUALITY_DATA = 11;  // numbers that MuJoCo has of each
const ALL_TURNS = 0b111000;
const MOST_ROOM = 1 << 30;  // bytes
const WORLD_LOST = -13, OUT_OF_MEMORY = -5;

/** w first, as MuJoCo has it. */
export const wxyz = ([x, y, z, w]) => [w, x, y, z];
export const xyzw = (q, at = 0) => [q[at + 1], q[at + 2], q[at + 3], q[at]];
export const three = (numbers, at) => [numbers[at], numbers[at + 1], numbers[at + 2]];

/** The arrays of a model or of data by name. They stay where they are until the memory grows; then they are empty. */
function arraysOf(owner) {
  const kept = new Map();
  return (name) => {
    let array = kept.get(name);
    if (!array?.length) kept.set(name, (array = owner[name]));
    return array;
  };
}

export class Model {
  /** world: { bodies, joints, settings } with partsOf(body), collides, rolls; tree: of growTree. */
  constructor(M, tree, world) {
    const { joints, settings } = world, all = [...joints.values()];
    this.M = M;
    this.model = compile(M, modelText(tree, all, (body) => world.partsOf(body), world.collides));
    this.m = arraysOf(this.model);
    this.nameBodies(tree, world);
    this.fillHeights();
    for (const body of this.bodies) if (body?.desc.motion === DYNAMIC) this.fillMass(body);
    for (const joint of all) if (joint.isLink) this.applyMotors(joint);
    this.traits = { rolls: world.rolls, heavy: this.bodies.some((body) => body !== null && isHeavy(body)) };
    applyToModel(settings, this.traits, this.model);
    this.makeData();
    M.mj_setConst(this.model, this.data);
    this.fillEqualities(all);  // after it, which would take the anchors from how the tree is drawn
    this.model.stat.meaninertia = meanMass(this.bodies);
    M.mj_resetData(this.model, this.data);
  }
  delete() {
    this.data.delete();
    this.model.delete();
  }

  makeData() {
    this.data?.delete();
    this.data = new this.M.MjData(this.model);
    this.d = arraysOf(this.data);
  }
  /** New data with twice the room for contacts and constraints. What moves must be written anew. */
  grow() {
    const room = 2 * this.model.narena;
    if (room > MOST_ROOM) throw new Failure(WORLD_LOST, `MuJoCo's contacts and constraints would take more than ${MOST_ROOM >> 20} MB; make the world smaller`);
    this.model.narena = room;
    try {
      this.makeData();
    } catch (error) {
      throw new Failure(OUT_OF_MEMORY, `MuJoCo has no memory for its data of ${room >> 20} MB: ${error.message}`);
    }
  }

  // MuJoCo numbers bodies, their joints and their geoms in the order of the text.
  nameBodies({ order }, world) {
    const roots = this.m('body_rootid'), first = this.m('body_jntadr'), count = this.m('body_jntnum');
    this.bodies = [null];
    this.geoms = [];
    for (const body of order) {
      const id = this.bodies.push(body) - 1;
      Object.assign(body, { id, root: roots[id], firstJoint: first[id], jointCount: count[id], written: true });
      world.partsOf(body).forEach(({ slot, desc, pose, material }, child) => this.geoms.push({ body, slot, shape: desc, child, pose, own: material }));
      if (body.link !== null) this.nameAxes(body);
    }
    if (this.model.nbody !== this.bodies.length || this.model.ngeom !== this.geoms.length)
      throw new Error(`MuJoCo's model has ${this.model.nbody} bodies and ${this.model.ngeom} geoms, its text ${this.bodies.length} and ${this.geoms.length}`);
  }
  nameAxes(body) {
    const { link } = body;
    link.axisJoint = [-1, -1, -1, -1, -1, -1];
    let next = body.firstJoint;
    for (const axis of axesInOrder(body)) {
      const ball = axis >= 3 && isPlainBall(link.desc);
      if (ball && axis !== 3) continue;  // one joint for all three
      if (!ball) link.axisJoint[axis] = next;
      ++next;
    }
  }

  fillHeights() {
    const data = this.m('geom_dataid'), start = this.m('hfield_adr');
    this.geoms.forEach(({ shape }, geom) => {
      if (shape.type === HEIGHT_FIELD) this.m('hfield_data').set(heightsOf(shape), start[data[geom]]);
    });
  }
  /**
   * Locked axes of free bodies weigh as much as what nothing moves. The turns are about the body's own axes, and only as
   * many as are locked all three are locked so.
   */
  fillMass(body) {
    const still = (body.desc.flags & NO_ROTATION) !== 0;
    if (!still) this.m('body_inertia').set(body.desc.inertia, 3 * body.id);
    if (body.link !== null) return;
    let { locks } = body.desc;
    if (still) locks |= ALL_TURNS;
    if ((locks & ALL_TURNS) !== ALL_TURNS) locks &= ~ALL_TURNS;
    for (let axis = 0; axis < 6; ++axis) if (locks & (1 << axis)) this.m('dof_armature')[this.firstDof(body) + axis] = HEAVY;
  }
  firstDof(body) { return this.m('body_dofadr')[body.id]; }

  fillEqualities(joints) {
    let next = 0, rods = 0;
    for (const joint of joints) {
      const { desc } = joint, rod = desc.type === DISTANCE;
      joint.tendon = rod ? rods++ : -1;
      joint.equality = needsEquality(joint) ? next : -1;
      if (joint.equality < 0) continue;
      if (rod) this.m('eq_data')[EQUALITY_DATA * next] = desc.restLength - this.m('tendon_length0')[joint.tendon];
      else this.putAnchors(joint);
      next += rod ? 1 : equalitiesOf(desc);
    }
  }
  /** Where two bodies are held together, in the frame of each; a weld has them the other way round. */
  putAnchors({ desc, a, b, equality }) {
    const eq = this.m('eq_data'), weld = openAxes(desc) === 0;
    const put = (place, at) => {
      const inA = sub(add(desc.frameA.position, rotate(desc.frameA.orientation, at)), a?.shift ?? [0, 0, 0]);
      const inB = sub(add(desc.frameB.position, rotate(desc.frameB.orientation, at)), b.shift);
      eq.set(weld ? [...inB, ...inA] : [...inA, ...inB], EQUALITY_DATA * place);
    };
    put(equality, [0, 0, 0]);
    if (weld) eq.set(wxyz(multiply(desc.frameA.orientation, conjugate(desc.frameB.orientation))), EQUALITY_DATA * equality + 6);
    if (openAxes(desc) === ABOUT_X) put(equality + 1, [1, 0, 0]);
  }

  /** A motor is dry friction; of its speed the step knows. At any time. */
  applyMotors({ desc, axisJoint }) {
    axisJoint.forEach((joint, axis) => {
      const { motor } = desc.axes[axis];
      if (joint >= 0) this.m('dof_frictionloss')[this.m('jnt_dofadr')[joint]] = motor.enabled ? motor.most : 0;
    });
  }

  /** Of a body's frame, as MuJoCo's kinematics were last worked out. */
  poseOf(body) {
    const orientation = xyzw(this.d('xquat'), 4 * body.id);
    return { position: sub(three(this.d('xpos'), 3 * body.id), rotate(orientation, body.shift)), orientation };
  }
}

/** Whether forces must not move it, along some axis at least. */
const isHeavy = ({ desc }) => desc.motion === KINEMATIC || (desc.motion === DYNAMIC && (desc.locks !== 0 || (desc.flags & NO_ROTATION) !== 0));

function compile(M, text) {
  try {
    return M.MjModel.from_xml_string(text);
  } catch (error) {
    return refuse(`MuJoCo makes no model of this world: ${error.message.split('\n')[0]}`);
  }
}

/** By it MuJoCo scales the tolerance of its solvers: what must not move would make them stop at once. */
function meanMass(bodies) {
  const masses = bodies.filter((body) => body?.desc.motion === DYNAMIC).map(({ desc }) => desc.mass);
  return masses.length === 0 ? 1 : masses.reduce((sum, mass) => sum + mass, 0) / masses.length;
}
