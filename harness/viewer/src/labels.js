// Words beside places of a scene: a fixed store of elements in a view's port, put where the camera sees their places.
import { Vector3 } from 'three';
import { element } from './basics/dom.js';

const kRow = 15; // px: labels of one such row do not overlap
const kCharacter = 6.5; // px

export class Labels {
  constructor(port, most, className = '') {
    this.spans = Array.from({ length: most }, () => element('span', { class: `pv-label ${className}`, hidden: true }));
    port.append(...this.spans);
    this.port = port;
    this.at = new Vector3();
    this.used = 0;
  }

  begin(camera) {
    this.camera = camera;
    this.used = 0;
    this.rows = new Map();
    this.width = this.port.clientWidth;
    this.height = this.port.clientHeight;
  }

  get isFull() {
    return this.used === this.spans.length;
  }

  /** False where it cannot be seen, or would lie on another one. */
  add(text, x, y, z) {
    const at = this.at.set(x, y, z).project(this.camera);
    if (this.isFull || !(Math.abs(at.x) < 1 && Math.abs(at.y) < 1 && at.z < 1)) return false;
    const left = ((at.x + 1) / 2) * this.width + 7,
      top = ((1 - at.y) / 2) * this.height - 8,
      right = left + text.length * kCharacter + 6,
      row = Math.round(top / kRow);
    for (const near of [row - 1, row, row + 1]) {
      for (const [begin, end, y] of this.rows.get(near) ?? []) {
        if (left < end && right > begin && Math.abs(y - top) < kRow) return false;
      }
    }
    if (!this.rows.has(row)) this.rows.set(row, []);
    this.rows.get(row).push([left, right, top]);
    const span = this.spans[this.used++];
    span.hidden = false;
    if (span.textContent !== text) span.textContent = text;
    span.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    return true;
  }

  end() {
    for (let i = this.used; i < this.spans.length; ++i) this.spans[i].hidden = true;
  }
}
