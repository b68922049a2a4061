// The picked body: its edges in front of everything, and the path that it takes through the whole replay.
import {
  BufferAttribute,
  BufferGeometry,
  EdgesGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  BackSide,
} from 'three';
import { kPose } from './data/replay.js';
import { writeMatrix } from './bodies.js';

const kGrow = 1.06; // of the halo against the body

export class Selection {
  constructor(replay, bodies) {
    this.replay = replay;
    this.bodies = bodies;
    this.body = null;
    this.lineMaterial = new LineBasicMaterial({ depthTest: false, transparent: true });
    this.haloMaterial = new MeshBasicMaterial({ side: BackSide });
    this.pathMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.75 });
    this.object = new Group();
    this.object.visible = false;
  }

  paint(theme) {
    for (const material of [this.lineMaterial, this.haloMaterial, this.pathMaterial]) material.color.copy(theme.mark);
  }

  set(body) {
    this.clear();
    const place = body === null ? null : this.bodies.place[body];
    if (!place) return;
    this.body = body;
    const { geometry } = place.group.mesh;
    this.scale = place.group.members[place.at].scale;
    this.halo = new Mesh(geometry, this.haloMaterial);
    this.lines = new LineSegments(new EdgesGeometry(geometry, 25), this.lineMaterial);
    for (const part of [this.halo, this.lines]) {
      part.matrixAutoUpdate = false;
      part.frustumCulled = false;
      this.object.add(part);
    }
    this.halo.visible = !place.group.fixed;
    this.lines.renderOrder = 5;
    if (this.replay.column[body] >= 0) this.object.add((this.path = this.pathOf(this.replay.column[body])));
    this.object.visible = true;
    this.update();
  }

  pathOf(column) {
    const { replay } = this,
      points = new Float32Array(replay.frames * 3);
    for (let i = 0; i < points.length; ++i) points[i] = replay.coordinate(Math.floor(i / 3), column, i % 3);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    const line = new Line(geometry, this.pathMaterial);
    line.frustumCulled = false;
    return line;
  }

  update() {
    if (this.body === null) return;
    writeMatrix(this.replay.poses, this.body * kPose, this.scale, this.lines.matrix.elements, 0);
    writeMatrix(
      this.replay.poses,
      this.body * kPose,
      this.scale.map((s) => s * kGrow),
      this.halo.matrix.elements,
      0,
    );
    for (const part of [this.halo, this.lines]) part.matrixWorldNeedsUpdate = true;
  }

  clear() {
    this.lines?.geometry.dispose();
    this.path?.geometry.dispose();
    this.lines = this.path = undefined;
    this.object.clear();
    this.object.visible = false;
    this.body = null;
  }

  dispose() {
    this.clear();
    for (const material of [this.lineMaterial, this.haloMaterial, this.pathMaterial]) material.dispose();
  }
}
