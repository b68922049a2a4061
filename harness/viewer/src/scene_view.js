// The 3D scene of one replay: bodies, light, ground and whatever layers are switched on.
import { DirectionalLight, HemisphereLight, Raycaster, Scene, Vector3 } from 'three';
import { Bodies } from './bodies.js';
import { makeMaterials } from './basics/materials.js';
import { hasGround, ReferenceGrid } from './reference_grid.js';
import { Selection } from './selection.js';

const kSun = new Vector3(-0.42, 1, 0.62).normalize();
const kExtent = 12; // radius of the disc that stands for a plane, in radii of what happens

export class SceneView {
  constructor(replay, frame) {
    this.replay = replay;
    this.scene = new Scene();
    this.materials = makeMaterials(frame.radius, frame.centre);
    this.bodies = new Bodies(replay, this.materials, frame.radius * kExtent);
    this.markSize = frame.markSize;
    this.raycaster = new Raycaster();
    this.sky = new HemisphereLight(0xffffff, 0xffffff, 1);
    this.sun = new DirectionalLight(0xffffff, 1);
    this.aimSun(frame);
    this.selection = new Selection(replay, this.bodies);
    this.scene.add(this.bodies.object, this.sky, this.sun, this.sun.target, this.selection.object);
    if (replay.header.kind !== 'pairs' && !hasGround(replay, frame)) {
      this.grid = new ReferenceGrid(frame, this.materials.gridStep);
      this.scene.add(this.grid.object);
    }
    this.layers = new Map();
    this.shownFrame = -1;
  }

  aimSun({ centre, radius }) {
    const { sun } = this,
      reach = radius * 1.5;
    sun.target.position.copy(centre);
    sun.position
      .copy(kSun)
      .multiplyScalar(radius * 4)
      .add(centre);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    Object.assign(sun.shadow.camera, {
      left: -reach,
      right: reach,
      top: reach,
      bottom: -reach,
      near: radius * 0.5,
      far: radius * 8,
    });
    sun.shadow.normalBias = radius / 300;
    sun.shadow.radius = 3;
  }

  paint(theme) {
    this.theme = theme;
    this.scene.background = theme.background;
    this.sky.groundColor.copy(theme.ground).lerp(theme.ink, theme.dark ? 0.25 : 0.15);
    this.sky.intensity = theme.sky;
    this.sun.intensity = theme.sun;
    this.materials.paint(theme);
    this.selection.paint(theme);
    this.grid?.paint(theme);
  }

  /** Layers that draw: created when first switched on, kept for the next time. */
  setLayer(kind, on) {
    let layer = this.layers.get(kind.name);
    if (on && !layer && kind.Drawing) {
      layer = new kind.Drawing(this.replay, this.markSize, this.bodies);
      this.layers.set(kind.name, layer);
      this.scene.add(layer.object);
    }
    if (layer) layer.object.visible = on;
    this.shownFrame = -1;
  }

  /** Shows the time; colours (may be null) paints bodies that a layer colours. */
  update(time, colours, context) {
    const { replay } = this;
    replay.sample(time);
    this.bodies.update();
    this.selection.update();
    const isNew = replay.frame !== this.shownFrame;
    if (isNew) {
      this.shownFrame = replay.frame;
      if (colours || this.painted !== colours) this.bodies.paint(colours);
      this.painted = colours;
    }
    for (const layer of this.layers.values()) {
      if (layer.object.visible && (isNew || layer.constructor.follows)) layer.update(context);
    }
  }

  /** What is under the point, in -1..1 of the view: {body, distance, point}, or null. */
  hit(point, camera) {
    this.raycaster.setFromCamera(point, camera);
    return this.bodies.hit(this.raycaster);
  }

  /** The body under the point, or null. */
  pick(point, camera) {
    return this.hit(point, camera)?.body ?? null;
  }

  dispose() {
    this.bodies.dispose();
    this.materials.dispose();
    this.selection.dispose();
    this.grid?.dispose();
    for (const layer of this.layers.values()) layer.dispose();
    this.sun.shadow.map?.dispose();
  }
}
