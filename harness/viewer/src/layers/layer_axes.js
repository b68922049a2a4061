// Separating axes: for each pair the axis on which the narrow phase decided, and a pane across it where the two meet.
import { BoxGeometry, CylinderGeometry, MeshBasicMaterial } from 'three';
import { oklch } from '../basics/colour.js';
import { Marks, writeAlong } from './marks.js';
import { Partners } from './partners.js';

export const kApart = oklch(0.72, 0.13, 235),
  kOverlap = oklch(0.72, 0.17, 50);

export class AxisLayer {
  constructor(replay, size) {
    this.replay = replay;
    this.size = size;
    this.partners = new Partners(replay);
    this.sticks = new Marks(
      new CylinderGeometry(1, 1, 1, 6),
      new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.95 }),
      { order: 12 },
    );
    this.panes = new Marks(
      new BoxGeometry(1, 1, 1),
      new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true, opacity: 0.28 }),
      { order: 11 },
    );
    this.object = this.sticks.object;
    this.object.add(this.panes.object);
  }

  update() {
    const { replay, sticks, panes, size } = this,
      { sections } = replay;
    const axes = sections['axes/axis'],
      a = sections['axes/body_a'],
      b = sections['axes/body_b'],
      gaps = sections['axes/separation'];
    sticks.clear();
    panes.clear();
    for (let row = replay.first('axes'), end = replay.first('axes', 1); row < end; ++row) {
      const [x, y, z] = this.partners.meet(a[row], b[row]),
        i = row * 3,
        rgb = gaps && gaps[row] > 0 ? kApart : kOverlap;
      const stick = sticks.next(),
        pane = panes.next(),
        nx = axes[i] * size,
        ny = axes[i + 1] * size,
        nz = axes[i + 2] * size;
      writeAlong(sticks.matrices, stick * 16, x, y, z, nx * 12, ny * 12, nz * 12, size * 0.35);
      writeAlong(panes.matrices, pane * 16, x, y, z, nx * 0.1, ny * 0.1, nz * 0.1, size * 9);
      sticks.colour(stick, rgb);
      panes.colour(pane, rgb);
    }
    sticks.flush();
    panes.flush();
  }

  dispose() {
    this.sticks.dispose();
    this.panes.dispose();
  }
}
