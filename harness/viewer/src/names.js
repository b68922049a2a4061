// Names of bodies beside them, of those nearest to the reader: as many as can be told apart.
import { Labels } from './labels.js';
import { kPose } from './data/replay.js';

const kMost = 40;

export class Names {
  constructor(port, replay) {
    this.replay = replay;
    this.labels = new Labels(port, kMost, 'pv-body-name');
    this.order = [...replay.bodies.keys()];
    this.distance = new Float64Array(replay.bodies.length);
  }

  static of(replay, body) {
    return replay.bodies[body].name || `body ${body}`;
  }

  place(camera, on) {
    const { labels, replay, order, distance } = this,
      { poses } = replay;
    labels.begin(camera);
    if (on) {
      const { x, y, z } = camera.position;
      for (const body of order) {
        const p = body * kPose;
        distance[body] = Math.hypot(poses[p] - x, poses[p + 1] - y, poses[p + 2] - z);
      }
      // What moves comes before what stands.
      order.sort((a, b) => replay.moves(b) - replay.moves(a) || distance[a] - distance[b]);
      for (const body of order) {
        if (labels.isFull) break;
        const p = body * kPose;
        labels.add(Names.of(replay, body), poses[p], poses[p + 1], poses[p + 2]);
      }
    }
    labels.end();
  }
}
