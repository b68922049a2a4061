// What adapters share: descriptors by slot, who may touch whom, and helpers for manifests.
import { compose, cross, dot, inverse, length, mayTouch, pairKey, sub, unrotate } from './algebra.mjs';
import { Failure } from './failure.mjs';
import { COMPOUND, DYNAMIC, MESH, SENSOR, STATIC } from './rows.mjs';

const ROW = 16;
const rowsWhere = (rows, fits) => {
  const some = [];
  for (let at = 0; at < rows.length; at += ROW) if (fits(rows[at], rows[at + 1])) some.push(...rows.slice(at, at + ROW));
  return some;
};

export class WorldBase {
  constructor({ needs, settings }) {
    this.needs = needs;
    this.settings = settings;
    this.shapes = new Map();  // slot to { desc, ... }
    this.bodies = new Map();
    this.joints = new Map();
    this.exceptions = new Set();
    this.jointed = new Map();  // pairs that joints keep apart, and how many do
  }

  /** Convex parts of a shape, each { desc, pose, material }; material null where it is the body's. */
  parts(slot) {
    const whole = { position: [0, 0, 0], orientation: [0, 0, 0, 1] };
    const { desc } = this.shapes.get(slot);
    if (desc.type !== COMPOUND) return [{ slot, desc, pose: whole, material: null }];
    return desc.children.map((child) => ({
      slot: child.shape, desc: this.shapes.get(child.shape).desc, pose: child.pose, material: child.material }));
  }

  createShape(desc) { this.shapes.set(desc.slot, { desc }); }
  destroyShape(slot) { this.shapes.delete(slot); }

  /** Whether two bodies are to be looked at at all. */
  collides(a, b) {
    const one = this.bodies.get(a).desc, two = this.bodies.get(b).desc;
    if (one.motion === STATIC && two.motion === STATIC) return false;
    const key = pairKey(a, b);
    return !this.exceptions.has(key) && !this.jointed.has(key) && mayTouch(one.filter, two.filter);
  }

  setException(a, b, touch) {
    if (touch) this.exceptions.delete(pairKey(a, b));
    else this.exceptions.add(pairKey(a, b));
  }

  /** Of a joint that keeps its bodies apart: by +1 when it comes, by -1 when it goes. */
  part(joint, by) {
    if (joint.collideConnected || joint.a < 0) return;
    const key = pairKey(joint.a, joint.b), count = (this.jointed.get(key) ?? 0) + by;
    if (count === 0) this.jointed.delete(key);
    else this.jointed.set(key, count);
  }

  /** Queries see no sensors, and who passes their filter. */
  sees(filter, slot) {
    return !this.isSensor(slot) && mayTouch(filter, this.bodies.get(slot).desc.filter);
  }

  /** The triangle of a mesh that is nearest to a point of its surface; 0 for other shapes. Engines number their own. */
  triangleAt(slot, position) {
    const { desc } = this.bodies.get(slot), shape = this.shapes.get(desc.shape)?.desc;
    if (shape?.type !== MESH) return 0;
    const pose = this.pose(slot), point = unrotate(pose.slice(3), sub(position, pose.slice(0, 3)));
    let best = 0, least = Infinity;
    for (let i = 0; i < shape.indices.length; i += 3) {
      const away = distanceToTriangle(point, [0, 1, 2].map((k) => Array.from(shape.vertices.subarray(3 * shape.indices[i + k], 3 * shape.indices[i + k] + 3))));
      if (away < least) [best, least] = [i / 3, away];
    }
    return best;
  }

  isSensor(slot) { return (this.bodies.get(slot).desc.flags & SENSOR) !== 0; }

  // Rows of contacts, 16 numbers each as WIRE.md has them; of sensors too.

