// The engine behind Babylon.js's second physics interface: scene.enablePhysics(gravity, new PlumbPlugin(engine)).
// engine: what load() of @plumb/engine gave. Each part of the interface is a file in plugin/.
import { Observable } from '@babylonjs/core/Misc/observable.js';
import { bodies } from './plugin/bodies.mjs';
import { constraints } from './plugin/constraints.mjs';
import { events } from './plugin/events.mjs';
import { geometry } from './plugin/geometry.mjs';
import { instances } from './plugin/instances.mjs';
import { mass } from './plugin/mass.mjs';
import { motion } from './plugin/motion.mjs';
import { proximity } from './plugin/proximity.mjs';
import { queries } from './plugin/queries.mjs';
import { shapes } from './plugin/shapes.mjs';
import { steps } from './plugin/steps.mjs';

const kNeeds = ['rotation', 'collision', 'friction', 'restitution', 'joints', 'events', 'contacts', 'contactImpulses',
  'sensors', 'kinematic', 'gyroscopic', 'damping', 'forces', 'filters', 'queries'];

export class PlumbPlugin {
  name = 'PlumbPlugin';
  onCollisionObservable = new Observable();
  onCollisionEndedObservable = new Observable();
  onTriggerCollisionObservable = new Observable();

  /** Whose body a handle is: { body, index, ... } of instances.mjs. */
  _owners = new Map();
  _touching = new Map();
  _observables = { begun: new Map(), ended: new Map() };
  _constraints = new Set();
  _shapes = new Set();
  _warned = new Set();
  _timeStep = 1 / 60;
  _maxLinearVelocity = Infinity;
  _maxAngularVelocity = Infinity;

  constructor(engine, { useDeltaForWorldStep = true, sleeping = true, ccd = false, settings = {} } = {}) {
    const needs = [...kNeeds, ...(sleeping ? ['sleeping'] : []), ...(ccd ? ['ccd'] : [])];
    this._flags = ccd ? ['ccd'] : [];
    this._sleeping = sleeping;
    this._useDelta = useDeltaForWorldStep;
    this.world = engine.createWorld({ needs, settings });
  }
  getPluginVersion() {
    return 2;
  }
  isSupported() {
    return true;
  }
  /** What a page still holds of it can be disposed of later. */
  dispose() {
    this.world.destroy();
    for (const data of this._owners.values()) data.handle = 0n;
    for (const { _pluginData } of this._constraints) for (const link of _pluginData.links) link.joints = [];
    for (const shape of this._shapes) Object.assign(shape, { handle: 0n, parts: [] });
    this._owners.clear();
  }
  /** What the engine cannot do as asked, once a sentence. */
  _warn(sentence) {
    if (!this._warned.has(sentence)) console.warn(`PlumbPlugin: ${sentence}`);
    this._warned.add(sentence);
  }
}
Object.assign(PlumbPlugin.prototype, bodies, constraints, events, geometry, instances, mass, motion, proximity, queries,
  shapes, steps);
