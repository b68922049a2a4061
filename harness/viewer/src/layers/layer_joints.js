// Joints: a stick from each body to its anchor, the anchors, the axes along or about which a joint lets go, and between
// the anchors what parts them; the colour is the gap that the referee measured, not the distance that is drawn.
import { CylinderGeometry, MeshBasicMaterial, Quaternion, SphereGeometry, Vector3 } from 'three';
import { gapMap, oklch } from '../basics/colour.js';
import { Marks, writeAlong, writeScaled } from './marks.js';
import { kPose } from '../data/replay.js';

/** Of a spring, which holds no distance and so has no gap. */
export const kSpring = oklch(0.62, 0.03, 250);
const kAxis = oklch(0.78, 0.02, 250);

/** Local axes by which a joint lets its bodies go, of frame a and of frame b. */
const kAxes = {
  hinge: [['x'], []],
  slider: [['x'], []],
  universal: [['x'], ['y']],
  gear: [['x'], ['x']],
  rack_and_pinion: [['x'], ['x']],
};
const kAxisReach = { hinge: 7, slider: 16, universal: 6, gear: 7, rack_and_pinion: 7 }; // half of what is drawn of an axis, in marks
const kUnits = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0) };
const overlay = () => new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.95 });

/** Where a frame of a body is in the world, into `place` and `turn`; body null: the world itself. */
export function frameInWorld(poses, body, frame, place, turn) {
  place.fromArray(frame);
  turn.fromArray(frame, 3);
  if (body === null) return;
  const p = body * kPose,
    q = frameInWorld.body.fromArray(poses, p + 3);
  place.applyQuaternion(q);
  place.x += poses[p];
  place.y += poses[p + 1];
  place.z += poses[p + 2];
  turn.premultiply(q);
}
frameInWorld.body = new Quaternion();

export class JointLayer {
  /** Bodies move between frames, and joints with them. */
  static follows = true;

  constructor(replay, size) {
    this.replay = replay;
    this.size = size;
    this.joints = replay.header.joints;
    this.sticks = new Marks(new CylinderGeometry(1, 1, 1, 6).translate(0, 0.5, 0), overlay(), { order: 12 });
    this.anchors = new Marks(new SphereGeometry(1, 12, 8), overlay(), { order: 13 });
    this.object = this.sticks.object;
    this.object.add(this.anchors.object);
    this.a = new Vector3();
    this.b = new Vector3();
    this.turnA = new Quaternion();
    this.turnB = new Quaternion();
    this.axis = new Vector3();
  }

  update({ gapRange }) {
    const { replay, sticks, anchors, size, a, b } = this,
      { sections, poses } = replay,
      rgb = [0, 0, 0];
    sticks.clear();
    anchors.clear();
    for (let row = replay.first('joints'), end = replay.first('joints', 1); row < end; ++row) {
      const joint = this.joints[sections['joints/joint'][row]],
        gap = sections['joints/gap'][row];
      if (Number.isNaN(gap)) rgb.splice(0, 3, ...kSpring);
      else gapMap.write(gap / gapRange, rgb, 0);
      frameInWorld(poses, joint.body_a, joint.frame_a, a, this.turnA);
      frameInWorld(poses, joint.body_b, joint.frame_b, b, this.turnB);
      if (!Number.isFinite(a.x + a.y + a.z + b.x + b.y + b.z)) continue;
      this.link(joint.body_a, a, rgb);
      this.link(joint.body_b, b, rgb);
      this.stick(a, b, size * (joint.type === 'distance' ? 0.42 : 0.6), rgb);
      this.anchor(a, rgb);
      this.anchor(b, rgb);
      const [ofA, ofB] = kAxes[joint.type] ?? [[], []];
      for (const name of ofA) this.drawAxis(a, this.turnA, name, kAxisReach[joint.type]);
      for (const name of ofB) this.drawAxis(b, this.turnB, name, kAxisReach[joint.type]);
    }
    sticks.flush();
    anchors.flush();
  }

  /** From a body that moves to its anchor; what stands still, and the world, are no place to begin at. */
  link(body, anchor, rgb) {
    if (body === null || !this.replay.moves(body)) return;
    this.stick(this.axis.fromArray(this.replay.poses, body * kPose), anchor, this.size * 0.28, rgb);
  }

  stick(from, to, width, rgb) {
    const { sticks } = this,
      mark = sticks.next();
    writeAlong(sticks.matrices, mark * 16, from.x, from.y, from.z, to.x - from.x, to.y - from.y, to.z - from.z, width);
    sticks.colour(mark, rgb);
  }

  anchor({ x, y, z }, rgb) {
    const { anchors, size } = this,
      mark = anchors.next();
    writeScaled(anchors.matrices, mark * 16, x, y, z, size, size, size);
    anchors.colour(mark, rgb);
  }

  drawAxis(place, turn, name, reach) {
    const { sticks, size, axis } = this,
      mark = sticks.next();
    axis
      .copy(kUnits[name])
      .applyQuaternion(turn)
      .multiplyScalar(size * reach);
    const { x, y, z } = axis;
    writeAlong(sticks.matrices, mark * 16, place.x - x, place.y - y, place.z - z, 2 * x, 2 * y, 2 * z, size * 0.24);
    sticks.colour(mark, kAxis);
  }

  dispose() {
    this.sticks.dispose();
    this.anchors.dispose();
  }
}
