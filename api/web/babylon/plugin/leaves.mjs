// Options of a shape of Babylon.js as a shape of the engine and where it sits in the body: { desc, frame }.
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { along, fromUpTo, quatRowOf, rowOf, turned, product } from './values.mjs';

export const TYPE = { sphere: 0, capsule: 1, cylinder: 2, box: 3, hull: 4, container: 5, mesh: 6, heightField: 7 };
const kHere = { position: [0, 0, 0], orientation: [0, 0, 0, 1] };
const at = (center) => ({ ...kHere, position: center ? rowOf(center) : [0, 0, 0] });

export function leafOf(type, options) {
  switch (type) {
    case TYPE.sphere:
      return { desc: { type: 'sphere', radius: options.radius ?? 1 }, frame: at(options.center) };
    case TYPE.box:
      return { desc: { type: 'box', halfExtents: rowOf(options.extents ?? new Vector3(1, 1, 1)).map((e) => e / 2) },
        frame: { ...at(options.center), orientation: options.rotation ? quatRowOf(options.rotation) : [0, 0, 0, 1] } };
    case TYPE.capsule:
    case TYPE.cylinder:
      return betweenPoints(type === TYPE.capsule ? 'capsule' : 'cylinder', options);
    case TYPE.hull:
    case TYPE.mesh: {
      if (!options.mesh) throw new Error('PlumbPlugin: a convex hull or mesh shape needs parameters.mesh');
      const { vertices, indices } = verticesOf(options.mesh, options.includeChildMeshes ?? false);
      return { desc: { type: type === TYPE.hull ? 'hull' : 'mesh', vertices, indices }, frame: kHere };
    }
    case TYPE.heightField:
      return { desc: options.groundMesh ? fieldOfGround(options.groundMesh) : fieldOf(options), frame: kHere };
  }
  throw new Error(`PlumbPlugin: there is no shape type ${type}`);
}

function betweenPoints(type, { pointA = new Vector3(0, 0, 0), pointB = new Vector3(0, 1, 0), radius = 1 }) {
  const a = rowOf(pointA), b = rowOf(pointB), span = along(b, -1, a), length = Math.hypot(...span);
  return { desc: { type, radius, halfHeight: length / 2 },
    frame: { position: along(a, 0.5, span), orientation: length > 0 ? fromUpTo(span) : [0, 0, 0, 1] } };
}

/** Of a mesh, with its children if asked, in the frame of its body: scaled, but neither moved nor turned. */
function verticesOf(root, withChildren) {
  root.computeWorldMatrix(true);
  const frame = Matrix.Compose(Vector3.One(), root.absoluteRotationQuaternion, root.getAbsolutePosition());
  const toBody = Matrix.Invert(frame), vertices = [], indices = [];
  for (const mesh of [root, ...(withChildren ? root.getChildMeshes(false) : [])]) {
    const positions = mesh.getVerticesData?.('position');
    if (!positions) continue;
    const matrix = mesh.computeWorldMatrix(true).multiply(toBody), first = vertices.length / 3;
    const point = new Vector3();
    for (let i = 0; i < positions.length; i += 3) {
      Vector3.TransformCoordinatesFromFloatsToRef(positions[i], positions[i + 1], positions[i + 2], matrix, point);
      vertices.push(point.x, point.y, point.z);
    }
    // Babylon.js's triangles are clockwise seen from outside, the engine's counter-clockwise; a mirror turns them over.
    const list = mesh.getIndices() ?? [], mirrored = matrix.determinant() < 0;
    for (let i = 0; i < list.length; i += 3) {
      const [a, b, c] = [list[i], list[i + 1], list[i + 2]].map((index) => first + index);
      indices.push(a, ...(mirrored ? [b, c] : [c, b]));
    }
  }
  return { vertices, indices };
}

/** Babylon.js's rows begin at the largest z. */
function fieldOf({ heightFieldSizeX, heightFieldSizeZ, numHeightFieldSamplesX: columns, numHeightFieldSamplesZ: rows,
  heightFieldData: data }) {
  const heights = Array.from({ length: rows * columns }, (_, i) =>
    data[(rows - 1 - Math.floor(i / columns)) * columns + (i % columns)]);
  return { type: 'heightField', rows, columns, heights,
    spacing: [heightFieldSizeX / (columns - 1), heightFieldSizeZ / (rows - 1)] };
}

/** Of a ground, with its own heights, also where it is no square. */
function fieldOfGround(ground) {
  ground.computeWorldMatrix(true);
  const { vertices } = verticesOf(ground, false), near = (v) => Math.round(v * 1e4) / 1e4;
  const sorted = (axis) => [...new Set(vertices.filter((_, i) => i % 3 === axis).map(near))].sort((a, b) => a - b);
  const xs = sorted(0), zs = sorted(2), heights = new Array(xs.length * zs.length).fill(0);
  for (let i = 0; i < vertices.length; i += 3)
    heights[zs.indexOf(near(vertices[i + 2])) * xs.length + xs.indexOf(near(vertices[i]))] = vertices[i + 1];
  return { type: 'heightField', rows: zs.length, columns: xs.length, heights,
    spacing: [(xs.at(-1) - xs[0]) / (xs.length - 1), (zs.at(-1) - zs[0]) / (zs.length - 1)] };
}

/** A leaf of a child, as the container has it. */
export function placed({ desc, frame, material }, { position, orientation, scale }) {
  const largest = Math.max(...scale.map(Math.abs));
  const scaled = { ...desc };
  if (desc.radius !== undefined) scaled.radius = desc.radius * largest;
  if (desc.halfHeight !== undefined) scaled.halfHeight = desc.halfHeight * Math.abs(scale[1]);
  if (desc.halfExtents) scaled.halfExtents = desc.halfExtents.map((half, i) => half * Math.abs(scale[i]));
  if (desc.vertices) scaled.vertices = desc.vertices.map((v, i) => v * scale[i % 3]);
  if (desc.heights) {
    scaled.heights = desc.heights.map((height) => height * scale[1]);
    scaled.spacing = [desc.spacing[0] * scale[0], desc.spacing[1] * scale[2]];
  }
  const inner = frame.position.map((v, i) => v * scale[i]);
  return { desc: scaled, material, frame: { position: along(position, 1, turned(orientation, inner)),
    orientation: product(orientation, frame.orientation) } };
}

export const isAtHome = ({ position, orientation }) =>
  position.every((v) => v === 0) && Math.abs(orientation[3]) === 1;
