// Contact points with their normals; a point keeps its colour as long as it keeps its id.
import { ConeGeometry, CylinderGeometry, MeshBasicMaterial, SphereGeometry } from 'three';
import { kindColour } from '../basics/colour.js';
import { Marks, writeAlong, writeScaled } from './marks.js';

const overlay = () => new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.95 });
const kColours = Array.from({ length: 64 }, (_, i) => kindColour(i, 0.72, 0.17));

/** Ids are spread over the colours, for those of one pair often differ in a bit only. */
export const idColour = (id) => kColours[(Math.imul(id, 2654435761) >>> 16) & 63];

export class ContactLayer {
  constructor(replay, size) {
    this.replay = replay;
    this.size = size;
    this.dots = new Marks(new SphereGeometry(1, 12, 8), overlay(), { order: 14 });
    this.sticks = new Marks(new CylinderGeometry(1, 1, 1, 6).translate(0, 0.5, 0), overlay(), { order: 13 });
    this.tips = new Marks(new ConeGeometry(1, 1, 10).translate(0, 0.5, 0), overlay(), { order: 13 });
    this.object = this.dots.object;
    this.object.add(this.sticks.object, this.tips.object);
  }

  update() {
    const { replay, dots, sticks, tips, size } = this,
      { sections } = replay;
    const points = sections['contacts/point'],
      normals = sections['contacts/normal'],
      ids = sections['contacts/id'];
    for (const marks of [dots, sticks, tips]) marks.clear();
    for (let row = replay.first('contacts'), end = replay.first('contacts', 1); row < end; ++row) {
      const i = row * 3,
        rgb = idColour(ids ? ids[row] : 0),
        x = points[i],
        y = points[i + 1],
        z = points[i + 2];
      const dot = dots.next();
      writeScaled(dots.matrices, dot * 16, x, y, z, size, size, size);
      dots.colour(dot, rgb);
      if (!normals) continue;
      const nx = normals[i] * size,
        ny = normals[i + 1] * size,
        nz = normals[i + 2] * size,
        stick = sticks.next(),
        tip = tips.next();
      writeAlong(sticks.matrices, stick * 16, x, y, z, nx * 5, ny * 5, nz * 5, size * 0.3);
      writeAlong(tips.matrices, tip * 16, x + nx * 5, y + ny * 5, z + nz * 5, nx * 2, ny * 2, nz * 2, size * 0.8);
      sticks.colour(stick, rgb);
      tips.colour(tip, rgb);
    }
    for (const marks of [dots, sticks, tips]) marks.flush();
  }

  dispose() {
    for (const marks of [this.dots, this.sticks, this.tips]) marks.dispose();
  }
}
