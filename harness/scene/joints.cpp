// Joints of a scene file.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "plumb/backend/names.hpp"
#include "scene/build.hpp"

namespace plumb::harness {
namespace {

const std::vector<std::string>& axis_words() {
  static const std::vector<std::string> words{"x", "y", "z", "rx", "ry", "rz"};
  return words;
}

PlumbPose read_frame(const Node& node) {
  node.only(scene_keys().at("frame"));
  return {node.vector_or("position", {}), node.orientation_or("orientation", {0, 0, 0, 1})};
}

/// A world pose as a body's frame sees it at the start.
PlumbPose in_body(const PlumbPose& body, const PlumbPose& world) {
  const auto vector = [](const PlumbVec3& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  const auto quaternion = [](const PlumbQuat& q) { return Eigen::Quaterniond(q.w, q.x, q.y, q.z); };
  const Eigen::Quaterniond inverse = quaternion(body.orientation).conjugate();
  const Eigen::Vector3d p = inverse * (vector(world.position) - vector(body.position));
  const Eigen::Quaterniond q = inverse * quaternion(world.orientation);
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

void read_frames(const Node& node, const SceneBuilder& builder, SceneJoint& joint) {
  const auto anchor = node.find("anchor");
  if (!anchor) {
    if (const auto stray = node.find("anchor_orientation")) stray->fail("anchor_orientation needs anchor");
    if (const auto frame = node.find("frame_a")) joint.desc.frame_a = read_frame(*frame);
    if (const auto frame = node.find("frame_b")) joint.desc.frame_b = read_frame(*frame);
    return;
  }
  for (const char* key : {"frame_a", "frame_b"})
    if (const auto frame = node.find(key)) frame->fail("a joint has either an anchor or frames");
  const PlumbPose world{anchor->vector(), node.orientation_or("anchor_orientation", {0, 0, 0, 1})};
  const auto& bodies = builder.scene.bodies;
  joint.desc.frame_a = joint.body_a ? in_body(bodies[*joint.body_a].desc.pose, world) : world;
  joint.desc.frame_b = in_body(bodies[joint.body_b].desc.pose, world);
}

/// By frequency and damping ratio, or by stiffness and damping.
PlumbSpring read_spring(const Node& node) {
  const double rest = node.number_or("rest", 0);
  if (!node.find("stiffness") && !node.find("damping"))
    return {rest, node.at("frequency").number(), node.at("damping_ratio").number(), 1, PLUMB_SPRING_FREQUENCY};
  for (const char* key : {"frequency", "damping_ratio"})
    if (const auto other = node.find(key))
      other->fail("a spring has either frequency and damping_ratio or stiffness and damping");
  const auto not_negative = [&](const char* key) {
    const double value = node.number_or(key, 0);
    if (!(value >= 0)) node.at(key).fail(fmt::format("{} is {:g}; it must be 0 or above", key, value));
    return value;
  };
  return {rest, not_negative("stiffness"), not_negative("damping"), 1, PLUMB_SPRING_STIFFNESS};
}

void read_axes(const Node& node, PlumbJointDesc& desc) {
  static const std::vector<std::string> modes{"free", "locked", "limited"};
  if (const auto given = node.find("axis_modes")) {
    if (desc.type != PLUMB_JOINT_GENERIC) given->fail("only a generic joint has axis_modes");
    for_each_axis(*given, [&](std::size_t axis, const Node& mode) {
      desc.axis_modes[axis] = static_cast<PlumbAxisMode>(mode.word("axis mode", modes));
    });
  }
  if (const auto given = node.find("limits"))
    for_each_axis(*given, [&](std::size_t axis, const Node& limit) {
      limit.only(scene_keys().at("limit"));
      desc.limits[axis] = {limit.at("lower").number(), limit.at("upper").number(), 1, 0};
    });
  if (const auto given = node.find("motors"))
    for_each_axis(*given, [&](std::size_t axis, const Node& motor) {
      motor.only(scene_keys().at("motor"));
      desc.motors[axis] = {motor.at("target_velocity").number(), motor.at("max_force").number(), 1, 0};
    });
  if (const auto given = node.find("springs"))
    for_each_axis(*given, [&](std::size_t axis, const Node& spring) {
      spring.only(scene_keys().at("spring"));
      desc.springs[axis] = read_spring(spring);
    });
}

SceneJoint read_joint(const Node& node, const SceneBuilder& builder) {
  SceneJoint joint;
  joint.name = node.at("name").name();
  joint.desc = joint_desc(static_cast<PlumbJointType>(node.at("type").word("joint", joint_words())));
  if (const auto body = node.find("body_a"); body && body->name() != "world")
    joint.body_a = find_name(*body, "body", builder.body_index);
  joint.body_b = find_name(node.at("body_b"), "body", builder.body_index);
  if (joint.desc.type == PLUMB_JOINT_GENERIC)
    for (PlumbAxisMode& mode : joint.desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
  read_frames(node, builder, joint);
  read_axes(node, joint.desc);
  if (const auto collide = node.find("collide_connected")) joint.desc.collide_connected = collide->boolean() ? 1 : 0;
  const auto length = node.find("rest_length");
  if (length && joint.desc.type != PLUMB_JOINT_DISTANCE) length->fail("only a distance joint has rest_length");
  joint.desc.rest_length = length ? length->number() : 0;
  const auto ratio = node.find("ratio");
  if (ratio.has_value() != backend::is_meshing(joint.desc.type))
    (ratio ? *ratio : node).fail("a gear and a rack_and_pinion have a ratio, and no other joint");
  joint.desc.ratio = ratio ? ratio->number() : 0;
  if (ratio && joint.desc.ratio == 0) ratio->fail("the ratio is not 0");
  joint.desc.break_force = node.number_or("break_force", 0);
  joint.desc.break_torque = node.number_or("break_torque", 0);
  if (const auto cut = node.find("cut")) {
    joint.cut = cut->number();
    if (!(joint.cut >= 0)) cut->fail(fmt::format("the time of the cut is 0 or above, not {:g}", joint.cut));
  }
  if (const auto data = node.find("user_data"))
    joint.desc.user_data = static_cast<std::uint64_t>(data->integer(0, std::int64_t{1} << 53));
  return joint;
}

}  // namespace

void for_each_axis(const Node& node, const std::function<void(std::size_t, const Node&)>& each) {
  for (const auto& [key, value] : node.members()) {
    const auto found = std::find(axis_words().begin(), axis_words().end(), key);
    if (found == axis_words().end()) value.fail_unknown("axis", key, axis_words());
    each(static_cast<std::size_t>(found - axis_words().begin()), value);
  }
}

void read_joints(const Node& joints, SceneBuilder& builder) {
  for (const Node& node : joints.elements()) {
    node.only(scene_keys().at("joint"));
    for_each_repeat(node, [&] {
      SceneJoint joint = read_joint(node, builder);
      check_values(node, joint);
      add_name(node.at("name"), "joint", joint.name, builder.joint_index, builder.scene.joints.size());
      builder.scene.joints.push_back(std::move(joint));
    });
  }
}

}  // namespace plumb::harness
