// Joints: our frames and axes as ODE's anchors and axes.
//
// ODE tells coordinates of its first body seen from its second, and its first body cannot be the world. So our b is the
// first, unless b is static: then a is, and angles, lengths and forces change their signs.
#pragma once

#include <ode/ode.h>

#include <array>

#include "bodies.hpp"
#include "settings.hpp"

namespace plumb::ode {

struct Joint {
  PlumbJoint handle = 0;
  PlumbJointDesc desc{};
  dJointID id = nullptr;  ///< null: nothing is solved, as it is not enabled, or neither body can be moved
  bool enabled = true;
  Body* a = nullptr;  ///< null: the world
  Body* b = nullptr;
  double spring_mass[6]{};  ///< kg or kg m2: the pair's effective mass on each axis with a spring
  bool watched = false;     ///< its feedback is read after each sub-step
  dJointFeedback feedback{};
  std::array<dJointFeedback, 5> row_feedbacks{};  ///< of the contact rows that the joint has in this sub-step
  std::size_t rows = 0;                           ///< how many those are
  PlumbVec3 arm{};              ///< from the first body's centre of mass to frame b, world axes, before the solver ran
  PlumbVec3 force{}, torque{};  ///< on b at frame b's origin, mean over the last step

  [[nodiscard]] bool solved() const { return id != nullptr; }
  [[nodiscard]] bool swapped() const { return b->body == nullptr; }
  [[nodiscard]] Body& first() const { return swapped() ? *a : *b; }
  [[nodiscard]] PlumbPose first_frame() const { return swapped() ? frame_a() : frame_b(); }
  [[nodiscard]] PlumbPose second_frame() const { return swapped() ? frame_b() : frame_a(); }
  /// ODE's second body; null: the world.
  [[nodiscard]] dBodyID second() const { return swapped() || a == nullptr ? nullptr : a->body; }
  [[nodiscard]] PlumbPose frame_a() const { return a == nullptr ? desc.frame_a : compose(a->frame(), desc.frame_a); }
  [[nodiscard]] PlumbPose frame_b() const { return compose(b->frame(), desc.frame_b); }
  [[nodiscard]] bool has_distance_limits() const {
    return desc.type == PLUMB_JOINT_DISTANCE && desc.limits[0].enabled != 0;
  }
  /// Whether the axis' spring, by stiffness, and a limit or motor share the one row that ODE's joint has for it: then
  /// who has it is settled in each sub-step.
  [[nodiscard]] bool spring_shares_row(std::size_t axis) const {
    return desc.springs[axis].enabled != 0 && desc.type != PLUMB_JOINT_DISTANCE && desc.type != PLUMB_JOINT_GENERIC &&
           (desc.limits[axis].enabled != 0 || desc.motors[axis].enabled != 0);
  }
  /// Whether prepare() has something to do in each sub-step.
  [[nodiscard]] bool needs_preparing() const {
    bool shares = false;
    for (std::size_t axis = 0; axis < 6; ++axis) shares = shares || spring_shares_row(axis);
    return shares || has_distance_limits() || desc.type == PLUMB_JOINT_GENERIC;
  }
};

/// Which joint types have the feature at all; the axes that have it are those that the type leaves free.
[[nodiscard]] bool joint_has(PlumbJointType type, PlumbJointFeature feature);

/// Throws PLUMB_E_UNSUPPORTED for axes that the type has not, or what one row of ODE cannot be at once.
void check_joint(const PlumbJointDesc& desc);

/// Makes the ODE joint of a checked descriptor.
void attach(Joint& joint, dWorldID world);

/// Hands limits, motors and springs to ODE; h is the sub-step, on which a spring's parameters depend.
void set_parameters(const Joint& joint, const Settings& settings, double h);

/// Where the rows of a sub-step go. h: its length, s.
struct RowMaker {
  dWorldID world;
  dJointGroupID group;
  const Settings& settings;
  double h;

  /// A contact between the joint's bodies at frame b's origin, made for its rows alone.
  void add(Joint& joint, dContact contact) const;
  /// One row that drives ODE's first body along `push` until `depth` is mended, and never holds it back.
  void add_push(Joint& joint, const PlumbVec3& push, double depth) const;
};

/// A spring of stiffness k and damping c as a soft constraint (ODE manual, "How to use ERP and CFM").
struct SoftRow {
  double erp, cfm;
};
[[nodiscard]] SoftRow soft_row(const PlumbSpring& spring, double mass, double h);

/// Before the solver: what a joint needs in each sub-step. A distance limit is a row along the line between the frames,
/// which may pull as well as push: a unilateral constraint on the distance. For the generic joint see
/// generic_joint.hpp.
void prepare(Joint& joint, const RowMaker& rows);
/// After the solver: adds `share` of the sub-step's reaction.
void take_reaction(Joint& joint, double share);
[[nodiscard]] bool overloaded(const Joint& joint);

/// The six coordinates; rotations as turns about x, then y, then z of the turned frame.
void read_coordinates(const Joint& joint, double* row);

}  // namespace plumb::ode
