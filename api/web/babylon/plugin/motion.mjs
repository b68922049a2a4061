// Velocities, damping, gravity factor, impulses, forces, and where bodies are put.
import { rowOf, toVector, frameOf } from './values.mjs';
import { instanceMatrix } from './instances.mjs';
import { Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';

const kStatic = 0, kAnimated = 1, kDynamic = 2;
const kAction = 2;

export const motion = {
  setLinearVelocity(body, velocity, instanceIndex) {
    this._setVelocity(body, instanceIndex, 0, rowOf(velocity));
  },
  setAngularVelocity(body, velocity, instanceIndex) {
    this._setVelocity(body, instanceIndex, 3, rowOf(velocity));
  },
  _setVelocity(body, instanceIndex, from, values) {
    this._each(body, instanceIndex, (data) => {
      if (data.motion === kStatic) return;
      const row = this.world.read('velocity', [data.handle]);
      row.set(values, from);
      this.world.write('velocity', data.handle, row);
      this._wake(data);
    });
  },
  getLinearVelocityToRef(body, velocity, instanceIndex) {
    toVector(this.world.read('velocity', [this._one(body, instanceIndex).handle]), velocity);
  },
  getAngularVelocityToRef(body, velocity, instanceIndex) {
    toVector(this.world.read('velocity', [this._one(body, instanceIndex).handle]).slice(3), velocity);
  },

  setLinearDamping(body, damping, instanceIndex) {
    this._setDamping(body, instanceIndex, { linearDamping: damping });
  },
  getLinearDamping(body, instanceIndex) {
    return this._one(body, instanceIndex).linearDamping;
  },
  setAngularDamping(body, damping, instanceIndex) {
    this._setDamping(body, instanceIndex, { angularDamping: damping });
  },
  getAngularDamping(body, instanceIndex) {
    return this._one(body, instanceIndex).angularDamping;
  },
  _setDamping(body, instanceIndex, given) {
    this._each(body, instanceIndex, (data) => {
      Object.assign(data, given);
      this.world.write('damping', data.handle, [data.linearDamping, data.angularDamping]);
    });
  },
  setGravityFactor(body, factor, instanceIndex) {
    this._each(body, instanceIndex, (data) => {
      data.gravityFactor = factor;
      this.world.write('gravityScale', data.handle, [factor]);
      this._wake(data);
    });
  },
  getGravityFactor(body, instanceIndex) {
    return this._one(body, instanceIndex).gravityFactor;
  },

  /** location: a point of the world. */
  applyImpulse(body, impulse, location, instanceIndex) {
    this._push('impulseAtPoint', body, instanceIndex, [...rowOf(impulse), ...rowOf(location)]);
  },
  applyAngularImpulse(body, impulse, instanceIndex) {
    this._push('angularImpulse', body, instanceIndex, rowOf(impulse));
  },
  applyForce(body, force, location, instanceIndex) {
    this._push('forceAtPoint', body, instanceIndex, [...rowOf(force), ...rowOf(location)]);
  },
  applyTorque(body, torque, instanceIndex) {
    this._push('torque', body, instanceIndex, rowOf(torque));
  },
  _push(field, body, instanceIndex, row) {
    this._each(body, instanceIndex, (data) => {
      if (this._motionOf(data) !== 'dynamic') return;
      this._wake(data);
      this.world.write(field, data.handle, row);
    });
  },
  _wake(data) {
    if (this._sleeping && data.motion === kDynamic) this.world.write('awake', data.handle, [1]);
  },

  /** An animated body is there after the next step, and stands still after that one without another target. */
  setTargetTransform(body, position, rotation, instanceIndex) {
    const { position: p, orientation: q } = frameOf(position, rotation);
    this._each(body, instanceIndex, (data) => {
      const animated = data.motion === kAnimated;
      this.world.write(animated ? 'kinematicTarget' : 'pose', data.handle, [...p, ...q]);
    });
  },
  /** Before a step: the body follows its transform node, as the body's prestep type says. */
  setPhysicsBodyTransformation(body, node) {
    const action = body.getPrestepType() === kAction;
    const place = (data, position, rotation) => {
      const { position: p, orientation: q } = frameOf(position, rotation);
      const field = action && data.motion === kAnimated ? 'kinematicTarget' : 'pose';
      this.world.write(field, data.handle, [...p, ...q]);
    };
    if (body._pluginDataInstances.length === 0) {
      node.computeWorldMatrix(true);
      place(body._pluginData, node.absolutePosition, node.absoluteRotationQuaternion);
      return;
    }
    const scale = new Vector3(), rotation = new Quaternion(), position = new Vector3();
    for (const data of body._pluginDataInstances) {
      instanceMatrix(node, data.index).decompose(scale, rotation, position);
      place(data, position, rotation);
    }
  },
};
