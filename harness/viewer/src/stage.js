// The canvas behind all views: one renderer, a window of it for each view.
import { PCFShadowMap, WebGLRenderer } from 'three';
import { element } from './basics/dom.js';

const kShadowBodies = 3000; // in all views together: beyond, the shadows cost more than they show
const kMostPixels = 2; // of the canvas to one of the page

export class Stage {
  constructor() {
    this.canvas = element('canvas', { class: 'pv-canvas', 'aria-hidden': 'true' });
    this.element = element('div', { class: 'pv-stage' }, this.canvas);
    this.gl = this.canvas.getContext('webgl2', { antialias: true, alpha: true, powerPreference: 'high-performance' });
    this.pixel = new Uint8Array(4);
  }

  start() {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context: this.gl, antialias: true, alpha: true });
    this.renderer.setScissorTest(true);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
  }

  /** Reads where the views lie; level: how much has been given up for speed. */
  layout(views, level) {
    const stage = this.element.getBoundingClientRect();
    this.renderer.setPixelRatio(level >= 2 ? 1 : Math.min(window.devicePixelRatio || 1, kMostPixels));
    this.renderer.setSize(Math.max(stage.width, 1), Math.max(stage.height, 1));
    let bodies = 0;
    for (const view of views) {
      const port = view.port.getBoundingClientRect();
      view.box = { x: port.left - stage.left, y: stage.bottom - port.bottom, width: port.width, height: port.height };
      if (!view.element.hidden) bodies += view.replay.bodies.length;
    }
    for (const { scene } of views) {
      scene.sun.castShadow = bodies <= kShadowBodies && level < 1;
      scene.bodies.showEdges(level < 3);
    }
  }

  draw({ scene, box }, camera) {
    if (!box || box.width < 1) return;
    this.renderer.setViewport(box.x, box.y, box.width, box.height);
    this.renderer.setScissor(box.x, box.y, box.width, box.height);
    this.renderer.render(scene.scene, camera);
  }

  /** Waits until everything is drawn. */
  finish() {
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, this.pixel);
  }
}
