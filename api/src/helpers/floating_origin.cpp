#include "plumb/helpers/floating_origin.hpp"

#include <cmath>

#include "common.hpp"

namespace plumb::helpers {
namespace {

bool is_power_of_two(double value) {
  int exponent = 0;
  return std::isfinite(value) && value > 0 && std::frexp(value, &exponent) == 0.5;
}

}  // namespace

FloatingOrigin::FloatingOrigin(IPhysicsWorld& world, const FloatingOriginSettings& settings)
    : world_(world), settings_(settings) {
  require(is_power_of_two(settings.cell), "floating origin: a cell of " + std::to_string(settings.cell) +
                                              " m is no power of two, and shifts by it would round: take 256");
  require(settings.distance >= settings.cell, "floating origin: distance is " + std::to_string(settings.distance) +
                                                  " m, less than a cell: give a cell or more");
}

PlumbVec3 FloatingOrigin::update(const PlumbVec3& focus, std::span<const PlumbJoint> joints) {
  const auto cells = [&](double at) {
    return std::abs(at) > settings_.distance ? -settings_.cell * std::round(at / settings_.cell) : 0.0;
  };
  const PlumbVec3 by{cells(focus.x), cells(focus.y), cells(focus.z)};
  if (by.x == 0 && by.y == 0 && by.z == 0) return by;
  std::vector<double> before, after;
  read_coordinates(joints, before);
  shift(by);
  read_coordinates(joints, after);
  // A joint of two bodies does not notice; one with the world is now as far off as the world went.
  const double noticed = settings_.cell / 4;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (std::abs(after[i] - before[i]) < noticed) continue;
    write_rows(world_, PLUMB_FIELD_POSE, world_.bodies(), std::span<const PlumbPose>(before_));
    throw Error(PLUMB_E_UNSUPPORTED, "floating origin: joint " + std::to_string(slot_of(joints[i / 6])) +
                                         " is fixed to the world, which cannot move: join it to a static body instead");
  }
  origin_ = sub(origin_, by);
  return by;
}

void FloatingOrigin::shift(const PlumbVec3& by) {
  const std::vector<PlumbBody> bodies(world_.bodies().begin(), world_.bodies().end());
  before_.resize(bodies.size());
  awake_.resize(bodies.size());
  read_rows(world_, PLUMB_FIELD_POSE, bodies, std::span(before_));
  read_rows(world_, PLUMB_FIELD_AWAKE, bodies, std::span(awake_));
  poses_ = before_;
  for (PlumbPose& pose : poses_) pose.position = add(pose.position, by);
  write_rows(world_, PLUMB_FIELD_POSE, bodies, std::span<const PlumbPose>(poses_));
  for (std::size_t i = 0; i < bodies.size(); ++i)  // a teleport wakes
    if (awake_[i] == 0) write_one(world_, PLUMB_FIELD_AWAKE, bodies[i], awake_[i]);
}

void FloatingOrigin::read_coordinates(std::span<const PlumbJoint> joints, std::vector<double>& coordinates) {
  coordinates.resize(6 * joints.size());
  if (joints.empty()) return;
  IJoints& extension =
      require_extension(world_.joints(), "floating origin with joints", PLUMB_EXT_JOINTS, "PLUMB_NEED_JOINTS");
  const Rows rows(reinterpret_cast<std::byte*>(coordinates.data()), joints.size(), 6 * sizeof(double), PLUMB_F64);
  check(world_, extension.read_joints(PLUMB_JOINT_COORDINATES, joints, rows));
}

}  // namespace plumb::helpers
