#include "convert/write/gltf/gltf_limits.hpp"

#include <array>

#include "convert/write/left_out.hpp"

namespace plumb::harness {
namespace {

using Modes = std::array<PlumbAxisMode, 6>;

Modes modes_of(const PlumbJointDesc& desc) {
  constexpr PlumbAxisMode L = PLUMB_AXIS_LOCKED, F = PLUMB_AXIS_FREE;
  Modes modes{L, L, L, L, L, L};
  switch (desc.type) {
    case PLUMB_JOINT_BALL: modes = {L, L, L, F, F, F}; break;
    case PLUMB_JOINT_HINGE: modes = {L, L, L, F, L, L}; break;
    case PLUMB_JOINT_SLIDER: modes = {F, L, L, L, L, L}; break;
    case PLUMB_JOINT_UNIVERSAL: modes = {L, L, L, F, F, L}; break;
    case PLUMB_JOINT_GENERIC: return std::to_array(desc.axis_modes);
    case PLUMB_JOINT_SWING_TWIST: return {L, L, L, F, F, F};  // whose limits are of other numbers
    default: return modes;
  }
  for (std::size_t axis = 0; axis < modes.size(); ++axis)
    if (modes[axis] == F && desc.limits[axis].enabled != 0) modes[axis] = PLUMB_AXIS_LIMITED;
  return modes;
}

Json limit_json(bool turns, const Json& axes, double lower, double upper) {
  return {{turns ? "angularAxes" : "linearAxes", axes}, {"min", lower}, {"max", upper}};
}

void add_limits(Json& limits, const PlumbJointDesc& desc, bool turns) {
  const Modes modes = modes_of(desc);
  Json locked = Json::array();
  for (std::size_t i = 0; i < 3; ++i)
    if (modes[i + (turns ? 3 : 0)] == PLUMB_AXIS_LOCKED) locked.push_back(i);
  if (!locked.empty()) limits.push_back(limit_json(turns, locked, 0, 0));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = i + (turns ? 3 : 0);
    if (modes[axis] == PLUMB_AXIS_LIMITED)
      limits.push_back(limit_json(turns, Json::array({i}), desc.limits[axis].lower, desc.limits[axis].upper));
  }
}

/// The limit of all three axes together is one of the distance, and a soft one at a length a spring.
void add_distance(Json& limits, const PlumbJointDesc& desc) {
  const Json all = Json::array({0, 1, 2});
  const PlumbSpring& spring = desc.springs[0];
  if (const PlumbLimit& limit = desc.limits[0]; limit.enabled != 0)
    limits.push_back(limit_json(false, all, limit.lower, limit.upper));
  else if (spring.enabled == 0)
    limits.push_back(limit_json(false, all, desc.rest_length, desc.rest_length));
  if (!springs_by_stiffness(spring)) return;
  Json soft = limit_json(false, all, desc.rest_length, desc.rest_length);
  soft["stiffness"] = spring.frequency;
  soft["damping"] = spring.damping_ratio;
  limits.push_back(std::move(soft));
}

Json drive_of(std::size_t axis) {
  return {{"type", axis < 3 ? "linear" : "angular"}, {"mode", "force"}, {"axis", axis % 3}};
}

void add_drives(Json& drives, const PlumbJointDesc& desc, std::size_t axis) {
  if (const PlumbSpring& spring = desc.springs[axis]; springs_by_stiffness(spring)) {
    Json drive = drive_of(axis);
    drive.update({{"positionTarget", spring.rest},
                  {"velocityTarget", 0},
                  {"stiffness", spring.frequency},
                  {"damping", spring.damping_ratio}});
    drives.push_back(std::move(drive));
  }
  const PlumbMotor& motor = desc.motors[axis];
  if (motor.enabled == 0 || motor.max_force == 0) return;
  // Motors reach their speed at once, as strong as they may be: of these a damping comes near that gives all the force
  // already this far off the speed.
  constexpr double within = 1e-3;  // m/s or rad/s
  Json drive = drive_of(axis);
  drive.update({{"velocityTarget", motor.target_velocity},
                {"damping", motor.max_force / within},
                {"maxForce", motor.max_force}});
  drives.push_back(std::move(drive));
}

}  // namespace

Json joint_description(const SceneJoint& joint, Remarks& remarks) {
  const PlumbJointDesc& desc = joint.desc;
  Json limits = Json::array(), drives = Json::array();
  if (desc.type == PLUMB_JOINT_DISTANCE) {
    add_distance(limits, desc);
  } else {
    for (const bool turns : {false, true}) add_limits(limits, desc, turns);
    if (desc.type != PLUMB_JOINT_SWING_TWIST)
      for (std::size_t axis = 0; axis < 6; ++axis) add_drives(drives, desc, axis);
  }
  for (std::size_t axis = 0; axis < 6; ++axis) remark_spring(joint, axis, remarks);
  Json description = Json::object();
  if (!limits.empty()) description["limits"] = std::move(limits);
  if (!drives.empty()) description["drives"] = std::move(drives);
  return description;
}

}  // namespace plumb::harness
