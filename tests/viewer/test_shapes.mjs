// Shapes as triangles: closed, outward, of the right volume and place.
import assert from 'node:assert/strict';
import test from 'node:test';
import { kNoShape, shapeGeometry, shapeRadius } from '../../harness/viewer/src/basics/shapes.js';
import { writeMatrix } from '../../harness/viewer/src/bodies.js';
import { writeAlong } from '../../harness/viewer/src/layers/marks.js';
import { kTetrahedron, quaternion, ringMesh } from './synthetic.mjs';

/** Volume within the triangles, by the divergence theorem: negative when they face inwards. */
function volume({ geometry, scale }) {
  const { array } = geometry.attributes.position,
    index = geometry.index?.array ?? [...Array(array.length / 3).keys()];
  const point = (i) => [0, 1, 2].map((k) => array[index[i] * 3 + k] * scale[k]);
  let sum = 0;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [point(i), point(i + 1), point(i + 2)];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

const near = (value, truth, relative) => assert.ok(Math.abs(value / truth - 1) < relative, `${value} is not ${truth}`);
const make = (shape, shapes = []) => shapeGeometry(shape, shapes, { detail: 40 });

test('volumes', () => {
  near(volume(make({ type: 'box', half_extents: [0.5, 1, 2] })), 8, 1e-6);
  near(volume(make({ type: 'sphere', radius: 2 })), (4 / 3) * Math.PI * 8, 0.02);
  near(volume(make({ type: 'cylinder', radius: 0.5, half_height: 2 })), Math.PI, 0.01);
  near(
    volume(make({ type: 'capsule', radius: 0.5, half_height: 1 })),
    Math.PI * 0.25 * 2 + (4 / 3) * Math.PI * 0.125,
    0.02,
  );
  near(volume(make(kTetrahedron)), (0.5 * 1.2 * 1.05 * 1.05) / 3, 1e-6);
  near(volume(make(ringMesh(0.5, 0.2, 96, 48))), 2 * Math.PI ** 2 * 0.5 * 0.04, 0.01);
  near(volume(make(kNoShape)), 4 / 3, 1e-6);
});

test('a capsule is as long as it says, along y', () => {
  const { geometry } = make({ type: 'capsule', radius: 0.3, half_height: 0.7 });
  geometry.computeBoundingBox();
  assert.ok(Math.abs(geometry.boundingBox.max.y - 1) < 1e-6 && Math.abs(geometry.boundingBox.max.x - 0.3) < 1e-6);
});

test('a compound is its children where they are', () => {
  const shapes = [
    { type: 'box', half_extents: [0.5, 0.5, 0.5] },
    { type: 'sphere', radius: 0.5 },
  ];
  const whole = make(
    {
      type: 'compound',
      children: [
        { shape: 0, position: [0, 0, 0], orientation: [0, 0, 0, 1] },
        { shape: 0, position: [5, 0, 0], orientation: quaternion([0, 0, 1], 0.4) },
        { shape: 1, position: [0, 7, 0], orientation: [0, 0, 0, 1] },
      ],
    },
    shapes,
  );
  near(volume(whole), 2 + Math.PI / 6, 0.01);
  whole.geometry.computeBoundingBox();
  near(whole.geometry.boundingBox.max.y, 7.5, 1e-3);
});

test('a height field has its points where the interface says, facing up', () => {
  const { geometry } = make({
    type: 'height_field',
    rows: 2,
    columns: 3,
    spacing: [2, 0.5],
    heights: [1, 2, 3, 4, 5, 6],
  });
  const points = geometry.attributes.position.array;
  assert.deepEqual([...points.slice(0, 3)], [-2, 1, -0.25]);
  assert.deepEqual([...points.slice(15, 18)], [2, 6, 0.25]);
  for (let i = 1; i < points.length; i += 3) assert.ok(geometry.attributes.normal.array[i] > 0);
});

test('a plane lies at its offset and looks along its normal', () => {
  const { geometry } = shapeGeometry({ type: 'plane', normal: [0, 3, 4], offset: 2 }, [], { extent: 10 });
  const { position, normal } = geometry.attributes;
  for (let i = 0; i < position.count; ++i) {
    assert.ok(Math.abs(position.getY(i) * 0.6 + position.getZ(i) * 0.8 - 2) < 1e-5);
    assert.ok(normal.getY(i) * 0.6 + normal.getZ(i) * 0.8 > 0.999);
  }
});

test('radii hold every point', () => {
  for (const shape of [
    { type: 'box', half_extents: [1, 2, 3] },
    { type: 'capsule', radius: 0.3, half_height: 1 },
    { type: 'cylinder', radius: 0.3, half_height: 1 },
    kTetrahedron,
  ]) {
    const { geometry, scale } = make(shape),
      { array } = geometry.attributes.position,
      radius = shapeRadius(shape, []);
    let far = 0;
    for (let i = 0; i < array.length; i += 3)
      far = Math.max(far, Math.hypot(array[i] * scale[0], array[i + 1] * scale[1], array[i + 2] * scale[2]));
    assert.ok(Math.abs(far - radius) < 1e-5 * radius, shape.type);
  }
});

test('an unknown shape is refused by name', () => assert.throws(() => make({ type: 'klein_bottle' }), /klein_bottle/));

test('matrices turn, scale and move', () => {
  const out = new Float32Array(16),
    pose = Float32Array.from([1, 2, 3, ...quaternion([0, 0, 1], Math.PI / 2)]);
  writeMatrix(pose, 0, [2, 3, 4], out, 0);
  const want = [0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1];
  out.forEach((value, i) => assert.ok(Math.abs(value - want[i]) < 1e-6, `entry ${i}`));
});

test('marks along any direction are upright and right-handed', () => {
  const m = new Float32Array(16);
  for (const [dx, dy, dz] of [
    [0, 1, 0],
    [1, 0, 0],
    [0, 0, -2],
    [1, 2, 3],
    [-1, 1e-3, 0],
  ]) {
    writeAlong(m, 0, 5, 6, 7, dx, dy, dz, 0.5);
    const [x, y, z] = [m.slice(0, 3), m.slice(4, 7), m.slice(8, 11)],
      dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
    assert.ok(Math.abs(dot(x, y)) < 1e-6 && Math.abs(dot(y, z)) < 1e-6 && Math.abs(dot(x, z)) < 1e-6);
    assert.ok(Math.abs(Math.hypot(...x) - 0.5) < 1e-6 && Math.abs(Math.hypot(...z) - 0.5) < 1e-6);
    const turn =
      x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
    assert.ok(turn > 0);
    assert.deepEqual([...m.slice(4, 7)], [...Float32Array.from([dx, dy, dz])]);
  }
});
