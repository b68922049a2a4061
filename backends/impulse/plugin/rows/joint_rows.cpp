#include "plugin/rows/joint_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>

#include "plumb/assert.hpp"
#include "plumb/backend/names.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace plumb::impulse {

namespace {

JointType plain_type(const PlumbJointDesc& desc) {
  switch (desc.type) {
    case PLUMB_JOINT_BALL:
    case PLUMB_JOINT_SWING_TWIST: return JointType::kBall;
    case PLUMB_JOINT_HINGE: return JointType::kHinge;
    case PLUMB_JOINT_SLIDER: return JointType::kSlider;
    case PLUMB_JOINT_FIXED: return JointType::kFixed;
    case PLUMB_JOINT_DISTANCE: return free_axes(desc) == 0 ? JointType::kDistance : JointType::kOther;
    default: return JointType::kOther;
  }
}

bool has_limit(const PlumbJointDesc& desc, std::size_t axis) {
  return desc.type == PLUMB_JOINT_GENERIC ? desc.axis_modes[axis] == PLUMB_AXIS_LIMITED
                                          : desc.limits[axis].enabled != 0;
}

void require_free(const PlumbJointDesc& desc) {
  const std::uint32_t free = free_axes(desc);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const bool limit = desc.type != PLUMB_JOINT_GENERIC && desc.limits[axis].enabled != 0;
    const char* what = limit                             ? "limits"
                       : desc.motors[axis].enabled != 0  ? "motors"
                       : desc.springs[axis].enabled != 0 ? "springs"
                                                         : nullptr;
    if (what == nullptr || (free >> axis & 1U) != 0) continue;
    std::string others;
    for (std::size_t other = 0; other < 6; ++other)
      if ((free >> other & 1U) != 0) others += " " + std::to_string(other);
    throw Error(PLUMB_E_UNSUPPORTED, std::string(what) + "[" + std::to_string(axis) + "] is on an axis that this " +
                                         backend::joint_name(desc.type) + " joint locks; " +
                                         (others.empty() ? "it leaves none free" : "free are" + others));
  }
}

class RowList {
 public:
  RowList(const PlumbJointDesc& desc, JointRows& rows) : desc_(desc), rows_(rows) {}

  void lock(RowKind kind, std::size_t axis, std::size_t other = 0) { put(kind, axis, other, kLocked); }

  /// A row for a free axis, where something is on it.
  void drive(RowKind kind, std::size_t axis, std::size_t other = 0) {
    const PlumbSpring& spring = desc_.springs[axis];
    const bool limited = kind != RowKind::kSwing && has_limit(desc_, axis);
    if (!limited && desc_.motors[axis].enabled == 0 && spring.enabled == 0) return;
    const int i = put(kind, axis % 3, other, static_cast<std::uint8_t>(axis));
    JointAxes& axes = rows_.axes;
    const bool turns = goes_round(kind);
    const double most = turns ? 2 * std::numbers::pi : static_cast<double>(kHuge);
    axes.lower[i] = static_cast<Real>(limited ? std::max(desc_.limits[axis].lower, -most) : -kHuge);
    axes.upper[i] = static_cast<Real>(limited ? std::min(desc_.limits[axis].upper, most) : kHuge);
    if (spring.enabled == 0) return;
    const double rest = kind == RowKind::kDistance ? desc_.rest_length : spring.rest;
    rows_.drive.rest[axis] = static_cast<Real>(turns ? std::remainder(rest, 2 * std::numbers::pi) : rest);
    if (spring.mode == PLUMB_SPRING_STIFFNESS) {
      axes.stiffness[i] = static_cast<Real>(spring.frequency);
      axes.damping[i] = static_cast<Real>(spring.damping_ratio);
      return;
    }
    const double omega = 2 * std::numbers::pi * spring.frequency;
    axes.springs_by_mass |= 1U << i;
    axes.stiffness[i] = static_cast<Real>(omega * omega);
    axes.damping[i] = static_cast<Real>(2 * spring.damping_ratio * omega);
  }

  /// The cone of a swing-twist joint, where it has one.
  void bound_swing() {
    if (desc_.limits[4].enabled == 0) return;
    const int i = put(RowKind::kCone, 0, 0, 4);
    rows_.axes.lower[i] = -kHuge;
    rows_.axes.upper[i] = static_cast<Real>(desc_.limits[4].upper);
    rows_.axes.narrow = static_cast<Real>(desc_.limits[4].upper / desc_.limits[5].upper);
  }

