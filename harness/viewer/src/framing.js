// Where the camera begins: all moving bodies of all engines in the picture, but not one that has flown off.
import { Vector3 } from 'three';
import { shapeRadius } from './basics/shapes.js';

const kFrames = 24; // looked at, of each replay
const kTail = 0.04; // of the positions at either end, left out
const kSmall = 3; // times the largest that moves: what stands still and is larger is ground

function quantile(sorted, q) {
  return sorted[Math.min(sorted.length - 1, Math.max(0, Math.round(q * (sorted.length - 1))))];
}

/** Radius of the body in the middle of all that move. */
function bodySize(replays) {
  const radii = replays.flatMap(({ header, moving }) =>
    Array.from(moving, (body) => shapeRadius(header.shapes[header.bodies[body].shape], header.shapes)),
  );
  return radii.length
    ? quantile(
        radii.sort((a, b) => a - b),
        0.5,
      )
    : 0;
}

/** {centre, radius} of what happens in the replays and the size of marks on it, m. */
export function framing(replays) {
  const lower = [Infinity, Infinity, Infinity],
    upper = [-Infinity, -Infinity, -Infinity];
  const grow = (axis, low, high) => {
    if (Number.isFinite(low)) lower[axis] = Math.min(lower[axis], low);
    if (Number.isFinite(high)) upper[axis] = Math.max(upper[axis], high);
  };
  for (const replay of replays) {
    const radii = Array.from(replay.moving, (body) =>
      shapeRadius(replay.header.shapes[replay.bodies[body].shape], replay.header.shapes),
    );
    for (let axis = 0; axis < 3; ++axis) {
      const values = [];
      for (let i = 0; i < kFrames && replay.frames; ++i) {
        const frame = Math.floor((i * (replay.frames - 1)) / (kFrames - 1));
        for (let c = 0; c < replay.moving.length; ++c) values.push(replay.coordinate(frame, c, axis));
      }
      values.sort((a, b) => a - b);
      const largest = radii.length
        ? quantile(
            [...radii].sort((a, b) => a - b),
            0.9,
          ) * (axis === 1 ? 0.6 : 0.8)
        : 0;
      if (values.length) grow(axis, quantile(values, kTail) - largest, quantile(values, 1 - kTail) + largest);
      replay.moving.forEach((body, c) =>
        grow(axis, replay.bodies[body].start[axis] - radii[c] * 0.6, replay.bodies[body].start[axis] + radii[c] * 0.6),
      );
    }
    const widest = radii.length ? kSmall * Math.max(...radii) : Infinity;
    for (const body of replay.bodies) {
      const radius = shapeRadius(replay.header.shapes[body.shape], replay.header.shapes);
      if (body.motion === 'dynamic' || !(radius > 0) || radius > widest) continue;
      for (let axis = 0; axis < 3; ++axis) grow(axis, body.start[axis] - 0.6 * radius, body.start[axis] + 0.6 * radius);
    }
  }
  for (const { header } of replays) {
    for (const { body_a, frame_a } of header.joints ?? []) {
      if (body_a === null) for (let axis = 0; axis < 3; ++axis) grow(axis, frame_a[axis], frame_a[axis]);
    }
  }
  const centre = new Vector3(),
    size = new Vector3(1, 1, 1);
  if (lower.every(Number.isFinite) && upper.every(Number.isFinite)) {
    centre.set(...lower.map((low, i) => 0.5 * (low + upper[i])));
    size.set(...lower.map((low, i) => upper[i] - low));
  }
  const radius = Math.max(0.5 * size.length(), 1e-3);
  return {
    centre,
    radius,
    half: size.multiplyScalar(0.5),
    markSize: Math.min(radius / 55, (bodySize(replays) || radius) / 9),
  };
}

const kMargin = 0.9; // of the half view that the picture may fill

/** Puts the camera as near as shows the whole box of the framing. */
export function placeCamera(camera, target, { centre, radius, half }, direction = new Vector3(0.62, 0.42, 1)) {
  const towards = direction.clone().normalize(),
    right = new Vector3().crossVectors(new Vector3(0, 1, 0), towards).normalize();
  const up = new Vector3().crossVectors(towards, right),
    tall = Math.tan((camera.fov * Math.PI) / 360) * kMargin,
    corner = new Vector3();
  let distance = 0;
  for (let i = 0; i < 8; ++i) {
    corner.set(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
    const across = Math.max(Math.abs(corner.dot(up)) / tall, Math.abs(corner.dot(right)) / (tall * camera.aspect));
    distance = Math.max(distance, across + corner.dot(towards));
  }
  target.copy(centre);
  camera.position.copy(towards).multiplyScalar(distance).add(centre);
  camera.near = radius / 100;
  camera.far = radius * 60;
  camera.updateProjectionMatrix();
  camera.lookAt(target);
}
