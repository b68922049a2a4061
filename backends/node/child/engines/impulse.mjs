// Our own engine, compiled to WebAssembly: package @plumb/engine (api/web), single precision, one thread. The module has
// the same interface as the wire, so that calls go straight on, and results have the bits of the backend impulse.
import { pairKey } from '../algebra.mjs';
import { load, missing } from '../packages.mjs';
import { BODY_FIELDS, EVENTS, FEATURES, JOINTS, MOTIONS, NEEDS, QUERIES, SHAPES } from '../words.mjs';
import { bodyOptions, jointOptions, shapeOptions } from './impulse/options.mjs';

const PACKAGE = '@plumb/engine';
const REMEDY = 'the engine is not compiled to WebAssembly: ./dev platforms wasm does it in a checkout; or set PLUMB_NODE_MODULES to the node_modules that has the package @plumb/engine';
const OFF_THE_WIRE = 'plumb.wire/1 does not carry it';
const TAKES = ['force', 'torque', 'impulse', 'angular_impulse', 'force_at_point', 'impulse_at_point', 'kinematic_target'];

/** surface_velocity as the module has it: surfaceVelocity. */
const camel = (word) => word.replace(/_(.)/g, (_, letter) => letter.toUpperCase());

export async function manifest() {
  const unmet = missing(PACKAGE, REMEDY), common = { description: 'the engine impulse, WebAssembly', precision: 'f32', deterministic: true };
  if (unmet !== '') return { ...common, version: '', unmet, settings: [], capabilities: [] };
  const engine = await loadEngine(), { version, build } = engine.info;
  return { ...common, version, build: `${build}, node ${process.version}`, takes: TAKES, settings: engine.settings.map(settingOf), capabilities: capabilitiesOf(engine) };
}
async function loadEngine() {
  const { load: loadModule } = await load(PACKAGE, 'plumb.mjs', REMEDY);
  return loadModule();
}
const settingOf = ({ creationOnly, ...setting }) => ({ ...setting, creation_only: creationOnly });

/** As the module answers for itself, but for what the wire does not carry. */
function capabilitiesOf(engine) {
  const rules = [];
  const ask = (kind, first, second) => first.forEach((a, i) => second.forEach((b, k) => rules.push([kind, a, b, engine.capability(camel(OWN_NAMES[kind] ?? kind), i, k)])));
  ask('shape', SHAPES, MOTIONS);
  ask('pair', SHAPES, SHAPES);
  ask('joint', JOINTS, ['*']);
  ask('joint_feature', JOINTS, FEATURES);
  ask('query', QUERIES, SHAPES);
  ask('read', BODY_FIELDS, ['*']);
  ask('write', BODY_FIELDS, ['*']);
  ask('need', NEEDS, ['*']);
  ask('event', EVENTS, ['*']);
  ask('child_material', ['*'], ['*']);
  return [...rules,
    ['joint', 'swing_twist|gear|rack_and_pinion', '*', 'none', OFF_THE_WIRE],
    ['joint_feature', 'swing_twist|gear|rack_and_pinion', '*', 'none', OFF_THE_WIRE],
    ['joint_feature', '*', 'targets', 'none', OFF_THE_WIRE],
    ['joint_feature', 'ball|hinge|slider|distance|fixed|universal|generic', 'breaks', 'emulated', 'the reaction is compared after each step'],
    ['query', 'penetration|turning_cast', '*', 'none', OFF_THE_WIRE],
    ['triangle_material', '*', '*', 'none', OFF_THE_WIRE],
    ['need', 'snapshot|contact_modification', '*', 'none', OFF_THE_WIRE],
    ['event', '*', '*', 'emulated', 'by comparing one step with the next'],
  ];
}
const OWN_NAMES = { read: 'field_read', write: 'field_write' };

export async function createWorld(init) {
  return new ImpulseWorld(await loadEngine(), init);
}

