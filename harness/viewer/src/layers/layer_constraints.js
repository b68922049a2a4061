// The constraint graph: an edge for each constraint, in the colour whose constraints are solved at the same time.
import { CylinderGeometry, MeshBasicMaterial } from 'three';
import { kindColour, oklch } from '../basics/colour.js';
import { Marks, writeToPlace } from './marks.js';
import { Partners } from './partners.js';
import { kPose } from '../data/replay.js';

const kSerial = oklch(0.6, 0, 0);
export const graphColour = (colour) => (colour < 0 ? kSerial : kindColour(colour, 0.72, 0.16));

export class ConstraintLayer {
  constructor(replay, size) {
    this.replay = replay;
    this.size = size;
    this.partners = new Partners(replay);
    this.marks = new Marks(
      new CylinderGeometry(1, 1, 1, 7).translate(0, 0.5, 0),
      new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.95 }),
      { order: 12 },
    );
    this.object = this.marks.object;
  }

  update() {
    const { replay, marks } = this,
      { sections, poses } = replay;
    const a = sections['constraints/body_a'],
      b = sections['constraints/body_b'],
      colours = sections['constraints/colour'];
    marks.clear();
    for (let row = replay.first('constraints'), end = replay.first('constraints', 1); row < end; ++row) {
      const [x, y, z] = this.partners.meet(a[row], b[row]),
        rgb = graphColour(colours[row]);
      for (let side = 0; side < 2; ++side) {
        const body = side ? b[row] : a[row];
        if (!replay.moves(body)) continue;
        const mark = marks.next(),
          p = body * kPose;
        writeToPlace(marks.matrices, mark * 16, x, y, z, poses, p, this.size * 0.6);
        marks.colour(mark, rgb);
      }
    }
    marks.flush();
  }

  dispose() {
    this.marks.dispose();
  }
}
