// All bodies of a replay as instances: one draw call for each kind of shape, matrices written in place every frame.
import {
  BufferAttribute,
  DynamicDrawUsage,
  EdgesGeometry,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  LineSegments,
  StaticDrawUsage,
} from 'three';
import { writeBodyColour } from './basics/colour.js';
import { kPose } from './data/replay.js';
import { detailFor, kNoShape, shapeGeometry } from './basics/shapes.js';

const kRound = new Set(['sphere', 'capsule', 'plane', 'height_field']);
const kGround = new Set(['plane', 'mesh', 'height_field']);
const kEdgeAngle = 25; // degrees between faces that show their common edge
const kPlaces = 1e5; // to the extent: so finely bodies are put in order
const kManyEdges = 4000; // triangles of one shape beyond which its edges only blur

/** Column-major rotation of a unit quaternion times scale, and the position, into out at offset. */
export function writeMatrix(poses, pose, scale, out, offset) {
  const x = poses[pose + 3],
    y = poses[pose + 4],
    z = poses[pose + 5],
    w = poses[pose + 6];
  const [sx, sy, sz] = scale;
  out[offset] = (1 - 2 * (y * y + z * z)) * sx;
  out[offset + 1] = 2 * (x * y + w * z) * sx;
  out[offset + 2] = 2 * (x * z - w * y) * sx;
  out[offset + 3] = 0;
  out[offset + 4] = 2 * (x * y - w * z) * sy;
  out[offset + 5] = (1 - 2 * (x * x + z * z)) * sy;
  out[offset + 6] = 2 * (y * z + w * x) * sy;
  out[offset + 7] = 0;
  out[offset + 8] = 2 * (x * z + w * y) * sz;
  out[offset + 9] = 2 * (y * z - w * x) * sz;
  out[offset + 10] = (1 - 2 * (x * x + y * y)) * sz;
  out[offset + 11] = 0;
  out[offset + 12] = poses[pose];
  out[offset + 13] = poses[pose + 1];
  out[offset + 14] = poses[pose + 2];
  out[offset + 15] = 1;
}

/** Lines drawn once an instance, with a mesh's matrices: the renderer takes any object that says it is instanced. */
function instancedEdges(mesh, geometry, material) {
  const lines = new LineSegments(geometry, material);
  Object.assign(lines, {
    isInstancedMesh: true,
    instanceMatrix: mesh.instanceMatrix,
    instanceColor: null,
    morphTexture: null,
    count: mesh.count,
    frustumCulled: false,
  });
  lines.raycast = () => {};
  return lines;
}

/** Tells the shader how far a geometry reaches, so that it can keep tiny bodies visible. */
function addReach(geometry) {
  geometry.computeBoundingSphere();
  const { radius, center } = geometry.boundingSphere;
  const reach = new Float32Array(geometry.attributes.position.count).fill(radius + center.length());
  geometry.setAttribute('reach', new BufferAttribute(reach, 1));
}

export class Bodies {
  constructor(replay, materials, extent) {
    this.replay = replay;
    this.materials = materials;
    this.extent = extent;
    this.object = new Group();
    this.groups = [];
    /** Where a body is drawn: its group and its place there. */
    this.place = new Array(replay.bodies.length).fill(null);
    const detail = detailFor(replay.bodies.length),
      shapes = replay.header.shapes,
      kinds = new Map(),
      made = new Map();
    replay.bodies.forEach((body, index) => {
      const number = body.shape ?? -1;
      const shape = number < 0 ? kNoShape : shapes[number];
      if (!made.has(number)) made.set(number, shapeGeometry(shape, shapes, { detail, extent }));
      // Of a pair of shapes the one at rest is a body like the other, not ground.
      const shared = made.get(number),
        fixed = !replay.moves(index) && (replay.header.kind !== 'pairs' || kGround.has(shape.type));
      const scale = number < 0 ? [extent / 350, extent / 350, extent / 350] : shared.scale;
      const key = `${fixed} ${shared.key}`;
      if (!kinds.has(key)) kinds.set(key, { geometry: shared.geometry, fixed, type: shape.type, members: [] });
      kinds.get(key).members.push({ index, scale });
    });
    for (const kind of kinds.values()) this.addGroup(kind);
    this.baseColours = this.bodyColours();
    this.paint();
    this.update();
  }

