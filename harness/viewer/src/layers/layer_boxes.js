// The broad phase's boxes: every node of its trees, coloured by how deep it hangs.
import { BoxGeometry, EdgesGeometry, LineBasicMaterial } from 'three';
import { depthColour } from './legends.js';
import { Marks, writeScaled } from './marks.js';

export class BoxLayer {
  constructor(replay) {
    this.replay = replay;
    this.marks = new Marks(
      new EdgesGeometry(new BoxGeometry(1, 1, 1)),
      new LineBasicMaterial({ transparent: true, opacity: 0.85 }),
      { lines: true, order: 8 },
    );
    this.object = this.marks.object;
  }

  update({ boxDepth, deepestBox }) {
    const { replay, marks } = this,
      { sections } = replay;
    const lower = sections['boxes/lower'],
      upper = sections['boxes/upper'],
      depths = sections['boxes/depth'],
      bodies = sections['boxes/body'];
    marks.clear();
    for (let row = replay.first('boxes'), end = replay.first('boxes', 1); row < end; ++row) {
      const depth = depths ? depths[row] : -1,
        leaf = !bodies || bodies[row] >= 0;
      if (boxDepth === 'leaves' ? !leaf : boxDepth !== 'all' && depth !== boxDepth) continue;
      const i = row * 3,
        mark = marks.next();
      writeScaled(
        marks.matrices,
        mark * 16,
        0.5 * (lower[i] + upper[i]),
        0.5 * (lower[i + 1] + upper[i + 1]),
        0.5 * (lower[i + 2] + upper[i + 2]),
        upper[i] - lower[i],
        upper[i + 1] - lower[i + 1],
        upper[i + 2] - lower[i + 2],
      );
      marks.colour(mark, depthColour(depth, deepestBox));
    }
    marks.flush();
  }

  dispose() {
    this.marks.dispose();
  }
}
