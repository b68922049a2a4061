// Many equal marks (dots, sticks, boxes) drawn in one call, refilled every frame; the store grows by doubling.
import { DynamicDrawUsage, Group, InstancedBufferAttribute, InstancedMesh, LineSegments } from 'three';

const kFirst = 256;

export class Marks {
  /** lines: the geometry is line segments. order: later is drawn over earlier. */
  constructor(geometry, material, { lines = false, order = 10 } = {}) {
    this.geometry = geometry;
    this.material = material;
    this.lines = lines;
    this.order = order;
    this.object = new Group();
    this.count = 0;
    this.reserve(kFirst);
  }

  reserve(capacity) {
    const old = this.mesh;
    const mesh = new InstancedMesh(this.geometry, this.material, capacity);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(capacity * 3), 3).setUsage(DynamicDrawUsage);
    if (old) {
      mesh.instanceMatrix.array.set(old.instanceMatrix.array);
      mesh.instanceColor.array.set(old.instanceColor.array);
      this.object.clear();
      old.dispose();
    }
    this.mesh = mesh;
    this.capacity = capacity;
    this.drawn = mesh;
    if (this.lines) {
      this.drawn = new LineSegments(this.geometry, this.material);
      Object.assign(this.drawn, {
        isInstancedMesh: true,
        instanceMatrix: mesh.instanceMatrix,
        instanceColor: mesh.instanceColor,
        morphTexture: null,
      });
    }
    this.drawn.frustumCulled = false;
    this.drawn.renderOrder = this.order;
    this.object.add(this.drawn);
  }

  clear() {
    this.count = 0;
  }

  /** Room for one more; fill matrices from 16 times the number, colours from 3 times. */
  next() {
    if (this.count === this.capacity) this.reserve(2 * this.capacity);
    return this.count++;
  }

  get matrices() {
    return this.mesh.instanceMatrix.array;
  }
  get colours() {
    return this.mesh.instanceColor.array;
  }

  colour(mark, rgb) {
    for (let i = 0; i < 3; ++i) this.colours[mark * 3 + i] = rgb[i];
  }

  flush() {
    this.drawn.count = this.count;
    this.drawn.visible = this.count > 0;
    const { instanceMatrix, instanceColor } = this.mesh;
    for (const [attribute, width] of [
      [instanceMatrix, 16],
      [instanceColor, 3],
    ]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, this.count * width);
      attribute.needsUpdate = true;
    }
  }

  dispose() {
    this.geometry.dispose();
    this.material.dispose();
    this.mesh.dispose();
  }
}

/** A mark moved and scaled along the world's axes. */
export function writeScaled(out, offset, x, y, z, sx, sy, sz) {
  out.fill(0, offset, offset + 16);
  out[offset] = sx;
  out[offset + 5] = sy;
  out[offset + 10] = sz;
  out[offset + 12] = x;
  out[offset + 13] = y;
  out[offset + 14] = z;
  out[offset + 15] = 1;
}

/** A mark whose y axis is (dx, dy, dz), length included, with the given width across, its origin at (x, y, z). */
export function writeAlong(out, offset, x, y, z, dx, dy, dz, width) {
  const length = Math.hypot(dx, dy, dz) || 1e-12,
    ux = dx / length,
    uy = dy / length,
    uz = dz / length;
  // Across the axis: the cross product with the world's axis that is least along it.
  let ax = 0,
    ay = 0,
    az = 0;
  if (Math.abs(ux) < 0.6) {
    ay = uz;
    az = -uy;
  } else {
    ax = -uz;
    az = ux;
  }
  const a = Math.hypot(ax, ay, az) || 1;
  ax /= a;
  ay /= a;
  az /= a;
  out[offset] = ax * width;
  out[offset + 1] = ay * width;
  out[offset + 2] = az * width;
  out[offset + 3] = 0;
  out[offset + 4] = dx;
  out[offset + 5] = dy;
  out[offset + 6] = dz;
  out[offset + 7] = 0;
  out[offset + 8] = (ay * uz - az * uy) * width;
  out[offset + 9] = (az * ux - ax * uz) * width;
  out[offset + 10] = (ax * uy - ay * ux) * width;
  out[offset + 11] = 0;
  out[offset + 12] = x;
  out[offset + 13] = y;
  out[offset + 14] = z;
  out[offset + 15] = 1;
}

/** The same from (x, y, z) to the three numbers of `places` that begin at `first`. */
export function writeToPlace(out, offset, x, y, z, places, first, width) {
  writeAlong(out, offset, x, y, z, places[first] - x, places[first + 1] - y, places[first + 2] - z, width);
}
