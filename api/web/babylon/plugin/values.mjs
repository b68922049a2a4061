// Vectors and quaternions of Babylon.js, as rows of numbers, and back.
export const rowOf = ({ x, y, z }) => [x, y, z];
export const quatRowOf = ({ x, y, z, w }) => {
  const length = Math.hypot(x, y, z, w) || 1;
  return [x / length, y / length, z / length, w / length];
};
export const toVector = ([x, y, z], vector) => vector.set(x, y, z);
export const frameOf = (position, rotation) => ({ position: rowOf(position), orientation: quatRowOf(rotation) });

export const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const along = (a, scale, b) => a.map((x, i) => x + scale * b[i]);
export const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** v turned by q. */
export function turned(q, v) {
  const t = cross(q, v).map((x) => 2 * x);
  const u = cross(q, t);
  return v.map((x, i) => x + q[3] * t[i] + u[i]);
}
/** First b, then a. */
export function product(a, b) {
  const [x, y, z] = cross(a, b).map((v, i) => v + a[3] * b[i] + b[3] * a[i]);
  return [x, y, z, a[3] * b[3] - dot(a, b)];
}
/** From y to a direction. */
export function fromUpTo(direction) {
  const to = unit(direction);
  if (to[1] < -0.999999) return [1, 0, 0, 0];
  const [x, y, z] = cross([0, 1, 0], to), w = 1 + to[1], length = Math.hypot(x, y, z, w);
  return [x / length, y / length, z / length, w / length];
}
/** Whose x and y axes are these: y is made square to x. */
export function quatOfAxes(axis, perpendicular) {
  const x = unit(axis);
  let y = along(perpendicular, -dot(perpendicular, x), x);
  if (Math.hypot(...y) < 1e-6) y = cross(Math.abs(x[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], x);
  y = unit(y);
  const z = cross(x, y);
  const rows = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
  const q = [1 + rows[0][0] - rows[1][1] - rows[2][2], 1 - rows[0][0] + rows[1][1] - rows[2][2],
    1 - rows[0][0] - rows[1][1] + rows[2][2], 1 + rows[0][0] + rows[1][1] + rows[2][2]];
  const size = q.map((square) => Math.sqrt(Math.max(square, 0)) / 2);
  const largest = size.indexOf(Math.max(...size));
  const sums = [[rows[2][1] - rows[1][2]], [rows[0][2] - rows[2][0]], [rows[1][0] - rows[0][1]]];
  const mixed = (i, j) => rows[i][j] + rows[j][i];
  const f = 1 / (4 * size[largest]);
  if (largest === 3) return [sums[0][0] * f, sums[1][0] * f, sums[2][0] * f, size[3]];
  return [0, 1, 2].map((i) => i === largest ? size[i] : mixed(i, largest) * f).concat(sums[largest][0] * f);
}
