// Gravity, the step, and what follows it: transform nodes and events.
import { rowOf } from './values.mjs';

const kPose = 7, kVelocity = 6;

export const steps = {
  setGravity(gravity) {
    this._gravity = rowOf(gravity);
    this.world.setGravity(this._gravity);
  },
  setTimeStep(timeStep) {
    this._timeStep = timeStep;
  },
  getTimeStep() {
    return this._timeStep;
  },
  setVelocityLimits(maxLinearVelocity, maxAngularVelocity) {
    this._maxLinearVelocity = maxLinearVelocity;
    this._maxAngularVelocity = maxAngularVelocity;
  },
  getMaxLinearVelocity() {
    return this._maxLinearVelocity;
  },
  getMaxAngularVelocity() {
    return this._maxAngularVelocity;
  },
  executeStep(delta, physicsBodies) {
    for (const body of physicsBodies)
      if (!body.disablePreStep) this.setPhysicsBodyTransformation(body, body.transformNode);
    this.world.step(this._useDelta ? delta : this._timeStep);
    this._boundVelocities();
    const moving = physicsBodies.filter((body) => !body.disableSync);
    this._readPoses(moving);
    for (const body of moving) this.sync(body);
    this._poses = null;
    this._tellEvents();
  },
  /** All in one call. */
  _readPoses(list) {
    const all = list.flatMap((body) => body._pluginDataInstances.length > 0 ? body._pluginDataInstances
      : [body._pluginData]);
    const rows = this.world.read('pose', all.map((data) => data.handle));
    this._poses = new Map(all.map((data, i) => [data, rows.subarray(i * kPose, (i + 1) * kPose)]));
  },
  _poseOf(data) {
    return this._poses?.get(data) ?? this.world.read('pose', [data.handle]);
  },
  /** The engine has no largest velocity of its own: without limits nothing is done. */
  _boundVelocities() {
    if (this._maxLinearVelocity === Infinity && this._maxAngularVelocity === Infinity) return;
    const handles = [...this._owners.keys()], rows = this.world.read('velocity', handles);
    handles.forEach((handle, i) => {
      const row = rows.subarray(i * kVelocity, (i + 1) * kVelocity);
      const over = (from, most) => Math.hypot(...row.subarray(from, from + 3)) / most;
      const linear = over(0, this._maxLinearVelocity), angular = over(3, this._maxAngularVelocity);
      if (linear <= 1 && angular <= 1) return;
      this.world.write('velocity', handle,
        row.map((v, axis) => v / Math.max(1, axis < 3 ? linear : angular)));
    });
  },
};
