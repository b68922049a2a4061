// Bodies and joints of the engine, made of Gazebo's records.
#include <algorithm>
#include <utility>

#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/joint_frames.hpp"
#include "hosts/gazebo/world/motors.hpp"
#include "hosts/gazebo/world/world.hpp"

namespace plumb::gazebo {
namespace {

/// What a compound cannot hold.
bool stands_alone(const Shape& shape) {
  return shape.geometry.form == Form::plane || shape.geometry.form == Form::mesh;
}

Placement body_frame(const Shape& shape) { return shape.pose * turned(turn_of(shape.geometry)); }

PlumbMaterial material_of(const Shape& shape) {
  PlumbMaterial material{};
  material.friction = shape.friction;
  material.restitution = shape.restitution;
  return material;
}

/// Links of one model do not touch each other unless it says so.
PlumbFilter filter_of(const Link& link, std::span<Shape* const> shapes) {
  std::uint16_t mask = shapes.empty() ? kTouchesAll : std::uint16_t{0};
  for (const Shape* shape : shapes) {
    if (mask != 0 && mask != shape->mask)
      warn("link [" + link.name + "] has collisions of different masks; each of them touches what any of them does");
    mask = static_cast<std::uint16_t>(mask | shape->mask);
  }
  const Model& root = link.model->root();
  const std::int32_t group = root.self_collide ? 0 : -static_cast<std::int32_t>(root.id);
  return {mask, mask, group, 0};
}

/// Mass properties of a link in the frame of its body.
void weigh(PlumbBodyDesc& desc, const Link& link, const Placement& offset) {
  const auto& mass = link.inertial.MassMatrix();
  const Rotation principal = link.inertial.Pose().Rot() * mass.PrincipalAxesOffset();
  const Placement at = offset.Inverse() * Placement(link.inertial.Pose().Pos(), principal);
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = mass.Mass();
  desc.inertia = to_plumb(mass.PrincipalMoments());
  desc.centre_of_mass = to_plumb(at.Pos());
  desc.inertia_orientation = to_plumb(at.Rot());
}

PlumbJointType type_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed: return PLUMB_JOINT_FIXED;
    case JointKind::revolute: return PLUMB_JOINT_HINGE;
    case JointKind::prismatic: return PLUMB_JOINT_SLIDER;
    case JointKind::ball: return PLUMB_JOINT_BALL;
    case JointKind::universal: break;
  }
  return PLUMB_JOINT_UNIVERSAL;
}

}  // namespace

Part World::add_part(Link& link, std::span<Shape* const> shapes) {
  const PlumbMotion motion = motion_of(link);
  Part part;
  part.shapes.assign(shapes.begin(), shapes.end());
  PlumbBodyDesc body = body_desc(motion);
  try {
    std::vector<PlumbCompoundChild> children;
    for (const Shape* shape : shapes) {
      std::vector<double> points;
      const PlumbShapeDesc desc = describe(shape->geometry, motion, points);
      PlumbShape id = 0;
      check(*physics_, physics_->create_shapes({&desc, 1}, {&id, 1}));
      part.owned.push_back(id);
      children.push_back({id, to_plumb(body_frame(*shape)), 1, 0, material_of(*shape)});
    }
    if (shapes.size() == 1) part.offset = body_frame(*shapes[0]);
    if (shapes.size() > 1) {
      PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
      compound.children = children.data();
      compound.child_count = static_cast<std::uint32_t>(children.size());
      PlumbShape id = 0;
      check(*physics_, physics_->create_shapes({&compound, 1}, {&id, 1}));
      part.owned.insert(part.owned.begin(), id);
    }
    if (!shapes.empty()) {
      body.shape = part.owned[0];
      body.material = material_of(*shapes[0]);
    }
    body.pose = to_plumb(link.pose * part.offset);
    if (motion == PLUMB_DYNAMIC) {
      body.linear_velocity = to_plumb(link.velocity);
      body.angular_velocity = to_plumb(link.spin);
      body.gravity_scale = link.gravity ? 1 : 0;
      weigh(body, link, part.offset);
    }
    if ((needs_ & PLUMB_NEED_FILTERS) != 0) body.filter = filter_of(link, shapes);
    check(*physics_, physics_->create_bodies({&body, 1}, {&part.body, 1}));
  } catch (...) {
    for (const PlumbShape id : part.owned) physics_->destroy_shapes({&id, 1});
    throw;
  }
  return part;
}

