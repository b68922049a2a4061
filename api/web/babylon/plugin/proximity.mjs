// The nearest body to a shape or a point: distances by the engine's collision without a step, of bodies near enough.
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { along, quatRowOf, rowOf, turned } from './values.mjs';

const kPointRadius = 1e-3, kProbe = 1e-3;
const vector = (row) => new Vector3(...row);

export const proximity = {
  shapeProximity(query, input, hit) {
    input.reset();
    hit.reset();
    const shape = this._convexOf(query.shape), frame = { position: rowOf(query.position),
      orientation: quatRowOf(query.rotation) };
    const found = this._nearest(shape, frame, query, this._queryFilter(query.shape));
    if (!found) return;
    const back = [...frame.orientation.slice(0, 3).map((v) => -v), frame.orientation[3]];
    const onInput = along(found.point, found.distance, found.normal);
    input.setHitData(vector(turned(back, found.normal.map((v) => -v))),
      vector(turned(back, along(onInput, -1, frame.position))));
    input.setHitDistance(found.distance);
    this._fillNearest(hit, found);
  },
  pointProximity(query, result) {
    result.reset();
    this._point ??= this.world.createShape({ type: 'sphere', radius: kPointRadius });
    const { membership = -1, collideWith = -1 } = query.collisionFilter ?? {};
    const found = this._nearest(this._point, { position: rowOf(query.position), orientation: [0, 0, 0, 1] }, query,
      { category: membership >>> 0, mask: collideWith >>> 0 });
    if (found) this._fillNearest(result, { ...found, distance: found.distance + kPointRadius });
  },
  _fillNearest(result, { data, point, normal, distance }) {
    result.setHitData(vector(normal), vector(point));
    result.setHitDistance(distance);
    result.body = data.body;
    result.bodyIndex = data.index;
    result.shape = data.shape.shape;
  },

  _nearest(shape, frame, { maxDistance, ignoreBody, shouldHitTriggers = false }, filter) {
    let nearest = null;
    for (const data of this._owners.values()) {
      if (!data.shape || data.body === ignoreBody || !this._sees(data, filter, shouldHitTriggers)) continue;
      const { distance } = this._apart(shape, frame, data);
      if (!(distance > maxDistance) && !(distance >= nearest?.distance)) nearest = { data, distance };
    }
    return nearest && { ...nearest, ...this._pointBetween(shape, frame, nearest) };
  },
  _sees(data, { category, mask }, triggers) {
    const { membership, collide } = this._masksOf(data.shape);
    return (membership & mask) !== 0 && (collide & category) !== 0 && (triggers || !this._isTrigger(data.shape));
  },
  _apart(shapeA, frameA, data) {
    const [x, y, z, ...orientation] = this._poseOf(data);
    return this.world.collide({ shapeA, frameA, shapeB: this._handleOf(data.shape),
      frameB: { position: [x, y, z], orientation } });
  },
  /** The gradient of the distance is the normal; where the shape arrives along it is the point. */
  _pointBetween(shape, frame, { data, distance }) {
    const { points } = this._apart(shape, frame, data);
    if (distance <= 0 && points.length > 0) {
      const deepest = points.reduce((a, b) => (b.depth > a.depth ? b : a));
      return { point: deepest.position, normal: deepest.normal.map((v) => -v) };
    }
    const normal = [0, 1, 2].map((axis) => {
      const to = (sign) => this._apart(shape,
        { ...frame, position: frame.position.map((v, i) => v + (i === axis ? sign * kProbe : 0)) }, data).distance;
      return (to(1) - to(-1)) / (2 * kProbe);
    });
    const length = Math.hypot(...normal) || 1, out = normal.map((v) => v / length);
    const hit = this.world.castShapes([{ shape, ...frame, translation: out.map((v) => -v * (distance + 2 * kProbe)) }],
      { all: true })[0].find((one) => this._owners.get(one.body) === data);
    return { point: hit?.position ?? along(frame.position, -distance, out), normal: out };
  },
};
