// Rays and shape casts.
import { along, quatRowOf, rowOf, turned } from './values.mjs';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { PhysicsRaycastResult } from '@babylonjs/core/Physics/physicsRaycastResult.js';

const kAll = 0xffffffff;
const vector = (row) => new Vector3(...row);

export const queries = {
  raycast(from, to, result, query = {}) {
    const many = Array.isArray(result), ray = { origin: rowOf(from), translation: along(rowOf(to), -1, rowOf(from)),
      filter: { category: (query.membership ?? kAll) >>> 0, mask: (query.collideWith ?? kAll) >>> 0 } };
    if (query.shouldHitTriggers) this._warn('queries do not see triggers, whatever shouldHitTriggers says');
    if (many) result.length = 0;
    else result.reset(from, to);
    if (ray.translation.every((v) => v === 0)) return;
    const hits = this._hits(this.world.castRays([ray], { all: true })[0], query.ignoreBody);
    for (const hit of many ? hits : hits.slice(0, 1)) {
      const told = many ? new PhysicsRaycastResult() : result;
      if (many) {
        told.reset(from, to);
        result.push(told);
      }
      this._fill(told, hit);
      told.calculateHitDistance();
    }
  },
  /** The input's point and normal are in its own frame, as in Babylon.js's other plugins; the hit's in the world. */
  shapeCast(query, input, hit) {
    input.reset();
    hit.reset();
    const shape = this._convexOf(query.shape), orientation = quatRowOf(query.rotation);
    if (query.shouldHitTriggers) this._warn('queries do not see triggers, whatever shouldHitTriggers says');
    const position = rowOf(query.startPosition), translation = along(rowOf(query.endPosition), -1, position);
    const cast = { shape, position, orientation, translation, filter: this._queryFilter(query.shape) };
    const [found] = this._hits(this.world.castShapes([cast], { all: true })[0], query.ignoreBody);
    if (!found) return;
    const back = [...orientation.slice(0, 3).map((v) => -v), orientation[3]];
    const local = turned(back, along(along(found.position, -1, position), -found.fraction, translation));
    input.setHitData(vector(turned(back, found.normal.map((v) => -v))), vector(local));
    input.setHitFraction(found.fraction);
    this._fill(hit, found);
    hit.setHitFraction(found.fraction);
  },

  _hits(hits, ignored) {
    return hits.filter(({ body }) => this._owners.get(body)?.body !== ignored || ignored === undefined);
  },
  _fill(result, { body, position, normal, child }) {
    const data = this._owners.get(body), mesh = data.shape?.leaf?.desc.type === 'mesh';
    result.setHitData(vector(normal), vector(position), mesh ? child : -1);
    result.body = data.body;
    result.bodyIndex = data.index;
    result.shape = data.shape?.shape;
  },
  _queryFilter(shape) {
    const { membership, collide } = this._masksOf(shape._pluginData);
    return { category: membership >>> 0, mask: collide >>> 0 };
  },
  /** Casts and proximity take one sphere, box, capsule, cylinder or hull whose frame is its body's. */
  _convexOf(shape) {
    const data = shape._pluginData, leaves = this._leavesOf(data);
    const handle = this._handleOf(data);
    if (leaves.length !== 1 || data.parts.length > 0 || !this._solid(data))
      throw new Error('PlumbPlugin: only a sphere, box, capsule, cylinder or convex hull whose centre is the origin ' +
        'can be cast; move the query instead of the shape');
    return handle;
  },
};
