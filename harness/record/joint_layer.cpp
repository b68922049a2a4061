#include "record/joint_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "referee/joints.hpp"
#include "scene/build.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

Json row_of(const PlumbPose& pose) {
  const auto& [p, q] = pose;
  return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

bool has_spring(const PlumbJointDesc& joint) {
  return std::any_of(std::begin(joint.springs), std::end(joint.springs),
                     [](const PlumbSpring& spring) { return spring.enabled != 0; });
}

bool may_break(const PlumbJointDesc& joint) { return joint.break_force > 0 || joint.break_torque > 0; }

bool holds_no_distance(const PlumbJointDesc& joint) {
  return joint.type == PLUMB_JOINT_DISTANCE && joint.springs[0].enabled != 0 && joint.limits[0].enabled == 0;
}

referee::Pose pose_of(const PoseRow& row) { return referee::pose(row.position, row.orientation); }

bool is_there(Simulation& simulation, std::size_t joint) {
  const PlumbJoint id = simulation.joint_handle(joint);
  std::array<double, 6> row{};
  const Rows rows(reinterpret_cast<std::byte*>(row.data()), 1, sizeof(row), PLUMB_F64);
  return simulation.world().joints()->read_joints(PLUMB_JOINT_COORDINATES, {&id, 1}, rows) == PLUMB_OK;
}

}  // namespace

Json joints_of(const Scene& scene) {
  Json joints = Json::array();
  for (const SceneJoint& joint : scene.joints) {
    Json entry{{"name", joint.name},
               {"type", word_of(joint_words(), joint.desc.type)},
               {"body_a", joint.body_a ? Json(*joint.body_a) : Json(nullptr)},
               {"body_b", joint.body_b},
               {"frame_a", row_of(joint.desc.frame_a)},
               {"frame_b", row_of(joint.desc.frame_b)}};
    if (joint.desc.type == PLUMB_JOINT_DISTANCE) entry["rest_length"] = joint.desc.rest_length;
    if (has_spring(joint.desc)) entry["spring"] = true;
    joints.push_back(std::move(entry));
  }
  return joints;
}

JointLayer::JointLayer(const Simulation& simulation) : alive_(simulation.scene().joints.size()) {
  std::iota(alive_.begin(), alive_.end(), std::size_t{0});
}

LayerSpec JointLayer::spec() {
  return {"joints", LayerRows::list, {{"joint", "u32"}, {"gap", "f32"}, {"angle", "f32"}}};
}

LayerData JointLayer::look(Simulation& simulation) {
  forget_broken(simulation);
  const Scene& scene = simulation.scene();
  LayerData data(spec());
  for (const std::size_t i : alive_) {
    const SceneJoint& joint = scene.joints[i];
    const referee::Pose a = joint.body_a ? pose_of(simulation.poses()[*joint.body_a]) : referee::Pose{};
    const referee::JointError error = referee::joint_error(joint.desc, a, pose_of(simulation.poses()[joint.body_b]));
    const double gap = holds_no_distance(joint.desc) ? std::numeric_limits<double>::quiet_NaN()
                                                     : std::max(error.position, error.limit_position);
    data.put(0, static_cast<std::uint32_t>(i));
    data.put(1, static_cast<float>(gap));
    data.put(2, static_cast<float>(std::max(error.angle, error.limit_angle)));
    ++data.rows;
  }
  return data;
}

// A handle tells whether its joint is there; asking costs a call, so only those that may break are asked for.
void JointLayer::forget_broken(Simulation& simulation) {
  std::erase_if(alive_, [&](std::size_t joint) {
    const SceneJoint& described = simulation.scene().joints[joint];
    return (may_break(described.desc) || std::isfinite(described.cut)) && !is_there(simulation, joint);
  });
}

}  // namespace plumb::harness
