// Mass properties: the engine's own, worked out from the shape, but for what a page sets. Babylon.js has moments of
// inertia for a unit mass, the engine has them in kg m2.
import { Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { quatRowOf, rowOf } from './values.mjs';

/** Moments that are to be infinite among others, beside the largest of these. */
const kVeryLarge = 1e4;
const kDynamic = 2;

export const mass = {
  setMassProperties(body, given, instanceIndex) {
    this._each(body, instanceIndex, (data) => {
      data.mass = { ...data.mass, ...given };
      this._applyShape(data);
    });
  },
  getMassProperties(body, instanceIndex) {
    const data = this._one(body, instanceIndex);
    return { ...this._computed(data), ...defined(data.mass ?? {}) };
  },
  computeMassProperties(body, instanceIndex) {
    return this._computed(this._one(body, instanceIndex));
  },
  /** Of the shape filled with its density; a mesh, field or nothing: one kilogram with moments 1. */
  _computed({ shape }) {
    const row = shape ? this._massRowOf(shape) : [1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1];
    return { centerOfMass: new Vector3(row[1], row[2], row[3]), mass: row[0],
      inertia: new Vector3(row[4], row[5], row[6]).scaleInPlace(1 / row[0]),
      inertiaOrientation: new Quaternion(row[7], row[8], row[9], row[10]) };
  },
  /** The engine is asked by a body that is gone again. */
  _massRowOf(shape) {
    if (shape.massRow !== undefined) return shape.massRow;
    const probe = { shape: this._handleOf(shape), density: shape.density, filter: { category: 0, mask: 0 } };
    if (this._solid(shape)) {
      const body = this.world.createBody(probe);
      shape.massRow = [...this.world.read('mass', [body])];
      this.world.destroyBody(body);
    } else shape.massRow = [1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1];
    return shape.massRow;
  },
  /** For World.modifyBody; nothing for what is not moved by forces. */
  _massOf(data) {
    if (this._motionOf(data) !== 'dynamic') return {};
    const { mass: total, centerOfMass, inertia, inertiaOrientation } =
      { ...this._computed(data), ...defined(data.mass ?? {}) };
    const moments = rowOf(inertia).map((moment) => moment * total), largest = Math.max(...moments);
    return { mass: total, centreOfMass: rowOf(centerOfMass), inertiaOrientation: quatRowOf(inertiaOrientation),
      inertia: moments.map((moment) => moment === 0 ? largest * kVeryLarge : moment) };
  },
  /** All moments 0: it does not turn. */
  _turns(data) {
    const inertia = data.mass?.inertia;
    return data.motion !== kDynamic || !inertia || rowOf(inertia).some((moment) => moment !== 0);
  },
};

const defined = (given) => Object.fromEntries(Object.entries(given).filter(([, value]) => value !== undefined));
