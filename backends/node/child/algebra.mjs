// Vectors and quaternions (x y z w) as arrays, and what adapters make of them.
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (s, a) => [s * a[0], s * a[1], s * a[2]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const conjugate = (q) => [-q[0], -q[1], -q[2], q[3]];

/** First b, then a. */
export const multiply = (a, b) => [
  a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
  a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
  a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
  a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
];

export function rotate(q, v) {
  const u = [q[0], q[1], q[2]], t = scale(2, cross(u, v));
  return add(v, add(scale(q[3], t), cross(u, t)));
}
export const unrotate = (q, v) => rotate(conjugate(q), v);

/** The pose `inner`, given in the frame of `outer`, in the frame that `outer` is given in. */
export const compose = (outer, inner) => ({
  position: add(outer.position, rotate(outer.orientation, inner.position)),
  orientation: multiply(outer.orientation, inner.orientation),
});
export function inverse(pose) {
  const back = conjugate(pose.orientation);
  return { position: rotate(back, scale(-1, pose.position)), orientation: back };
}

/** The rule of PlumbFilter. */
export function mayTouch(a, b) {
  if (a.group === b.group && a.group !== 0) return a.group > 0;
  return (a.category & b.mask) !== 0 && (b.category & a.mask) !== 0;
}

/** A key for an unordered pair of slots. */
export const pairKey = (a, b) => (a < b ? a * 4294967296 + b : b * 4294967296 + a);
