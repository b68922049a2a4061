// Velocities as arrows from the bodies that move: as long as the way of a tenth of a second.
import { ConeGeometry, CylinderGeometry, MeshBasicMaterial } from 'three';
import { oklch } from '../basics/colour.js';
import { kPose } from '../data/replay.js';
import { Marks, writeAlong } from './marks.js';

const kSeconds = 0.1;
const kColour = oklch(0.66, 0.19, 15);
const overlay = () => new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });

export class VelocityLayer {
  /** Bodies move between frames, and arrows with them. */
  static follows = true;

  constructor(replay, size) {
    this.replay = replay;
    this.size = size;
    this.sticks = new Marks(new CylinderGeometry(1, 1, 1, 6).translate(0, 0.5, 0), overlay(), { order: 12 });
    this.tips = new Marks(new ConeGeometry(1, 1, 10).translate(0, 0.5, 0), overlay(), { order: 13 });
    this.object = this.sticks.object;
    this.object.add(this.tips.object);
    this.way = [0, 0, 0];
  }

  update() {
    const { replay, sticks, tips, size, way } = this,
      { poses } = replay;
    sticks.clear();
    tips.clear();
    for (const body of replay.moving) {
      const p = body * kPose,
        length = kSeconds * Math.hypot(...replay.velocity(body, way));
      if (!(length > size / 4)) continue;
      const [x, y, z] = way.map((part) => part * kSeconds),
        tip = Math.min((2 * size) / length, 0.5);
      const stick = sticks.next(),
        cone = tips.next();
      const head = 1 - tip;
      writeAlong(
        sticks.matrices,
        stick * 16,
        poses[p],
        poses[p + 1],
        poses[p + 2],
        x * head,
        y * head,
        z * head,
        size * 0.3,
      );
      writeAlong(
        tips.matrices,
        cone * 16,
        poses[p] + x * head,
        poses[p + 1] + y * head,
        poses[p + 2] + z * head,
        x * tip,
        y * tip,
        z * tip,
        size * 0.8,
      );
      sticks.colour(stick, kColour);
      tips.colour(cone, kColour);
    }
    sticks.flush();
    tips.flush();
  }

  dispose() {
    this.sticks.dispose();
    this.tips.dispose();
  }
}
