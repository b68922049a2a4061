// Shapes of the contract as triangle geometry in the shape's own frame: y along capsules and cylinders, metres.
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  CircleGeometry,
  CylinderGeometry,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';

/** Segments round a curve, by how many bodies share the picture: few and smooth, or many and light. */
export const detailFor = (bodies) => (bodies <= 64 ? 40 : bodies <= 600 ? 24 : 14);

/** Flat triangles: each its own three points and one normal. */
function flat(points, triangles) {
  const positions = new Float32Array(triangles.length * 9);
  triangles.forEach((triangle, t) => triangle.forEach((index, i) => positions.set(points[index], t * 9 + i * 3)));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.computeVertexNormals();
  return geometry;
}

function fan(face) {
  const triangles = [];
  for (let i = 2; i < face.length; ++i) triangles.push([face[0], face[i - 1], face[i]]);
  return triangles;
}

/** Row by row, y over a rectangle round the origin; x along columns, z along rows. */
function heightField({ rows, columns, heights, spacing, spacing_x, spacing_z }) {
  const dx = spacing_x ?? spacing[0],
    dz = spacing_z ?? spacing[spacing.length - 1];
  const flatHeights = heights.flat();
  const positions = new Float32Array(rows * columns * 3),
    index = [];
  for (let row = 0, i = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column, ++i) {
      positions.set([(column - (columns - 1) / 2) * dx, flatHeights[i], (row - (rows - 1) / 2) * dz], i * 3);
      if (row + 1 < rows && column + 1 < columns)
        index.push(i, i + columns, i + 1, i + 1, i + columns, i + columns + 1);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

/** A disc of the given radius stands for the endless plane. */
function plane({ normal = [0, 1, 0], offset = 0 }, extent) {
  const n = new Vector3(...normal).normalize();
  return new CircleGeometry(extent, 96)
    .applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), n))
    .translate(n.x * offset, n.y * offset, n.z * offset);
}

function compound({ children }, shapes, options) {
  const parts = children.map(({ shape, position, orientation }) => {
    const made = shapeGeometry(typeof shape === 'number' ? shapes[shape] : shape, shapes, options);
    const part = made.geometry.index ? made.geometry.toNonIndexed() : made.geometry.clone();
    for (const name of Object.keys(part.attributes)) {
      if (name !== 'position' && name !== 'normal') part.deleteAttribute(name);
    }
    return part.applyMatrix4(
      new Matrix4().compose(new Vector3(...position), new Quaternion(...orientation), new Vector3(...made.scale)),
    );
  });
  return mergeGeometries(parts);
}

const kUnit = [1, 1, 1];

/** {key, scale, geometry}: bodies of equal key share the geometry and are scaled; so all boxes are one draw call. */
export function shapeGeometry(shape, shapes, { detail = 40, extent = 100 } = {}) {
  switch (shape.type) {
    case 'box':
      return { key: 'box', scale: shape.half_extents, geometry: new BoxGeometry(2, 2, 2) };
    case 'sphere':
      return {
        key: 'sphere',
        scale: [shape.radius, shape.radius, shape.radius],
        geometry: new SphereGeometry(1, detail, Math.ceil(detail * 0.6)),
      };
    case 'cylinder':
      return {
        key: 'cylinder',
        scale: [shape.radius, shape.half_height, shape.radius],
        geometry: new CylinderGeometry(1, 1, 2, detail),
      };
    case 'capsule': {
      const geometry = new CapsuleGeometry(shape.radius, 2 * shape.half_height, Math.ceil(detail / 4), detail);
      return { key: JSON.stringify(shape), scale: kUnit, geometry };
    }
    case 'hull':
      return { key: JSON.stringify(shape), scale: kUnit, geometry: flat(shape.vertices, shape.faces.flatMap(fan)) };
    case 'mesh':
      return { key: JSON.stringify(shape), scale: kUnit, geometry: flat(shape.vertices, shape.triangles) };
    case 'height_field':
      return { key: JSON.stringify(shape), scale: kUnit, geometry: heightField(shape) };
    case 'plane':
      return { key: JSON.stringify(shape), scale: kUnit, geometry: plane(shape, extent) };
    case 'compound':
      return {
        key: JSON.stringify(shape.children),
        scale: kUnit,
        geometry: compound(shape, shapes, { detail, extent }),
      };
    default:
      throw new Error(`a shape has the type "${shape.type}", which this viewer does not know`);
  }
}

/** Of bodies without a shape: a small octahedron marks where they are. */
export const kNoShape = {
  type: 'hull',
  vertices: [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
  ],
  faces: [
    [0, 2, 4],
    [2, 1, 4],
    [1, 3, 4],
    [3, 0, 4],
    [2, 0, 5],
    [1, 2, 5],
    [3, 1, 5],
    [0, 3, 5],
  ],
};

/** Radius of the smallest origin-centred ball round a shape; 0 for what is endless. */
export function shapeRadius(shape, shapes) {
  const far = (points) => points.reduce((most, p) => Math.max(most, Math.hypot(...p)), 0);
  switch (shape?.type) {
    case 'box':
      return Math.hypot(...shape.half_extents);
    case 'sphere':
      return shape.radius;
    case 'capsule':
      return shape.radius + shape.half_height;
    case 'cylinder':
      return Math.hypot(shape.radius, shape.half_height);
    case 'hull':
    case 'mesh':
      return far(shape.vertices);
    case 'height_field':
      return (
        0.5 *
        Math.hypot(
          shape.columns * (shape.spacing_x ?? shape.spacing[0]),
          shape.rows * (shape.spacing_z ?? shape.spacing[shape.spacing.length - 1]),
        )
      );
    case 'compound':
      return shape.children.reduce(
        (most, child) =>
          Math.max(
            most,
            Math.hypot(...child.position) +
              shapeRadius(typeof child.shape === 'number' ? shapes[child.shape] : child.shape, shapes),
          ),
        0,
      );
    default:
      return 0;
  }
}
