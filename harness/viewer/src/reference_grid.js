// Lines for scale under a scene that has no ground: no surface, no shadow, nothing that a body could lie on.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from 'three';
import { shapeRadius } from './basics/shapes.js';

const kReach = 4; // radii of what happens
const kMostLines = 41; // either way
const kGroundShapes = new Set(['plane', 'mesh', 'height_field']);
const kLarge = 0.8; // of the radius of what happens: what stands still and is as large holds the scene

/** Whether something stands there on which the eye can measure. */
export function hasGround(replay, frame) {
  const { shapes } = replay.header;
  return replay.bodies.some((body, i) => {
    const shape = shapes[body.shape];
    if (replay.moves(i) || !shape) return false;
    return kGroundShapes.has(shape.type) || shapeRadius(shape, shapes) > kLarge * frame.radius;
  });
}

export class ReferenceGrid {
  constructor({ centre, half, radius }, step) {
    this.step = step;
    const count = Math.min(kMostLines, 2 * Math.ceil((kReach * radius) / step) + 1),
      first = -(count - 1) / 2;
    const y = Math.floor((centre.y - half.y) / step) * step,
      x0 = Math.round(centre.x / step) * step,
      z0 = Math.round(centre.z / step) * step,
      reach = ((count - 1) / 2) * step;
    const points = [],
      colours = [];
    // Each line in pieces, for it fades towards its ends.
    const fade = (x, z) => Math.max(0, 1 - Math.hypot(x - x0, z - z0) / reach) ** 1.5;
    const point = (x, z) => {
      points.push(x, y, z);
      colours.push(1, 1, 1, fade(x, z));
    };
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k + 1 < count; ++k) {
        const across = (first + i) * step,
          from = (first + k) * step;
        point(x0 + across, z0 + from);
        point(x0 + across, z0 + from + step);
        point(x0 + from, z0 + across);
        point(x0 + from + step, z0 + across);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 4));
    this.object = new LineSegments(
      geometry,
      new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }),
    );
    this.object.raycast = () => {};
  }

  paint(theme) {
    this.object.material.color.copy(theme.gridLine).lerp(theme.ink, theme.dark ? 0.05 : 0.25);
  }

  dispose() {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