  /** Those of bodies that sleep: an engine does not tell them again, and they touch on. */
  sleepingRows(rows) {
    if (!this.needs.has('sleeping')) return [];
    const rests = (slot) => this.bodies.has(slot) && (this.bodies.get(slot).desc.motion !== DYNAMIC || this.awake(slot)[0] === 0);
    return rowsWhere(rows, (a, b) => rests(a) && rests(b));
  }
  /** Those of a step, and of those before it the ones that it did not tell again and that still sleep. */
  withSleepers(before, rows) {
    const kept = this.sleepingRows(before), told = new Set();
    if (kept.length === 0) return rows;
    for (let at = 0; at < rows.length; at += ROW) told.add(pairKey(rows[at], rows[at + 1]));
    return rows.concat(rowsWhere(kept, (a, b) => !told.has(pairKey(a, b)) && this.collides(a, b)));
  }
  /** What afterStep answers of them. touch: m that two bodies may be apart and touch. */
  told(rows, touch) {
    const touching = [];
    if (this.tellsTouches)
      for (let at = 0; at < rows.length; at += ROW) if (rows[at + 10] > -touch) touching.push(rows[at], rows[at + 1]);
    return { touching, contacts: this.needs.has('contacts') ? this.solidRows(rows).length / ROW : NaN };
  }
  solidRows(rows) { return rowsWhere(rows, (a, b) => !this.isSensor(a) && !this.isSensor(b)); }

  get tellsTouches() { return this.needs.has('events') || this.needs.has('sensors'); }
  applySettings(changed) { Object.assign(this.settings, changed); }
}

/** From the plane of the triangle, and from its edges where the point lies beyond them. */
function distanceToTriangle(point, corners) {
  const n = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])), area = length(n);
  let beyond = Math.abs(dot(n, sub(point, corners[0]))) / area;
  for (let k = 0; k < 3; ++k) {
    const edge = sub(corners[(k + 1) % 3], corners[k]), inward = cross(n, edge);
    beyond = Math.max(beyond, -dot(inward, sub(point, corners[k])) / length(inward));
  }
  return beyond;
}

/** For engines whose bodies' frame is that of the principal axes at the centre of mass: that frame in the body's. */
export function principalFrame(desc) {
  if (desc.motion !== DYNAMIC) return { position: [0, 0, 0], orientation: [0, 0, 0, 1] };
  return { position: desc.centre, orientation: desc.inertiaOrientation };
}
/** What is placed in the body's frame, placed in that one. */
export const inFrame = (frame, pose) => compose(inverse(frame), pose);

export function refuse(text) { throw new Failure(-3, text); }

// --- manifests -------------------------------------------------------------------------------------------------------

const setting = (type) => (name, role, [minimum, maximum], standard, doc, more = {}) =>
  ({ name, type, role, minimum, maximum, default: standard, doc, ...more });
/** (name, role, [least, most], standard, doc, { unit, creation_only }?) */
export const intSetting = setting('int');
export const floatSetting = setting('float');
export const boolSetting = (name, role, standard, doc, more = {}) => ({ name, type: 'bool', role, default: standard, doc, ...more });
export const choiceSetting = (name, role, choices, doc, more = {}) => ({ name, type: 'choice', role, choices, default: choices[0], doc, ...more });

export const SUBSTEPS = intSetting('substeps', 'quality', [1, 1000], 1, 'parts in which a step is done, each with collision detection', { unit: '1' });

/** What every adapter here has: three motions of the usual shapes, poses and velocities, forces. */
export const USUAL = [
  ['shape', 'sphere|box|capsule|cylinder|hull|compound', '*', 'native'],
  ['shape', 'mesh', 'static', 'native'],
  ['shape', 'height_field', 'static', 'emulated', 'as a mesh of triangles'],
  ['pair', '*', '*', 'native'],
  ['read', '*', '*', 'native'],
  ['write', 'pose|velocity|material|gravity_scale', '*', 'native'],
  ['need', 'rotation|collision|friction|restitution|kinematic|forces', '*', 'native'],
];
