// The same scene on two engines, without a picture: this one, and Havok as Babylon.js has it.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { NullEngine } from '@babylonjs/core/Engines/nullEngine.js';
import { Logger } from '@babylonjs/core/Misc/logger.js';
import { Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import { HavokPlugin } from '@babylonjs/core/Physics/v2/Plugins/havokPlugin.js';
import { PhysicsBody } from '@babylonjs/core/Physics/v2/physicsBody.js';
import { PhysicsShapeBox, PhysicsShapeSphere } from '@babylonjs/core/Physics/v2/physicsShape.js';
import '@babylonjs/core/Physics/v2/physicsEngineComponent.js';
import '@babylonjs/core/Physics/joinedPhysicsEngineComponent.js';
import { Scene } from '@babylonjs/core/scene.js';
import HavokPhysics from '@babylonjs/havok';
import { PlumbPlugin } from '../plumb_plugin.mjs';

Logger.LogLevels = Logger.ErrorLogLevel;
const folder = pathToFileURL(`${process.env.PLUMB_WEB}/`);
const { load } = await import(new URL('plumb.mjs', folder));
export const engine = await load();
const wasmBinary = readFileSync(createRequire(import.meta.url).resolve('@babylonjs/havok/lib/esm/HavokPhysics.wasm'));
const havok = await HavokPhysics({ wasmBinary });

export const kStep = 1 / 60;
export const STATIC = 0, ANIMATED = 1, DYNAMIC = 2;
export const plugins = { plumb: (options) => new PlumbPlugin(engine, options), havok: () => new HavokPlugin(true, havok) };

export class Stage {
  constructor(name, gravity = -9.81, options = {}) {
    const picture = new NullEngine();
    picture.getCaps().instancedArrays = true; // thin instances are refused without
    this.scene = new Scene(picture);
    this.scene.enablePhysics(new Vector3(0, gravity, 0), plugins[name](options));
    this.physics = this.scene.getPhysicsEngine();
    this.plugin = this.physics.getPhysicsPlugin();
  }
  box(x = 1, y = 1, z = 1) {
    return new PhysicsShapeBox(Vector3.Zero(), Quaternion.Identity(), new Vector3(x, y, z), this.scene);
  }
  ball(radius = 0.5) {
    return new PhysicsShapeSphere(Vector3.Zero(), radius, this.scene);
  }
  body(shape, [x, y, z], motion = DYNAMIC) {
    const node = new TransformNode('', this.scene);
    node.position.set(x, y, z);
    const body = new PhysicsBody(node, motion, false, this.scene);
    body.shape = shape;
    return body;
  }
  ground() {
    return this.body(this.box(100, 1, 100), [0, -0.5, 0], STATIC);
  }
  run(seconds, each = () => {}) {
    for (let i = 0; i < Math.round(seconds / kStep); ++i) {
      each(i);
      this.physics._step(kStep);
    }
  }
  end() {
    this.scene.dispose();
  }
}

/** The same measure of both. */
export function both(measure, gravity) {
  return Object.keys(plugins).map((name) => {
    const stage = new Stage(name, gravity);
    try {
      return measure(stage, name);
    } finally {
      stage.end();
    }
  });
}
