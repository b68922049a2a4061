// Joints of a world: made, read, driven, taken away.
#include "articulated/joint_rows.hpp"
#include "world.hpp"

namespace plumb::mujoco {
namespace {

void require_free_axes(const Joint& joint) {
  if (joint.desc.type == PLUMB_JOINT_DISTANCE) return;
  for (const Body* body : {joint.a, joint.b})
    if (body != nullptr && body->desc.locks != 0)
      throw Error(PLUMB_E_UNSUPPORTED,
                  "a body with locked axes has joints other than distance, which MuJoCo's trees cannot have; lock the "
                  "joint's axes instead");
}

}  // namespace

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (const PlumbJointDesc& desc : descs) check_joint(desc);
  try {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      auto joint = std::make_unique<Joint>();
      joint->handle = ids[i];
      joint->desc = descs[i];
      joint->a = descs[i].body_a == 0 ? nullptr : &body(descs[i].body_a);
      joint->b = &body(descs[i].body_b);
      joint->axis_joint.fill(-1);
      require_free_axes(*joint);
      put_in(joints_, ids[i], std::move(joint));
    }
    stale_ = true;
    (void)grow_tree(bodies_, joints_);
  } catch (...) {
    for (const PlumbJoint id : ids)
      if (slot_of(id) < joints_.size()) joints_[slot_of(id)].reset();
    throw;
  }
  return PLUMB_OK;
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  for (const PlumbJoint id : ids) joints_[slot_of(id)].reset();
  stale_ = true;
  return PLUMB_OK;
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    articulated::read_joint_row(field, joint(ids[i]), row);
    rows.put(i, row, joint_columns_of(field));
  }
  return PLUMB_OK;
}

/// A ball that gets its first motor becomes three hinges: the model is made anew.
PlumbResult World::write_joints(PlumbJointField, std::span<const PlumbJoint> ids, ConstRows rows) {
  std::vector<PlumbJointDesc> before;
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Joint& written = joint(ids[i]);
    before.push_back(written.desc);
    rows.get(i, row, 12);
    articulated::write_motor_row(row, written.desc);
  }
  try {
    for (const PlumbJoint id : ids) check_joint(joint(id).desc);
    (void)grow_tree(bodies_, joints_);
  } catch (...) {
    for (std::size_t i = 0; i < ids.size(); ++i) joint(ids[i]).desc = before[i];
    throw;
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Joint& written = joint(ids[i]);
    stale_ = stale_ || is_plain_ball(written.desc) != is_plain_ball(before[i]) || !written.is_link;
    if (!stale_) apply_motors(model_, written);
  }
  return PLUMB_OK;
}

}  // namespace plumb::mujoco