class ImpulseWorld {
  constructor(engine, { needs, gravity, settings }) {
    this.tellsEvents = needs.has('events') || needs.has('sensors');
    const breaks = needs.has('events') && needs.has('joints');  // which the host judges by their reactions
    this.world = engine.createWorld({ needs: [...needs, ...(breaks && !needs.has('joint_reactions') ? ['joint_reactions'] : [])].map(camel), gravity, settings });
    this.shapes = new Map();  // slot to the module's handle
    this.bodies = new Map();
    this.joints = new Map();
    this.slots = new Map();  // back, of bodies
    this.touching = new Map();
  }

  createShape(desc) { this.shapes.set(desc.slot, this.world.createShape(shapeOptions(desc, this.shapes))); }
  destroyShape(slot) { this.forget(this.shapes, slot, 'destroyShape'); }
  createBodies(descs) {
    this.world.createBodies(descs.map((desc) => bodyOptions(desc, this.shapes))).forEach((body, i) => {
      this.bodies.set(descs[i].slot, body);
      this.slots.set(body, descs[i].slot);
    });
  }
  destroyBody(slot) {
    const body = this.bodies.get(slot);
    this.forget(this.bodies, slot, 'destroyBody');
    this.slots.delete(body);
    for (const [key, pair] of this.touching) if (pair.includes(slot)) this.touching.delete(key);
  }
  createJoints(descs) {
    this.world.createJoints(descs.map((desc) => jointOptions(desc, this.bodies))).forEach((joint, i) => this.joints.set(descs[i].slot, joint));
  }
  destroyJoint(slot) { this.forget(this.joints, slot, 'destroyJoint'); }
  forget(handles, slot, how) {
    this.world[how](handles.get(slot));
    handles.delete(slot);
  }

  readField(field, slots) { return this.world.read(camel(BODY_FIELDS[field]), slots.map((slot) => this.bodies.get(slot))); }
  writeField(field, slots, rows) { this.world.write(camel(BODY_FIELDS[field]), slots.map((slot) => this.bodies.get(slot)), rows); }
  setGravity(gravity) { this.world.setGravity(gravity); }
  applySettings(changed) { for (const [name, value] of Object.entries(changed)) this.world.setSetting(name, value); }
  setException(a, b, touch) { this.world.setPairTouches(this.bodies.get(a), this.bodies.get(b), touch); }
  setMotors(slot, motors) { this.world.writeJoints('motor', this.joints.get(slot), motors.flatMap(({ target, most }) => [target, most])); }
  reaction(slot) { return [...this.world.readJoints('reaction', [this.joints.get(slot)])]; }

  step(dt) { this.report = this.world.step(dt); }
  afterStep() {
    for (const { type, a, b } of this.tellsEvents ? this.world.events() : []) {
      if (!PAIRS.has(type)) continue;
      const pair = [this.slots.get(a), this.slots.get(b)];
      if (type === 'contactBegin' || type === 'sensorEnter') this.touching.set(pairKey(...pair), pair);
      else this.touching.delete(pairKey(...pair));
    }
    return { contacts: this.report.contacts, pairs: this.report.pairs, touching: [...this.touching.values()].flat() };
  }
  contacts() {
    return this.world.contacts().flatMap(({ a, b, childA, childB, position, normal, depth, normalImpulse, tangentImpulse, feature }) =>
      [this.slots.get(a), this.slots.get(b), childA, childB, ...position, ...normal, depth, normalImpulse, ...tangentImpulse, Number(feature)]);
  }

  hits(found) { return found.map(({ body, ...hit }) => ({ ...hit, body: this.slots.get(body) })); }
  castRay(ray) { return this.hits(this.world.castRays([ray], { all: true })[0]); }
  castShape({ shape, pose, translation, filter }) {
    return this.hits(this.world.castShapes([{ shape: this.shapes.get(shape), ...pose, translation, filter }], { all: true })[0]);
  }
  overlapShape({ shape, pose, filter }) { return this.hits(this.world.overlap(this.shapes.get(shape), pose, filter)); }
  triangleAt() { return 0; }  // the module has told it as the hit's child
}
const PAIRS = new Set(['contactBegin', 'contactEnd', 'sensorEnter', 'sensorLeave']);
