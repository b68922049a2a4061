// Rays, by MuJoCo's functions of single geoms, which tell the normal too.
import { HEIGHT_FIELD, HULL } from '../../rows.mjs';
import { add, compose, dot, length, scale, sub, unrotate } from '../../algebra.mjs';
import { rangeOf } from './text.mjs';

const BEHIND = 1e-6, ON_SURFACE = 1e-4;  // m

/** { way, normal } along a unit direction; way below 0: none. */
function meet({ M, model, data, m, d, geoms }, geom, from, along, normal) {
  const { type } = geoms[geom].shape;
  if (type === HULL) return M.mj_rayMesh(model, data, geom, from, along, normal);
  if (type === HEIGHT_FIELD) return M.mj_rayHfield(model, data, geom, from, along, normal);
  const of = (array, count) => Array.from(array.subarray(count * geom, count * (geom + 1)));
  return M.mju_rayGeom(of(d('geom_xpos'), 3), of(d('geom_xmat'), 9), of(m('geom_size'), 3), from, along, m('geom_type')[geom], normal);
}

/** Of a height field: how high it is above a point, by the triangle there. */
function heightAt(field, [px, , pz]) {
  const { rows, columns, dx, dz, heights } = field, cell = (at, count) => Math.min(Math.max(Math.floor(at), 0), count - 2);
  const x = px / dx + (columns - 1) / 2, z = pz / dz + (rows - 1) / 2, c = cell(x, columns), r = cell(z, rows), u = x - c, v = z - r;
  const h = (row, column) => heights[row * columns + column], h01 = h(r, c + 1), h10 = h(r + 1, c);
  if (u + v <= 1) return h(r, c) + u * (h01 - h(r, c)) + v * (h10 - h(r, c));
  return h(r + 1, c + 1) + (1 - u) * (h10 - h(r + 1, c + 1)) + (1 - v) * (h01 - h(r + 1, c + 1));
}
/** MuJoCo's height fields are solid, with walls and a floor, which ours have not. */
const isOnSurface = (shape, point) => shape.type !== HEIGHT_FIELD || Math.abs(heightAt(shape, point) - point[1]) < ON_SURFACE * Math.max(1, rangeOf(shape).span);

/** All that a ray meets of one geom's surface, or null. */
function hitOf(model, geom, { origin, translation }, normal) {
  const { body, pose, shape, child } = model.geoms[geom], far = length(translation), along = scale(1 / far, translation), frame = compose(body.pose, pose);
  let gone = 0;
  for (let i = 0; i < 3; ++i) {  // behind a wall and the floor of a height field, at most
    const way = meet(model, geom, add(origin, scale(gone, along)), along, normal);
    if (way < 0 || gone + way > far) return null;
    const position = add(origin, scale(gone + way, along));
    if (isOnSurface(shape, unrotate(frame.orientation, sub(position, frame.position)))) {
      const told = Array.from(normal.GetView()), out = shape.type === HEIGHT_FIELD && dot(told, along) > 0 ? scale(-1, told) : told;
      return { body: body.slot, child, fraction: (gone + way) / far, position, normal: out };
    }
    gone += way + BEHIND;
  }
  return null;
}

/** sees: whether a body is one that the ray may meet. */
export function castRay(model, ray, sees) {
  const normal = new model.M.DoubleBuffer(3), hits = [];
  for (let geom = 0; geom < model.geoms.length; ++geom) {
    const hit = sees(model.geoms[geom].body.slot) ? hitOf(model, geom, ray, normal) : null;
    if (hit !== null) hits.push(hit);
  }
  normal.delete();
  return hits;
}
