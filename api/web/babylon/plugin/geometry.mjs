// What shapes look like: triangles for debug views and bounds, by the builders of Babylon.js.
import { BoundingBox } from '@babylonjs/core/Culling/boundingBox.js';
import { Matrix, Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { CreateBoxVertexData } from '@babylonjs/core/Meshes/Builders/boxBuilder.js';
import { CreateCapsuleVertexData } from '@babylonjs/core/Meshes/Builders/capsuleBuilder.js';
import { CreateCylinderVertexData } from '@babylonjs/core/Meshes/Builders/cylinderBuilder.js';
import { CreateSphereVertexData } from '@babylonjs/core/Meshes/Builders/sphereBuilder.js';
import { along, turned } from './values.mjs';

/** Counter-clockwise seen from outside. A hull is shown by the triangles of its mesh. */
function surfaceOf(desc) {
  if (desc.type === 'mesh' || desc.type === 'hull') return desc;
  if (desc.type === 'heightField') return fieldSurface(desc);
  const data = {
    box: () => CreateBoxVertexData({ width: 2 * desc.halfExtents[0], height: 2 * desc.halfExtents[1],
      depth: 2 * desc.halfExtents[2] }),
    sphere: () => CreateSphereVertexData({ diameter: 2 * desc.radius, segments: 8 }),
    cylinder: () => CreateCylinderVertexData({ height: 2 * desc.halfHeight, diameter: 2 * desc.radius,
      tessellation: 24 }),
    capsule: () => CreateCapsuleVertexData({ height: 2 * (desc.halfHeight + desc.radius), radius: desc.radius,
      tessellation: 16, subdivisions: 1, capSubdivisions: 6, orientation: Vector3.Up() }),
  }[desc.type]();
  const indices = [];
  for (let i = 0; i < data.indices.length; i += 3)
    indices.push(data.indices[i], data.indices[i + 2], data.indices[i + 1]);
  return { vertices: [...data.positions], indices };
}

function fieldSurface({ rows, columns, heights, spacing }) {
  const vertices = [], indices = [];
  for (let r = 0; r < rows; ++r)
    for (let c = 0; c < columns; ++c)
      vertices.push((c - (columns - 1) / 2) * spacing[0], heights[r * columns + c], (r - (rows - 1) / 2) * spacing[1]);
  for (let r = 0; r + 1 < rows; ++r)
    for (let c = 0; c + 1 < columns; ++c) {
      const here = r * columns + c, next = here + columns;
      indices.push(here, next, here + 1, here + 1, next, next + 1);
    }
  return { vertices, indices };
}

/** Of all leaves together, in the body's frame. */
export function trianglesOf(leaves) {
  const vertices = [], indices = [];
  for (const { desc, frame } of leaves) {
    const surface = surfaceOf(desc), first = vertices.length / 3;
    for (let i = 0; i < surface.vertices.length; i += 3)
      vertices.push(...along(frame.position, 1, turned(frame.orientation, [...surface.vertices.slice(i, i + 3)])));
    for (const index of surface.indices) indices.push(first + index);
  }
  return { vertices, indices };
}

function boundsOf(vertices, matrix) {
  const least = new Vector3(Infinity, Infinity, Infinity), most = least.negate(), point = new Vector3();
  for (let i = 0; i < vertices.length; i += 3) {
    Vector3.TransformCoordinatesFromFloatsToRef(vertices[i], vertices[i + 1], vertices[i + 2], matrix, point);
    least.minimizeInPlace(point);
    most.maximizeInPlace(point);
  }
  return vertices.length > 0 ? new BoundingBox(least, most) : new BoundingBox(Vector3.Zero(), Vector3.Zero());
}

export const geometry = {
  getBodyGeometry(body) {
    const shape = this._one(body).shape;
    const { vertices, indices } = shape ? trianglesOf(this._leavesOf(shape)) : { vertices: [], indices: [] };
    return { positions: new Float32Array(vertices), indices: new Uint32Array(indices) };
  },
  getBoundingBox(shape) {
    return boundsOf(trianglesOf(this._leavesOf(shape._pluginData)).vertices, Matrix.Identity());
  },
  /** In the world; of instances the first. */
  getBodyBoundingBox(body) {
    const data = this._one(body), [x, y, z, ...turn] = this._poseOf(data);
    const pose = Matrix.Compose(Vector3.One(), new Quaternion(...turn), new Vector3(x, y, z));
    return boundsOf(data.shape ? trianglesOf(this._leavesOf(data.shape)).vertices : [], pose);
  },
};