void World::build_link(Link& link) {
  for (Joint* joint : link.joints) remove_joint(*joint);
  remove_parts(link);
  link.built = true;
  link.moved = false;
  std::vector<Shape*> joined;
  std::vector<std::vector<Shape*>> bodies;
  for (const auto& shape : link.shapes)
    if (motion_of(link) == PLUMB_STATIC && stands_alone(*shape))
      bodies.push_back({shape.get()});
    else
      joined.push_back(shape.get());
  if (!joined.empty() || bodies.empty()) bodies.insert(bodies.begin(), joined);
  try {
    for (const std::vector<Shape*>& shapes : bodies) {
      link.parts.push_back(add_part(link, shapes));
      owners_[link.parts.back().body] = {&link, link.parts.size() - 1};
    }
  } catch (const Error& error) {
    complain("link [" + link.name + "] of model [" + link.model->name + "] is left out of the simulation by " +
             engine_ + ": " + error.what());
  }
}

void World::remove_parts(Link& link) {
  for (const Part& part : link.parts) {
    owners_.erase(part.body);
    report(physics_->destroy_bodies({&part.body, 1}));
    for (const PlumbShape shape : part.owned) report(physics_->destroy_shapes({&shape, 1}));
  }
  link.parts.clear();
}

void World::remove_joint(Joint& joint) {
  joint.built = false;
  if (joint.joint == 0) return;
  // One that broke in the engine is gone there already.
  const PlumbResult result = physics_->joints()->destroy_joints({&joint.joint, 1});
  if (result != PLUMB_E_STALE_HANDLE) report(result);
  joint.joint = 0;
}

void World::build_joint(Joint& joint) {
  remove_joint(joint);
  joint.built = true;
  joint.motors_changed = false;
  if (!joint.attached) return;
  const auto moves = [](const Link* link) { return link != nullptr && motion_of(*link) == PLUMB_DYNAMIC; };
  if (!moves(joint.parent) && !moves(joint.child)) return;
  const auto lacks_body = [](const Link* link) { return link != nullptr && link->parts.empty(); };
  if (lacks_body(joint.parent) || lacks_body(joint.child)) return;  // it was complained of
  PlumbJointDesc desc = joint_desc(type_of(joint.kind));
  const Placement turn = turned(joint.turn);
  if (joint.parent != nullptr) desc.body_a = joint.parent->parts[0].body;
  const Placement offset_a = joint.parent != nullptr ? joint.parent->parts[0].offset.Inverse() : Placement::Zero;
  desc.frame_a = to_plumb(offset_a * joint.in_parent * turn);
  desc.body_b = joint.child->parts[0].body;
  desc.frame_b = to_plumb(joint.child->parts[0].offset.Inverse() * joint.in_child * turn);
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    desc.limits[plumb_axis(joint, i)] = limit_of(joint, i);
    desc.motors[plumb_axis(joint, i)] = motor_of(joint, i);
  }
  try {
    if (physics_->joints() == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "it has no joints");
    check(*physics_, physics_->joints()->create_joints({&desc, 1}, {&joint.joint, 1}));
  } catch (const Error& error) {
    complain("joint [" + joint.name + "] of model [" + joint.model->name + "] is left out of the simulation by " +
             engine_ + ": " + error.what());
  }
}

void World::build() {
  if (!std::exchange(changed_, false)) return;
  for_each_link([this](Link& link) {
    if (!link.built) build_link(link);
  });
  for_each_joint([this](Joint& joint) {
    if (!joint.built) build_joint(joint);
  });
  moving_.clear();
  moving_bodies_.clear();
  for_each_link([this](Link& link) {
    if (motion_of(link) != PLUMB_DYNAMIC || link.parts.empty()) return;
    moving_.push_back(&link);
    moving_bodies_.push_back(link.parts[0].body);
  });
}

void World::forget(Link& link) {
  const std::vector<Joint*> joints = link.joints;
  for (Joint* joint : joints) forget(*joint);
  remove_parts(link);
  std::erase(moving_, &link);
  changed_ = true;
}

void World::forget(Joint& joint) {
  remove_joint(joint);
  joint.built = true;
  joint.attached = false;
  if (joint.parent != nullptr) std::erase(joint.parent->joints, &joint);
  if (joint.child != nullptr) std::erase(joint.child->joints, &joint);
  joint.parent = joint.child = nullptr;
}

}  // namespace plumb::gazebo
