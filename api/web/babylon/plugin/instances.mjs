// A body of Babylon.js is one body of the engine, or one for each thin instance of its mesh: here is which.
import { Matrix, Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { frameOf } from './values.mjs';

/** What the plugin knows of one body of the engine. mass: null until a page sets it. */
function record(body, index, motion) {
  return { body, index, motion, handle: 0n, mass: null, eventMask: 0, linearDamping: 0, angularDamping: 0.1,
    gravityFactor: 1, joints: new Set() };
}

export const instances = {
  initBody(body, motionType, position, orientation) {
    body._pluginData = record(body, undefined, motionType);
    this._spawn(body._pluginData, frameOf(position, orientation));
  },
  initBodyInstances(body, motionType, mesh) {
    this._matchInstances(body, motionType, mesh);
  },
  updateBodyInstances(body, mesh) {
    const motionType = body._pluginDataInstances[0]?.motion ?? 0;
    this._matchInstances(body, motionType, mesh);
    for (const one of body._pluginDataInstances) this._applyShape(one);
  },
  _matchInstances(body, motionType, mesh) {
    const count = mesh._thinInstanceDataStorage?.instancesCount ?? 0, all = body._pluginDataInstances;
    while (all.length > count) this._remove(all.pop());
    const scale = new Vector3(), rotation = new Quaternion(), position = new Vector3();
    for (let i = all.length; i < count; ++i) {
      instanceMatrix(mesh, i).decompose(scale, rotation, position);
      all.push(record(body, i, motionType));
      this._spawn(all[i], frameOf(position, rotation));
    }
  },

  /** The one of an index, of the single body, or of the first instance. */
  _one(body, instanceIndex) {
    return body._pluginDataInstances.length > 0 ? body._pluginDataInstances[instanceIndex ?? 0] : body._pluginData;
  },
  /** Those that a call is for: without an index all. */
  _each(body, instanceIndex, call) {
    const all = body._pluginDataInstances;
    if (all.length > 0 && instanceIndex === undefined) all.forEach(call);
    else call(this._one(body, instanceIndex));
  },

  /** The transform node follows the body. */
  sync(body) {
    this.syncTransform(body, body.transformNode);
  },
  syncTransform(body, node) {
    const all = body._pluginDataInstances;
    if (all.length > 0) this._syncInstances(all, node);
    else this._syncNode(this._poseOf(body._pluginData), node);
  },
  _syncInstances(all, mesh) {
    const storage = mesh._thinInstanceDataStorage, one = new Matrix(), scale = new Vector3();
    for (const data of all) {
      const [x, y, z, ...turn] = this._poseOf(data);
      Matrix.FromArrayToRef(storage.matrixData, 16 * data.index, one);
      one.decompose(scale, undefined, undefined);
      Matrix.ComposeToRef(scale, new Quaternion(...turn), new Vector3(x, y, z), one);
      one.copyToArray(storage.matrixData, 16 * data.index);
    }
    mesh.thinInstanceBufferUpdated('matrix');
  },
  _syncNode([x, y, z, ...turn], node) {
    const position = new Vector3(x, y, z), rotation = new Quaternion(...turn);
    if (node.parent && !node.parent.getWorldMatrix().isIdentity()) {
      const toParent = Matrix.Invert(node.parent.computeWorldMatrix(true)), scale = node.absoluteScaling.clone();
      Matrix.Compose(scale, rotation, position).multiply(toParent).decompose(node.scaling, rotation, position);
    }
    node.position.copyFrom(position);
    if (node.rotationQuaternion) node.rotationQuaternion.copyFrom(rotation);
    else rotation.toEulerAnglesToRef(node.rotation);
  },
};

export function instanceMatrix(mesh, index) {
  return Matrix.FromArray(mesh._thinInstanceDataStorage.matrixData, 16 * index).multiply(mesh.getWorldMatrix());
}
