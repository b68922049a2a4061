#include "convert/gltf/gltf_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "convert/gltf/gltf_distance.hpp"
#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using nlohmann::json;
using referee::Pose;
using referee::Vec3;

/// What limits leave of an axis: all of it, a range, or nothing.
struct AxisRange {
  PlumbAxisMode mode = PLUMB_AXIS_FREE;
  double lower = 0, upper = 0;
};
using Ranges = std::array<AxisRange, 6>;

void restrict_axes(Ranges& ranges, const json& limit, const std::string& name, Remarks& remarks) {
  const bool turns = limit.contains("angularAxes");
  const auto axes = limit.at(turns ? "angularAxes" : "linearAxes").get<std::vector<std::size_t>>();
  const double all = turns ? std::numbers::pi : 1e6;
  double lower = member(limit, "min", -all), upper = member(limit, "max", all);
  if (axes.size() > 1 && !limit.contains("min")) lower = -upper;
  const bool locked = upper == 0 && (lower == 0 || axes.size() > 1);
  if (axes.size() > 1 && !locked) {
    remarks.add("limits of several axes together are limits of each", name);
    lower = -upper;
  }
  if (limit.contains("stiffness") || limit.contains("damping")) remarks.add("soft limits are hard", name);
  if (!(lower <= upper))
    throw UsageError(fmt::format("joint \"{}\": its limit from {} to {} is none", name, lower, upper));
  for (const std::size_t axis : axes) {
    if (axis > 2) throw UsageError(fmt::format("joint \"{}\": axis {} is none of 0, 1, 2", name, axis));
    ranges[axis + (turns ? 3 : 0)] = {locked ? PLUMB_AXIS_LOCKED : PLUMB_AXIS_LIMITED, lower, upper};
  }
}

std::size_t count(const Ranges& ranges, std::size_t first, PlumbAxisMode mode) {
  const auto* begin = ranges.data() + first;
  return static_cast<std::size_t>(std::count_if(begin, begin + 3, [&](const AxisRange& r) { return r.mode == mode; }));
}

/// Turns frames so that the one axis that is not locked, of three from `first` on, becomes x; none where there is not
/// one.
std::optional<referee::Mat3> turn_to_x(const Ranges& ranges, std::size_t first) {
  if (count(ranges, first, PLUMB_AXIS_LOCKED) != 2) return std::nullopt;
  referee::Mat3 turn = referee::Mat3::Identity();
  if (ranges[first + 1].mode != PLUMB_AXIS_LOCKED) turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  if (ranges[first + 2].mode != PLUMB_AXIS_LOCKED) turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return turn;
}

struct Kind {
  PlumbJointType type = PLUMB_JOINT_GENERIC;
  referee::Mat3 turn = referee::Mat3::Identity();
};

Kind kind_of(const Ranges& ranges) {
  const bool placed = count(ranges, 0, PLUMB_AXIS_LOCKED) == 3, aligned = count(ranges, 3, PLUMB_AXIS_LOCKED) == 3;
  const bool two_turns = count(ranges, 3, PLUMB_AXIS_LOCKED) == 1 && ranges[5].mode == PLUMB_AXIS_LOCKED;
  if (placed && two_turns) return {PLUMB_JOINT_UNIVERSAL, referee::Mat3::Identity()};
  if (placed && aligned) return {PLUMB_JOINT_FIXED, referee::Mat3::Identity()};
  if (placed && count(ranges, 3, PLUMB_AXIS_FREE) == 3) return {PLUMB_JOINT_BALL, referee::Mat3::Identity()};
  if (const auto turn = turn_to_x(ranges, 3); placed && turn) return {PLUMB_JOINT_HINGE, *turn};
  if (const auto turn = turn_to_x(ranges, 0); aligned && turn) return {PLUMB_JOINT_SLIDER, *turn};
  return {};
}

/// Which axis of the turned frame this one is.
std::size_t turned_axis(std::size_t axis, const referee::Mat3& turn) {
  Eigen::Index to = 0;
  turn.row(static_cast<Eigen::Index>(axis % 3)).maxCoeff(&to);
  return axis / 3 * 3 + static_cast<std::size_t>(to);
}

