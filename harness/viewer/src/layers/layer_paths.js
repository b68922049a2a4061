// The way that each body takes through the whole replay, where few enough move for the lines to be told apart.
import { BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial } from 'three';

export const kMostPaths = 64;

export class PathLayer {
  constructor(replay, size, bodies) {
    this.object = new Group();
    this.lines = Array.from(replay.moving, (body, column) => {
      const points = new Float32Array(replay.frames * 3);
      for (let i = 0; i < points.length; ++i) points[i] = replay.coordinate(Math.floor(i / 3), column, i % 3);
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(points, 3));
      const colour = new Color().fromArray(bodies.baseColours, body * 3);
      const line = new Line(geometry, new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.8 }));
      line.frustumCulled = false;
      return line;
    });
    if (this.lines.length) this.object.add(...this.lines);
  }

  update() {}

  dispose() {
    for (const { geometry, material } of this.lines) {
      geometry.dispose();
      material.dispose();
    }
  }
}
