// What joints push with in a sub-step, on their second body at its frame's origin: links by MuJoCo's inverse dynamics, the
// others by the forces of their constraints.
import { add, cross, length, rotate, scale, sub } from '../../algebra.mjs';
import { frameA, frameB } from './mass.mjs';
import { three } from './model.mjs';
import { equalitiesOf } from './text.mjs';

const EQUALITY = 0, TENDON_LIMIT = 4;  // as mjtConstraint counts
const NOTHING = [0, 0, 0];

function ofLink(model, child) {
  const told = model.d('cfrc_int'), torque = three(told, 6 * child.id), force = three(told, 6 * child.id + 3);  // on the child, about the centre of mass of its tree
  const { b, desc } = child.link, pose = model.poseOf(b), at = add(pose.position, rotate(pose.orientation, desc.frameB.position));
  const sign = child.reversed ? -1 : 1, arm = sub(three(model.d('subtree_com'), 3 * child.root), at);
  return [scale(sign, force), scale(sign, add(torque, cross(arm, force)))];
}

/** The first row of a kind of constraint that belongs to the thing; -1: none. */
const rowOf = ({ data, efc }, type, id) => {
  for (let row = 0; row < data.nefc; ++row) if (efc.type[row] === type && efc.id[row] === id) return row;
  return -1;
};

function ofRod(model, joint) {
  const { tendon: t, equality } = joint, long = model.d('ten_length')[t], range = model.m('tendon_range');
  const held = equality < 0 ? -1 : rowOf(model, EQUALITY, equality), stopped = rowOf(model, TENDON_LIMIT, t);
  let push = held < 0 ? 0 : model.efc.force[held];  // N that makes it longer
  if (stopped >= 0) push += (2 * long > range[2 * t] + range[2 * t + 1] ? -1 : 1) * model.efc.force[stopped];
  push -= model.m('tendon_stiffness')[t] * (long - model.m('tendon_lengthspring')[2 * t]) + model.m('tendon_damping')[t] * model.d('ten_velocity')[t];
  const way = sub(frameB(joint).position, frameA(joint).position), far = length(way);
  return [far > 0 ? scale(push / far, way) : NOTHING, NOTHING];
}

/** A connect's three rows push its first body; that of a hinge has a second a metre along the axis. */
function ofLoop(model, joint) {
  let force = NOTHING, torque = NOTHING;
  for (let i = 0; i < equalitiesOf(joint.desc); ++i) {
    const row = rowOf(model, EQUALITY, joint.equality + i);
    if (row < 0) continue;
    const onB = scale(-1, three(model.efc.force, row)), arm = i === 0 ? NOTHING : rotate(frameB(joint).orientation, [1, 0, 0]);
    force = add(force, onB);
    torque = add(torque, cross(arm, onB));
  }
  return [force, torque];
}

/** Adds the share of a sub-step to every joint's. */
export function gatherReactions(model, joints, share) {
  model.M.mj_rnePostConstraint(model.model, model.data);
  model.efc = { force: model.data.efc_force, type: model.data.efc_type, id: model.data.efc_id };
  const take = (joint, [force, torque]) => {
    joint.force = add(joint.force, scale(share, force));
    joint.torque = add(joint.torque, scale(share, torque));
  };
  for (const body of model.bodies) if (body !== null && body.link !== null) take(body.link, ofLink(model, body));
  for (const joint of joints.values()) {
    if (joint.isLink) continue;
    if (joint.tendon >= 0) take(joint, ofRod(model, joint));
    else if (joint.equality >= 0) take(joint, ofLoop(model, joint));
  }
}
