// Bodies: made and ended, their motion type and their shape. A living body becomes another by World.modifyBody.
const kStatic = 0, kAnimated = 1;
const kMotion = ['static', 'kinematic', 'dynamic'];
const kAlwaysActive = 1, kAlwaysInactive = 2;
/** Of what has no shape. */
const kUnitMass = { mass: 1, inertia: [1, 1, 1] };

export const bodies = {
  _spawn(data, frame) {
    const asleep = this._sleeping && data.body.startAsleep && data.motion !== kStatic ? ['asleep'] : [];
    data.handle = this.world.createBody({ ...frame, ...kUnitMass, motion: kMotion[data.motion],
      angularDamping: data.angularDamping, flags: [...this._flags, ...asleep] });
    this._owners.set(data.handle, data);
  },
  _remove(data) {
    if (data.handle === 0n) return;
    for (const joint of [...data.joints]) this._dropJoint(joint);
    data.shape?.users.delete(data);
    this.world.destroyBody(data.handle);
    this._owners.delete(data.handle);
    data.handle = 0n;
  },
  /** disposeBody follows; here it leaves the world. */
  removeBody(body) {
    for (const data of body._pluginDataInstances) this._remove(data);
    if (body._pluginData) this._remove(body._pluginData);
  },
  disposeBody(body) {
    this.removeBody(body);
    for (const map of Object.values(this._observables)) {
      map.get(body)?.clear();
      map.delete(body);
    }
  },

  setShape(body, shape) {
    this._each(body, undefined, (data) => {
      data.shape?.users.delete(data);
      data.shape = shape?._pluginData ?? null;
      data.shape?.users.add(data);
      this._applyShape(data);
    });
  },
  getShape(body) {
    return this._one(body)?.shape?.shape ?? null;
  },
  /** Shape, mass, material, filter and flags of one body, as its shape has them now. */
  _applyShape(data) {
    const { shape, handle } = data;
    this.world.modifyBody(handle, { motion: this._motionOf(data), shape: shape ? this._handleOf(shape) : 0n,
      flags: this._flagsOf(data), ...this._massOf(data) });
    if (shape) this._applySurface(data);
  },
  _applySurface({ handle, shape }) {
    const { friction, restitution } = this._materialOf(shape), { membership, collide } = this._masksOf(shape);
    this.world.write('material', handle, [friction, restitution]);
    this.world.write('filter', handle, [membership >>> 0, collide >>> 0, 0]);
  },
  _flagsOf(data) {
    return [...this._flags, ...(data.shape && this._isTrigger(data.shape) ? ['sensor'] : []),
      ...(this._turns(data) ? [] : ['noRotation'])];
  },
  /** What has infinite mass is moved by nothing. */
  _motionOf(data) {
    const infinite = data.mass?.mass === 0 && data.motion !== kStatic;
    return infinite ? kMotion[kAnimated] : kMotion[data.motion];
  },

  setMotionType(body, motionType, instanceIndex) {
    this._each(body, instanceIndex, (data) => {
      if (data.motion === motionType) return;
      const velocity = this.world.read('velocity', [data.handle]);
      data.motion = motionType;
      this._applyShape(data);
      if (motionType !== kStatic) this.world.write('velocity', data.handle, velocity);
    });
  },
  getMotionType(body, instanceIndex) {
    return this._one(body, instanceIndex).motion;
  },
  setActivationControl(body, mode) {
    if (!this._sleeping) return;
    this._each(body, undefined, (data) => {
      this.world.modifyBody(data.handle,
        { flags: [...this._flagsOf(data), ...(mode === kAlwaysActive ? ['neverSleeps'] : [])], ...this._massOf(data) });
      this.world.write('awake', data.handle, [mode === kAlwaysInactive ? 0 : 1]);
    });
  },
};
