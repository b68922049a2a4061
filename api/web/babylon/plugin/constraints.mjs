// Constraints: each is six axes with modes, limits, motors and frictions, for every pair of bodies that it joins; the
// engine's joint follows from them (joint_of.mjs).
import { axesOf, jointsOf } from './joint_of.mjs';

export const constraints = {
  initConstraint(constraint, body, childBody, instanceIndex, childInstanceIndex) {
    this._constraints.add(constraint);
    constraint._pluginData ??= { axes: axesOf(constraint), enabled: true,
      collisions: constraint.options.collision ?? false, links: [] };
    const link = { constraint, a: this._one(body, instanceIndex), b: this._one(childBody, childInstanceIndex),
      joints: [] };
    constraint._pluginData.links.push(link);
    link.a.joints.add(link);
    link.b.joints.add(link);
    this._link(link);
  },
  addConstraint(body, childBody, constraint, instanceIndex, childInstanceIndex) {
    this.initConstraint(constraint, body, childBody, instanceIndex, childInstanceIndex);
  },
  disposeConstraint(constraint) {
    for (const link of [...(constraint._pluginData?.links ?? [])]) this._dropJoint(link);
    this._constraints.delete(constraint);
  },
  getBodiesUsingConstraint(constraint) {
    return (constraint._pluginData?.links ?? []).map(({ a, b }) =>
      ({ parentBody: a.body, parentBodyIndex: a.index, childBody: b.body, childBodyIndex: b.index }));
  },

  /** Makes the joints of a link, or changes those that it has where they stay of their type. */
  _link(link) {
    const { axes, enabled, collisions } = link.constraint._pluginData;
    const wanted = jointsOf(link.constraint, axes, (sentence) => this._warn(sentence));
    const same = wanted.length === link.joints.length && wanted.every(({ type }, i) => type === link.joints[i].type);
    if (same) wanted.forEach(({ type: _, frameA: __, frameB: ___, ...row }, i) =>
      this.world.modifyJoint(link.joints[i].handle, { ...row, enabled, collideConnected: collisions }));
    else {
      this._unlink(link);
      link.joints = wanted.map((joint) => ({ type: joint.type, handle: this.world.createJoint(
        { ...joint, a: link.a.handle, b: link.b.handle, collideConnected: collisions }) }));
      if (!enabled) for (const { handle } of link.joints) this.world.modifyJoint(handle, { enabled });
    }
  },
  _unlink(link) {
    if (link.joints.length > 0) this.world.destroyJoint(...link.joints.map(({ handle }) => handle));
    link.joints = [];
  },
  _dropJoint(link) {
    this._unlink(link);
    link.a.joints.delete(link);
    link.b.joints.delete(link);
    const { links } = link.constraint._pluginData;
    links.splice(links.indexOf(link), 1);
  },
  _refresh(constraint) {
    for (const link of constraint._pluginData.links) this._link(link);
  },

  setEnabled(constraint, isEnabled) {
    constraint._pluginData.enabled = isEnabled;
    this._refresh(constraint);
  },
  getEnabled(constraint) {
    return constraint._pluginData.enabled;
  },
  setCollisionsEnabled(constraint, isEnabled) {
    constraint._pluginData.collisions = isEnabled;
    this._refresh(constraint);
  },
  getCollisionsEnabled(constraint) {
    return constraint._pluginData.collisions;
  },
};

/** setAxisMode and the like: a member of an axis. */
const members = { Friction: 'friction', Mode: 'mode', MinLimit: 'min', MaxLimit: 'max', MotorType: 'motorType',
  MotorTarget: 'target', MotorMaxForce: 'maxForce' };
for (const [name, member] of Object.entries(members)) {
  constraints[`setAxis${name}`] = function set(constraint, axis, value) {
    constraint._pluginData.axes[axis][member] = value;
    this._refresh(constraint);
  };
  constraints[`getAxis${name}`] = function get(constraint, axis) {
    return constraint._pluginData?.axes[axis][member] ?? null;
  };
}
