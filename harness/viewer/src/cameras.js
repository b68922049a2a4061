// One camera for all views: turning it in one turns it in all.
import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { placeCamera } from './framing.js';

export class Cameras {
  constructor(changed) {
    this.camera = new PerspectiveCamera(32, 1, 0.01, 1000);
    this.target = new Vector3();
    this.controls = [];
    this.changed = changed;
    this.zooms = false;
    this.moved = false; // by the reader, so a change of size does not frame anew
  }

  attach(port) {
    const controls = new OrbitControls(this.camera, port);
    controls.target = this.target;
    controls.enableZoom = this.zooms;
    controls.zoomToCursor = false;
    controls.minPolarAngle = 0.02;
    controls.addEventListener('start', () => {
      this.moved = true;
    });
    controls.addEventListener('change', this.changed);
    port.style.touchAction = this.zooms ? 'none' : 'pan-y'; // a finger that goes up or down scrolls the page
    this.controls.push(controls);
  }

  detach() {
    for (const controls of this.controls) controls.dispose();
    this.controls = [];
  }

  /** The wheel zooms only once the viewer has been taken in hand: before that it scrolls the page. */
  allowZoom(on) {
    if (this.zooms === on) return;
    this.zooms = on;
    for (const controls of this.controls) controls.enableZoom = on;
  }

  frame(framing, aspect) {
    this.camera.aspect = aspect;
    placeCamera(this.camera, this.target, framing);
    this.moved = false;
    this.sync();
  }

  /** Follows a change of the views' shape; frames anew unless the reader has moved the camera. */
  fit(framing, aspect) {
    if (!this.moved && Math.abs(aspect - this.camera.aspect) > 1e-3) this.frame(framing, aspect);
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Turns by angles and moves nearer by a factor: for the keyboard. */
  turn(azimuth, polar, zoom = 1) {
    const offset = this.camera.position.clone().sub(this.target),
      up = new Vector3(0, 1, 0);
    offset.applyAxisAngle(up, azimuth);
    const angle = Math.min(Math.max(offset.angleTo(up) + polar, 0.02), Math.PI - 0.02) - offset.angleTo(up);
    offset.applyAxisAngle(new Vector3().crossVectors(up, offset).normalize(), angle).multiplyScalar(zoom);
    this.camera.position.copy(this.target).add(offset);
    this.moved = true;
    this.sync();
  }

  /** Moves camera and target alike. */
  move(offset) {
    this.target.add(offset);
    this.camera.position.add(offset);
    this.moved = true;
    this.sync();
  }

  /** The camera that stands so far from the shared one. */
  shifted(offset) {
    if (offset.lengthSq() === 0) return this.camera;
    this.other ??= this.camera.clone();
    this.other.copy(this.camera);
    this.other.position.add(offset);
    this.other.updateMatrixWorld();
    return this.other;
  }

  /** From the camera to what it turns about. */
  get distance() {
    return this.camera.position.distanceTo(this.target);
  }

  sync() {
    this.camera.lookAt(this.target);
    for (const controls of this.controls) controls.update();
    this.changed();
  }
}
