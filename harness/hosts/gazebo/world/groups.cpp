#include "hosts/gazebo/world/groups.hpp"

#include <algorithm>

#include "hosts/gazebo/world/joint_frames.hpp"
#include "hosts/gazebo/world/world.hpp"

namespace plumb::gazebo {
namespace {

/// What the child's side is of a joint: all that hangs on it, or where that leads back to the parent the child alone.
std::vector<Link*> hanging_on(Joint& joint) {
  std::vector<Link*> links = connected(*joint.child, &joint);
  if (std::find(links.begin(), links.end(), joint.parent) != links.end()) return {joint.child};
  return links;
}

}  // namespace

std::vector<Link*> connected(Link& link, const Joint* without, bool* to_world) {
  std::vector<Link*> links = {&link};
  for (std::size_t i = 0; i < links.size(); ++i)
    for (Joint* joint : links[i]->joints) {
      if (joint == without || !joint->attached) continue;
      Link* other = joint->parent == links[i] ? joint->child : joint->parent;
      if (other == nullptr || motion_of(*other) == PLUMB_STATIC) {
        if (to_world != nullptr && motion_of(*links[i]) == PLUMB_DYNAMIC) *to_world = true;
      } else if (std::find(links.begin(), links.end(), other) == links.end()) {
        links.push_back(other);
      }
    }
  return links;
}

Link* root_of(Model& model) {
  Link* first = nullptr;
  Link* root = nullptr;
  World::for_each_link(model, [&](Link& link) {
    if (first == nullptr) first = &link;
    const auto is_child = [&](const Joint* joint) { return joint->attached && joint->child == &link; };
    if (root == nullptr && std::none_of(link.joints.begin(), link.joints.end(), is_child)) root = &link;
  });
  return root != nullptr ? root : first;
}

Link* root_of(Link& link) {
  Link* root = &link;
  std::vector<Link*> seen;
  while (std::find(seen.begin(), seen.end(), root) == seen.end()) {
    seen.push_back(root);
    for (const Joint* joint : root->joints)
      if (joint->attached && joint->child == root && joint->parent != nullptr) {
        root = joint->parent;
        break;
      }
  }
  return root;
}

std::vector<Link*> links_as_one(Model& model, bool* held) {
  std::vector<Link*> links;
  World::for_each_link(model, [&](Link& link) {
    if (std::find(links.begin(), links.end(), &link) != links.end()) return;
    const std::vector<Link*> more = connected(link, nullptr, held);
    links.insert(links.end(), more.begin(), more.end());
  });
  return links;
}

void carry(const std::vector<Link*>& links, const Placement& motion, const Link* seen_from) {
  for (Link* link : links) {
    const Vector before = link->centre(), spin = seen_from != nullptr ? seen_from->spin : Vector::Zero;
    const Vector drift = seen_from != nullptr ? link->velocity - seen_from->velocity_at(before) : link->velocity;
    link->pose = motion * link->pose;
    link->spin = spin + motion.Rot().RotateVector(link->spin - spin);
    link->velocity = motion.Rot().RotateVector(drift);
    if (seen_from != nullptr) link->velocity += seen_from->velocity_at(link->centre());
    link->moved = true;
  }
}

void set_coordinate(Joint& joint, std::size_t axis, double value) {
  const double change = value - joint.axes[axis].position;
  const Vector along = axis_of(joint, axis);
  Placement motion;
  if (joint.kind == JointKind::prismatic) {
    motion.Pos() = along * change;
  } else {
    const Vector at = frame_on_child(joint).Pos();
    motion = Placement(at, Rotation(along, change)) * Placement(-at, Rotation::Identity);
  }
  carry(hanging_on(joint), motion, joint.parent);
  joint.axes[axis].position = value;
}

void set_rate(Joint& joint, std::size_t axis, double value) {
  const Vector change = axis_of(joint, axis) * (value - rate_of(joint, axis));
  const Vector at = frame_on_child(joint).Pos();
  for (Link* link : hanging_on(joint)) {
    if (joint.kind == JointKind::prismatic) {
      link->velocity += change;
    } else {
      link->velocity += change.Cross(link->centre() - at);
      link->spin += change;
    }
    link->moved = true;
  }
  joint.axes[axis].rate = value;
}

void set_frames(Joint& joint, const Placement& in_parent, const Placement& in_child) {
  const Placement coordinates = frame_on_parent(joint).Inverse() * frame_on_child(joint);
  joint.in_parent = in_parent;
  joint.in_child = in_child;
  const Placement target = frame_on_parent(joint) * coordinates;
  carry(hanging_on(joint), target * frame_on_child(joint).Inverse(), joint.parent);
}

void refresh(Joint& joint) {
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    joint.axes[i].position = coordinate_of(joint, i);
    joint.axes[i].rate = rate_of(joint, i);
  }
}

}  // namespace plumb::gazebo