  void mesh(RowKind kind) {
    lock(kind, 0);
    rows_.axes.ratio = static_cast<Real>(desc_.ratio);
  }

 private:
  int put(RowKind kind, std::size_t axis, std::size_t other, std::uint8_t coordinate) {
    if (kind == RowKind::kPoint || kind == RowKind::kAlong || kind == RowKind::kDistance)
      rows_.pulls |= 1U << rows_.rows;
    PLUMB_ASSERT(rows_.rows < kJointRows);
    const int i = rows_.rows++ - rows_of(rows_.type);
    rows_.axes.row[i] = {kind, static_cast<std::uint8_t>(axis), static_cast<std::uint8_t>(other), coordinate};
    return i;
  }

  const PlumbJointDesc& desc_;
  JointRows& rows_;
};

/// Locks of the turns that are not free.
void lock_turns(RowList& list, std::uint32_t free) {
  switch (free) {
    case 0:
      for (std::size_t axis = 0; axis < 3; ++axis) list.lock(RowKind::kTurn, axis);
      return;
    case 1:
    case 2:
    case 4:
      for (std::size_t which = 0; which < 2; ++which)
        list.lock(RowKind::kAlign, static_cast<std::size_t>(std::countr_zero(free)), which);
      return;
    case 3: return list.lock(RowKind::kSquare, 0, 1);
    case 5: return list.lock(RowKind::kSquare, 0, 2);
    case 6: return list.lock(RowKind::kSquare, 1, 2);
    default: return;
  }
}

}  // namespace

std::uint32_t free_axes(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_DISTANCE && desc.limits[0].enabled == 0 && desc.springs[0].enabled == 0) return 0;
  std::uint32_t axes = backend::free_axes(desc.type);
  for (std::size_t axis = 0; desc.type == PLUMB_JOINT_GENERIC && axis < 6; ++axis)
    if (desc.axis_modes[axis] == PLUMB_AXIS_LOCKED) axes &= ~(1U << axis);
  return axes;
}

JointRows rows_of_joint(const PlumbJointDesc& desc) {
  require_free(desc);
  JointRows rows{};
  rows.type = plain_type(desc);
  rows.rows = rows_of(rows.type);
  rows.pulls = pulls_of(rows.type);
  const std::uint32_t free = free_axes(desc), turns = free >> 3;
  const bool pulls = desc.type == PLUMB_JOINT_DISTANCE;
  const bool meshes = backend::is_meshing(desc.type);
  rows.locks_turns = !pulls && !meshes && turns != 7;
  rows.axes.masses_alone = !pulls && !meshes && turns == 0 ? 1 : 0;
  RowList list(desc, rows);
  if (desc.type == PLUMB_JOINT_GEAR) list.mesh(RowKind::kGear);
  if (desc.type == PLUMB_JOINT_RACK_AND_PINION) list.mesh(RowKind::kRack);
  if (desc.type == PLUMB_JOINT_UNIVERSAL)
    for (std::size_t axis = 0; axis < 3; ++axis) list.lock(RowKind::kPoint, axis);
  if (desc.type == PLUMB_JOINT_GENERIC)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((free >> axis & 1U) == 0) list.lock(RowKind::kAlong, axis);
  if (desc.type == PLUMB_JOINT_UNIVERSAL || desc.type == PLUMB_JOINT_GENERIC) lock_turns(list, turns);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    rows.drive.velocity[axis] = static_cast<Real>(desc.motors[axis].target_velocity);
    rows.drive.max_force[axis] = static_cast<Real>(desc.motors[axis].enabled != 0 ? desc.motors[axis].max_force : 0);
    if ((free >> axis & 1U) == 0 || desc.type == PLUMB_JOINT_SWING_TWIST) continue;
    const RowKind kind = axis >= 3 ? RowKind::kAngle : pulls ? RowKind::kDistance : RowKind::kAlong;
    list.drive(kind, axis, axis >= 3 ? turns : 0);
  }
  if (desc.type == PLUMB_JOINT_SWING_TWIST) {
    list.drive(RowKind::kTwist, 3);
    list.bound_swing();
    for (std::size_t axis = 4; axis < 6; ++axis) list.drive(RowKind::kSwing, axis);
  }
  return rows;
}

}  // namespace plumb::impulse
