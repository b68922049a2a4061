// What the engine says of the last step: contacts and the reactions of joints.
#include <array>

#include "hosts/gazebo/world/world.hpp"

namespace plumb::gazebo {

std::vector<Touch> World::touches() {
  std::vector<Touch> touches;
  if ((needs_ & PLUMB_NEED_CONTACTS) == 0 || dt_ == 0) return touches;
  const auto shape_at = [this](PlumbBody body, std::uint32_t child) -> const Shape* {
    const auto owner = owners_.find(body);
    if (owner == owners_.end()) return nullptr;  // gone since the step
    const Part& part = owner->second.first->parts[owner->second.second];
    if (part.shapes.size() == 1) return part.shapes[0];  // the child is a triangle of it
    return child < part.shapes.size() ? part.shapes[child] : nullptr;
  };
  for (const PlumbContact& contact : physics_->contacts()) {
    Touch touch;
    touch.first = shape_at(contact.body_a, contact.child_a);
    touch.second = shape_at(contact.body_b, contact.child_b);
    if (touch.first == nullptr || touch.second == nullptr) continue;
    touch.point = from_plumb(contact.position);
    touch.normal = -from_plumb(contact.normal);
    touch.depth = contact.depth;
    touch.force = (touch.normal * contact.normal_impulse - from_plumb(contact.tangent_impulse)) / dt_;
    touches.push_back(touch);
  }
  return touches;
}

bool World::reaction(Joint& joint, Vector& force, Vector& torque) {
  if ((needs_ & PLUMB_NEED_JOINT_REACTIONS) == 0 || joint.joint == 0) return false;
  std::array<double, 6> row{};
  const PlumbResult result =
      physics_->joints()->read_joints(PLUMB_JOINT_REACTION, {&joint.joint, 1}, rows_over(std::span(&row, 1)));
  if (result < 0) return false;
  force.Set(row[0], row[1], row[2]);
  torque.Set(row[3], row[4], row[5]);
  return true;
}

}  // namespace plumb::gazebo
