// Contact forces as chains: from centre to contact to centre, as wide and as bright as the force along the normal.
import { CylinderGeometry, MeshBasicMaterial } from 'three';
import { forceMap } from '../basics/colour.js';
import { Marks, writeToPlace } from './marks.js';
import { kPose } from '../data/replay.js';

const kLeast = 0.004; // of the range: what is less is not drawn

export class ForceLayer {
  constructor(replay, size) {
    this.replay = replay;
    this.size = size;
    this.marks = new Marks(
      new CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0),
      new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.92 }),
      { order: 12 },
    );
    this.object = this.marks.object;
  }

  update({ forceRange }) {
    const { replay, marks } = this,
      { sections, poses } = replay;
    const forces = sections['contacts/force'],
      points = sections['contacts/point'];
    const ends = [sections['contacts/body_a'], sections['contacts/body_b']];
    marks.clear();
    for (let row = replay.first('contacts'), end = replay.first('contacts', 1); row < end; ++row) {
      const t = Math.abs(forces[row]) / forceRange;
      if (!(t > kLeast)) continue;
      const x = points[row * 3],
        y = points[row * 3 + 1],
        z = points[row * 3 + 2];
      for (const bodies of ends) {
        const body = bodies[row];
        if (!replay.moves(body)) continue;
        const p = body * kPose,
          mark = marks.next();
        writeToPlace(
          marks.matrices,
          mark * 16,
          x,
          y,
          z,
          poses,
          p,
          this.size * (0.25 + 1.6 * Math.sqrt(Math.min(t, 1))),
        );
        forceMap.write(t, marks.colours, mark * 3);
      }
    }
    marks.flush();
  }

  dispose() {
    this.marks.dispose();
  }
}
