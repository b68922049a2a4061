// The rows of a frame as descriptors, and the numbers of plumb.h that adapters meet.
import { NEEDS } from './words.mjs';

export const SPHERE = 0, BOX = 1, CAPSULE = 2, CYLINDER = 3, HULL = 4, MESH = 5, HEIGHT_FIELD = 6, PLANE = 7, COMPOUND = 8;
export const STATIC = 0, KINEMATIC = 1, DYNAMIC = 2;
export const SENSOR = 1, CCD = 2, NO_ROTATION = 4, ASLEEP = 8, NEVER_SLEEPS = 16;
export const BALL = 0, HINGE = 1, SLIDER = 2, DISTANCE = 3, FIXED = 4, UNIVERSAL = 5, GENERIC = 6;
export const FREE = 0, LOCKED = 1, LIMITED = 2;
export const FIELD = { POSE: 0, VELOCITY: 1, FORCE: 2, TORQUE: 3, IMPULSE: 4, ANGULAR_IMPULSE: 5, FORCE_AT_POINT: 6, IMPULSE_AT_POINT: 7, AWAKE: 8,
  KINEMATIC_TARGET: 9, MATERIAL: 11, GRAVITY_SCALE: 12, DAMPING: 13, SURFACE_VELOCITY: 14, FILTER: 15, ROLLING_FRICTION: 16 };
export const FIELD_COLUMNS = { 0: 7, 1: 6, 2: 3, 3: 3, 4: 3, 5: 3, 6: 6, 7: 6, 8: 1, 9: 7, 11: 2, 12: 1, 13: 2, 14: 3, 15: 3, 16: 2 };

/** The bits of PLUMB_NEED_ as a set of words. */
export function needsOf(bits) {
  return new Set(NEEDS.filter((_, index) => Math.floor(bits / 2 ** index) % 2 === 1));
}

/** Reads numbers one after the other. Vectors and quaternions are arrays. */
export class Row {
  constructor(numbers, at = 0) {
    this.numbers = numbers;
    this.at = at;
  }
  get left() { return this.numbers.length - this.at; }
  number() { return this.numbers[this.at++]; }
  many(count) { return Array.from(this.numbers.subarray(this.at, this.at += count)); }
  doubles(count) { return this.numbers.slice(this.at, this.at += count); }
  pose() { return { position: this.many(3), orientation: this.many(4) }; }
  material() { return { friction: this.number(), restitution: this.number(), surfaceVelocity: this.many(3) }; }
  filter() { return { category: this.number() >>> 0, mask: this.number() >>> 0, group: this.number() }; }
}

export function readShape(row) {
  const shape = { slot: row.number(), type: row.number() };
  switch (shape.type) {
    case SPHERE: shape.radius = row.number(); break;
    case BOX: shape.halfExtents = row.many(3); break;
    case CAPSULE:
    case CYLINDER: shape.radius = row.number(); shape.halfHeight = row.number(); break;
    case HULL: shape.vertices = row.doubles(3 * row.number()); break;
    case MESH: {
      const vertices = row.number(), triangles = row.number();
      shape.vertices = row.doubles(3 * vertices);
      shape.indices = Uint32Array.from(row.many(3 * triangles));
      break;
    }
    case HEIGHT_FIELD:
      shape.rows = row.number();
      shape.columns = row.number();
      shape.dx = row.number();
      shape.dz = row.number();
      shape.heights = row.doubles(shape.rows * shape.columns);
      break;
    case COMPOUND: {
      const count = row.number();
      shape.children = [];
      for (let i = 0; i < count; ++i) {
        const child = { shape: row.number(), pose: row.pose() };
        const own = row.number() !== 0, material = row.material();
        child.material = own ? material : null;
        shape.children.push(child);
      }
    }
  }
  return shape;
}

export function readBody(row) {
  const body = { slot: row.number(), motion: row.number(), flags: row.number(), locks: row.number(), shape: row.number() };
  body.pose = row.pose();
  body.linear = row.many(3);
  body.angular = row.many(3);
  body.mass = row.number();
  body.centre = row.many(3);
  body.inertia = row.many(3);
  body.inertiaOrientation = row.many(4);
  body.material = row.material();
  body.gravityScale = row.number();
  body.linearDamping = row.number();
  body.angularDamping = row.number();
  body.filter = row.filter();
  return body;
}

export function readJoint(row) {
  const joint = { slot: row.number(), type: row.number(), a: row.number(), b: row.number() };
  joint.frameA = row.pose();
  joint.frameB = row.pose();
  joint.collideConnected = row.number() !== 0;
  joint.restLength = row.number();
  joint.axes = [];
  for (let axis = 0; axis < 6; ++axis) {
    const mode = row.number();
    const limit = { enabled: row.number() !== 0, lower: row.number(), upper: row.number() };
    const motor = { enabled: row.number() !== 0, target: row.number(), most: row.number() };
    const how = row.number(), spring = { enabled: how !== 0, byStiffness: how === 2, rest: row.number(), frequency: row.number(), ratio: row.number() };
    joint.axes.push({ mode, limit, motor, spring });
  }
  return joint;
}

/** A height field as triangles, cut along the diagonal from (column, row + 1) to (column + 1, row); seen from above. */
export function meshOfHeightField({ rows, columns, dx, dz, heights }) {
  const vertices = new Float32Array(3 * rows * columns), indices = [];
  for (let r = 0; r < rows; ++r)
    for (let c = 0; c < columns; ++c) {
      const i = r * columns + c;
      vertices.set([(c - (columns - 1) / 2) * dx, heights[i], (r - (rows - 1) / 2) * dz], 3 * i);
      if (r + 1 === rows || c + 1 === columns) continue;
      indices.push(i, i + columns, i + 1, i + 1, i + columns, i + columns + 1);
    }
  return { vertices, indices: Uint32Array.from(indices) };
}