void set_drive(PlumbJointDesc& desc, const json& drive, const Kind& kind, double sign, const std::string& name,
               Remarks& remarks) {
  const std::size_t axis =
      turned_axis(drive.at("axis").get<std::size_t>() + (drive.at("type") == "angular" ? 3 : 0), kind.turn);
  const double stiffness = member(drive, "stiffness", 0.0), damping = member(drive, "damping", 0.0);
  if (stiffness == 0 && damping == 0) return;
  const bool is_force = member(drive, "mode", std::string("force")) == "force";
  if (is_force && !drive.contains("maxForce") && member(drive, "velocityTarget", 0.0) == 0) {
    desc.springs[axis] = {sign * member(drive, "positionTarget", 0.0), stiffness, damping, 1, PLUMB_SPRING_STIFFNESS};
    return;
  }
  if (stiffness != 0)
    remarks.add("springs of drives that have a strongest force, a speed or go by acceleration are left out", name);
  if (damping == 0) return;
  remarks.add("drives reach their speed at once, as strong as they may be", name);
  desc.motors[axis] = {sign * member(drive, "velocityTarget", 0.0), member(drive, "maxForce", 1e6), 1, 0};
}

}  // namespace

void add_gltf_joint(const GltfFile& file, int node, const std::map<int, std::size_t>& bodies, Imported& imported) {
  const json& joint = file.physics[static_cast<std::size_t>(node)].at("joint");
  const std::string name = scene_name(file.name(node));
  const int other = joint.at("connectedNode").get<int>();
  const json& description = file.rigid_bodies.at("physicsJoints").at(joint.at("joint").get<std::size_t>());
  if (other < 0 || static_cast<std::size_t>(other) >= file.place.size())
    throw UsageError(fmt::format("joint \"{}\" is connected to node {}, which is not there", name, other));
  const auto body = [&](int of) -> std::optional<std::size_t> {
    const auto found = file.body_of(of);
    return found ? std::optional(bodies.at(*found)) : std::nullopt;
  };
  std::optional<std::size_t> a = body(node), b = body(other);
  if (a == b) {
    imported.remarks.add("joints of a body to itself, or of the world, are left out", name);
    return;
  }
  const json limits = member(description, "limits", json::array());
  const bool distance = is_distance(limits);
  Ranges ranges;
  if (!distance)
    for (const json& limit : limits) restrict_axes(ranges, limit, name, imported.remarks);
  Kind kind = kind_of(ranges);
  if (distance) kind.type = PLUMB_JOINT_DISTANCE;
  const auto frame = [&](int of) {
    Pose pose = file.place[static_cast<std::size_t>(of)].pose;
    pose.rotation = pose.rotation * kind.turn;
    return pose;
  };
  Pose frame_a = frame(node), frame_b = frame(other);
  double sign = 1;
  if (!b) {  // the world is body a: seen from there all goes the other way
    if (kind.type == PLUMB_JOINT_UNIVERSAL) kind.type = PLUMB_JOINT_GENERIC;  // whose x is body a's
    std::swap(a, b);
    std::swap(frame_a, frame_b);
    sign = -1;
  }
  add_joint(imported, name, {kind.type, a, *b, frame_b}, {});
  PlumbJointDesc& desc = imported.scene.joints.back().desc;
  const auto& scene = imported.scene;
  desc.frame_a = plain(a ? frame_a.seen_from(referee::pose(scene.bodies[*a].desc.pose)) : frame_a);
  desc.collide_connected = member(joint, "enableCollision", false) ? 1 : 0;
  if (distance) return set_distance(desc, description, name, imported.remarks);
  for (std::size_t axis = 0; axis < ranges.size(); ++axis) {
    const AxisRange& range = ranges[axis];
    const std::size_t to = turned_axis(axis, kind.turn);
    if (kind.type == PLUMB_JOINT_GENERIC) desc.axis_modes[to] = range.mode;
    if (range.mode != PLUMB_AXIS_LIMITED) continue;
    desc.limits[to] = {sign > 0 ? range.lower : -range.upper, sign > 0 ? range.upper : -range.lower, 1, 0};
  }
  for (const json& drive : member(description, "drives", json::array()))
    set_drive(desc, drive, kind, sign, name, imported.remarks);
}

}  // namespace plumb::harness
