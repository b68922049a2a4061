// A bar of a round length, as long as that length looks at the point that the camera turns about.
import { element } from './basics/dom.js';
import { roundStep } from './basics/materials.js';
import { quantity } from './data/quantity.js';

const kWanted = 90; // pixels, about

/** Metres that a pixel covers at a distance from the camera, in a port of the given height. */
export const metresOfPixel = (camera, distance, height) =>
  (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / Math.max(height, 1);

export class ScaleBar {
  constructor() {
    this.bar = element('i', {});
    this.text = element('span', {});
    this.element = element(
      'div',
      { class: 'pv-scale-bar', title: 'at the point that the camera turns about' },
      this.bar,
      this.text,
    );
  }

  /** grid: metres between the lines of a reference grid, or null. */
  update(camera, distance, height, grid) {
    const pixel = metresOfPixel(camera, distance, height),
      length = roundStep(pixel * kWanted);
    if (!(length > 0) || !Number.isFinite(length)) return;
    this.length = length;
    this.bar.style.width = `${(length / pixel).toFixed(1)}px`;
    const text = quantity(length, 'm').replace(/\.0+ /, ' ');
    this.text.textContent = grid ? `${text}; grid ${quantity(grid, 'm').replace(/\.0+ /, ' ')}, no ground` : text;
  }
}
