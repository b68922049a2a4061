// Joints of a world: made, read, driven, taken away.
#include "articulated/joint_rows.hpp"
#include "plumb/backend/modify.hpp"
#include "world.hpp"

namespace plumb::dart6 {
PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  try {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      auto joint = std::make_unique<Joint>();
      joint->handle = ids[i];
      joint->desc = descs[i];
      joint->a = descs[i].body_a == 0 ? nullptr : &body(descs[i].body_a);
      joint->b = &body(descs[i].body_b);
      put_in(joints_, ids[i], std::move(joint));
    }
    make_stale();
    (void)grow_trees(bodies_, joints_);
  } catch (...) {
    for (const PlumbJoint id : ids)
      if (slot_of(id) < joints_.size()) joints_[slot_of(id)].reset();
    throw;
  }
  return PLUMB_OK;
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  make_stale();
  for (const PlumbJoint id : ids) joints_[slot_of(id)].reset();
  return PLUMB_OK;
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  double row[12] = {};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    articulated::read_joint_row(field, joint(ids[i]), row);
    rows.put(i, row, joint_columns_of(field));
  }
  return PLUMB_OK;
}

/// What a joint is asked to do decides what it can be: a ball that gets its first motor becomes three hinges.
PlumbResult World::write_motors(std::span<const PlumbJoint> ids, ConstRows rows) {
  std::vector<PlumbJointDesc> before;
  double row[12] = {};
  bool becomes_another = stale_;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Joint& written = joint(ids[i]);
    before.push_back(written.desc);
    rows.get(i, row, 12);
    articulated::write_motor_row(row, written.desc);
    becomes_another = becomes_another || is_plain_ball(written.desc) != is_plain_ball(before[i]) ||
                      can_close_a_loop(written.desc) != can_close_a_loop(before[i]);
  }
  try {
    for (const PlumbJoint id : ids) check_joint(joint(id).desc);
    if (becomes_another) {
      make_stale();
      (void)grow_trees(bodies_, joints_);
    }
  } catch (...) {
    for (std::size_t i = 0; i < ids.size(); ++i) joint(ids[i]).desc = before[i];
    throw;
  }
  for (const PlumbJoint id : ids)
    if (!stale_ && joint(id).is_link) apply_motors(joint(id));
  return PLUMB_OK;
}

PlumbResult World::write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) {
  if (field == PLUMB_JOINT_MOTOR) return write_motors(ids, rows);
  double row[6] = {};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Joint& written = joint(ids[i]);
    rows.get(i, row, 6);
    backend::apply_rest_row(row, written.desc);
    if (!stale_ && written.is_link) apply_targets(written);
  }
  return PLUMB_OK;
}

}  // namespace plumb::dart6