  addGroup({ geometry, fixed, type, members }) {
    const open = type === 'mesh' || type === 'height_field';
    const { ground, openGround, body, openBody } = this.materials;
    const material = fixed ? (open ? openGround : ground) : open ? openBody : body;
    if (!fixed) addReach(geometry);
    const mesh = new InstancedMesh(geometry, material, members.length);
    mesh.instanceMatrix.setUsage(fixed ? StaticDrawUsage : DynamicDrawUsage);
    mesh.frustumCulled = false;
    mesh.castShadow = !fixed; // walls would darken what they hold
    mesh.receiveShadow = true;
    if (!fixed)
      mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(members.length * 3), 3).setUsage(
        DynamicDrawUsage,
      );
    const group = { mesh, fixed, members, written: false };
    members.forEach((member, at) => {
      this.place[member.index] = { group, at };
    });
    this.groups.push(group);
    this.object.add(mesh);
    const triangles = (geometry.index ?? geometry.attributes.position).count / 3;
    const endless = fixed && members.some(({ scale }) => Math.max(...scale) > this.extent / 3); // edges beyond the haze
    if (!kRound.has(type) && triangles < kManyEdges && !endless) {
      group.edges = new EdgesGeometry(geometry, kEdgeAngle);
      group.lines = instancedEdges(mesh, group.edges, fixed ? this.materials.fixedEdge : this.materials.edge);
      this.object.add(group.lines);
    }
  }

  /** Along the scene by where the bodies start, lowest first; neighbours differ a little, to be told apart. */
  bodyColours() {
    const { replay } = this,
      order = [...replay.bodies.keys()].filter((body) => !this.place[body].group.fixed),
      colours = new Float32Array(replay.bodies.length * 3);
    const place = (body, axis) => Math.round((replay.bodies[body].start[axis] * kPlaces) / this.extent);
    order.sort((a, b) => place(a, 1) - place(b, 1) || place(a, 0) - place(b, 0) || a - b);
    order.forEach((body, rank) => {
      const t = order.length > 1 ? rank / (order.length - 1) : 0.35;
      writeBodyColour(t, rank % 2 ? 0.93 : 1.05, colours, body * 3);
    });
    return colours;
  }

  /** Colours of all moving bodies: by their own colour, or by write(body, out, offset) where given. */
  paint(write) {
    for (const { mesh, fixed, members } of this.groups) {
      if (fixed) continue;
      const colours = mesh.instanceColor.array;
      for (let i = 0; i < members.length; ++i) {
        const body = members[i].index;
        for (let k = 0; k < 3; ++k) colours[i * 3 + k] = this.baseColours[body * 3 + k];
        if (write) write(body, colours, i * 3);
      }
      mesh.instanceColor.needsUpdate = true;
    }
  }

  /** Puts the bodies where the replay's last sample says. */
  update() {
    const { poses } = this.replay;
    for (const group of this.groups) {
      if (group.fixed && group.written) continue;
      const { mesh, members } = group,
        matrices = mesh.instanceMatrix.array;
      for (let i = 0; i < members.length; ++i)
        writeMatrix(poses, members[i].index * kPose, members[i].scale, matrices, i * 16);
      mesh.instanceMatrix.needsUpdate = true;
      group.written = true;
    }
  }

  showEdges(on) {
    for (const { lines } of this.groups) if (lines) lines.visible = on;
  }

  /** {body, distance, point} of the first that the ray meets, or null. */
  hit(raycaster) {
    let best = null;
    for (const { mesh, members } of this.groups) {
      mesh.boundingSphere = null; // of the matrices as they are now
      for (const hit of raycaster.intersectObject(mesh, false)) {
        if (!best || hit.distance < best.distance)
          best = { distance: hit.distance, point: hit.point, body: members[hit.instanceId].index };
      }
    }
    return best;
  }

  dispose() {
    for (const { mesh, edges } of this.groups) {
      mesh.geometry.dispose();
      mesh.dispose();
      edges?.dispose();
    }
  }
}
