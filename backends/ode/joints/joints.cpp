// One function a joint type where they differ; limits, motors and springs are the same rows for all.
#include "joints/joints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "joints/generic_joint.hpp"
#include "plumb/assert.hpp"
#include "plumb/backend/names.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace plumb::ode {
namespace {

/// Frames nearer than this, in metres and radians, coincide.
constexpr double together = 1e-12;

PlumbVec3 axis_of(const PlumbPose& frame, std::size_t axis) {
  return rotate(frame.orientation, {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0});
}

bool coincide(const PlumbPose& a, const PlumbPose& b) {
  return length(sub(a.position, b.position)) < together &&
         length(rotation_vector(multiply(b.orientation, conjugate(a.orientation)))) < together;
}

/// ODE takes the joint's frames from where the bodies stand: puts the first where its frame lies on the second's,
/// calls, puts it back.
template <class Set>
void with_frames_together(const Joint& joint, Set&& set) {
  if (coincide(joint.frame_a(), joint.frame_b())) return set();
  const Body& first = joint.first();
  const PlumbVec3 at = first.centre();
  const PlumbQuat q = first.orientation();
  const PlumbPose own = joint.swapped() ? joint.desc.frame_a : joint.desc.frame_b;
  const PlumbPose frame = compose(joint.second_frame(), inverse(own));
  const PlumbVec3 centre = add(frame.position, rotate(frame.orientation, first.mass.centre));
  dBodySetPosition(first.body, centre.x, centre.y, centre.z);
  dBodySetQuaternion(first.body, OdeQuaternion(frame.orientation).wxyz);
  set();
  dBodySetPosition(first.body, at.x, at.y, at.z);
  dBodySetQuaternion(first.body, OdeQuaternion(q).wxyz);
}

/// The axes that a type leaves free and has rows for, as bits: ODE's ball joint has none.
unsigned free_axes(PlumbJointType type) { return type == PLUMB_JOINT_BALL ? 0 : backend::free_axes(type); }

/// Those of one joint.
unsigned free_axes(const PlumbJointDesc& desc) {
  unsigned axes = free_axes(desc.type);
  for (std::size_t axis = 0; desc.type == PLUMB_JOINT_GENERIC && axis < 6; ++axis)
    if (desc.axis_modes[axis] == PLUMB_AXIS_LOCKED) axes &= ~(1u << axis);
  return axes;
}

/// ODE's limit and motor row of one of our axes.
void set_parameter(const Joint& joint, std::size_t axis, int parameter, double value) {
  switch (joint.desc.type) {
    case PLUMB_JOINT_HINGE: return dJointSetHingeParam(joint.id, parameter, value);
    case PLUMB_JOINT_SLIDER: return dJointSetSliderParam(joint.id, parameter, value);
    // Our x is a's axis, our y is b's; ODE's first axis is the first body's.
    case PLUMB_JOINT_UNIVERSAL:
      return dJointSetUniversalParam(joint.id,
                                     parameter + ((axis == 3) == joint.swapped() ? dParamGroup1 : dParamGroup2), value);
    default: return;
  }
}

/// Mass against which a force along (or a torque about) the axis works, with nothing else holding the bodies.
double effective_mass(const Joint& joint, std::size_t axis) {
  const PlumbPose a = joint.frame_a(), b = joint.frame_b();
  double inverse = 0;
  const auto turning = [&](const Body& body, const PlumbVec3& n) { return dot(n, body.inverse_inertia_times(n)); };
  if (axis >= 3) {
    const PlumbVec3 n = axis == 3 ? axis_of(a, 0) : axis_of(b, axis - 3);
    inverse = turning(*joint.b, n) + (joint.a == nullptr ? 0 : turning(*joint.a, n));
  } else if (joint.desc.type == PLUMB_JOINT_DISTANCE || joint.desc.type == PLUMB_JOINT_GENERIC) {
    const bool generic = joint.desc.type == PLUMB_JOINT_GENERIC;
    const PlumbVec3 way = sub(b.position, a.position);
    const PlumbVec3 n = !generic && length(way) > together ? normalized(way) : axis_of(a, generic ? axis : 0);
    inverse = joint.b->mass.inverse + turning(*joint.b, cross(sub(b.position, joint.b->centre()), n));
    if (joint.a != nullptr)
      inverse += joint.a->mass.inverse +
                 turning(*joint.a, cross(sub(generic ? b.position : a.position, joint.a->centre()), n));
  } else {
    inverse = joint.b->mass.inverse + (joint.a == nullptr ? 0 : joint.a->mass.inverse);
  }
  return 1 / inverse;
}

void set_row(const Joint& joint, std::size_t axis, const Settings& settings, double h) {
  const PlumbLimit& limit = joint.desc.limits[axis];
  const PlumbMotor& motor = joint.desc.motors[axis];
  const PlumbSpring& spring = joint.desc.springs[axis];
  double erp = settings.erp, cfm = settings.cfm, lower = -dInfinity, upper = dInfinity;
  double velocity = motor.target_velocity;
  if (spring.enabled != 0 && !joint.spring_shares_row(axis)) {
    const SoftRow row = soft_row(spring, joint.spring_mass[axis], h);
    erp = row.erp;
    cfm = row.cfm;
    lower = upper = spring.rest;
  } else if (limit.enabled != 0) {
    lower = limit.lower;
    upper = limit.upper;
  }
  if (joint.swapped()) {
    velocity = -velocity;
    lower = std::exchange(upper, -lower);
    lower = -lower;
  }
  set_parameter(joint, axis, dParamLoStop, lower);
  set_parameter(joint, axis, dParamHiStop, upper);
  set_parameter(joint, axis, dParamStopERP, erp);
  set_parameter(joint, axis, dParamStopCFM, cfm);
  set_parameter(joint, axis, dParamCFM, settings.cfm);
  set_parameter(joint, axis, dParamVel, velocity);
  set_parameter(joint, axis, dParamFMax, motor.enabled != 0 ? motor.max_force : 0);
}

}  // namespace

SoftRow soft_row(const PlumbSpring& spring, double mass, double h) {
  PLUMB_ASSERT(mass > 0 && h > 0);
  const bool by_stiffness = spring.mode == PLUMB_SPRING_STIFFNESS;
  const double rate = 2 * std::numbers::pi * spring.frequency;
  const double k = by_stiffness ? spring.frequency : mass * rate * rate;
  const double c = by_stiffness ? spring.damping_ratio : 2 * mass * spring.damping_ratio * rate;
  constexpr double kNothing = 1e-9;  // of a spring that holds nothing: ODE has no row of infinite softness
  const double both = std::max(h * k + c, kNothing);
  return {h * k / both, 1 / both};
}

bool joint_has(PlumbJointType type, PlumbJointFeature feature) {
  switch (feature) {
    case PLUMB_JOINT_HAS_LIMITS:
    case PLUMB_JOINT_HAS_SPRINGS:
    case PLUMB_JOINT_HAS_STIFFNESS:
    case PLUMB_JOINT_HAS_TARGETS: return free_axes(type) != 0;
    case PLUMB_JOINT_HAS_MOTORS: return free_axes(type) != 0 && type != PLUMB_JOINT_DISTANCE;
    default: return true;
  }
}

void check_joint(const PlumbJointDesc& desc) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const bool generic = desc.type == PLUMB_JOINT_GENERIC;
    const bool limit = generic ? desc.axis_modes[axis] == PLUMB_AXIS_LIMITED : desc.limits[axis].enabled != 0;
    const bool motor = desc.motors[axis].enabled != 0, spring = desc.springs[axis].enabled != 0;
    const std::string what = std::string("a ") + backend::joint_name(desc.type) + " joint";
    if ((limit || motor || spring) && (free_axes(desc) >> axis & 1u) == 0)
      throw Error(PLUMB_E_UNSUPPORTED, what + " of ODE has no limit, motor or spring on axis " + std::to_string(axis));
    const bool has_one_row =
        desc.type != PLUMB_JOINT_DISTANCE && (generic || desc.springs[axis].mode == PLUMB_SPRING_FREQUENCY);
    if (spring && (limit || motor) && has_one_row)
      throw Error(PLUMB_E_UNSUPPORTED, what + " of ODE has one row for axis " + std::to_string(axis) +
                                           ": a spring leaves no room for a limit or motor; use a second joint" +
                                           (generic ? "" : ", or give the spring by its stiffness"));
  }
  const PlumbLimit& distance = desc.limits[0];
  if (desc.type == PLUMB_JOINT_DISTANCE && distance.enabled != 0 && distance.lower < 0)
    throw Error(PLUMB_E_INVALID_ARGUMENT, "limits[0].lower of a distance joint is " + std::to_string(distance.lower) +
                                              "; it must not be below 0");
}

void attach(Joint& joint, dWorldID world) {
  const auto make = [&](dJointID (*create)(dWorldID, dJointGroupID)) {
    joint.id = create(world, nullptr);
    dJointAttach(joint.id, joint.first().body, joint.second());
  };
  const auto anchor = [&](void (*set)(dJointID, dReal, dReal, dReal), const PlumbVec3& at) {
    set(joint.id, at.x, at.y, at.z);
  };
  switch (joint.desc.type) {
    case PLUMB_JOINT_BALL:
      make(dJointCreateBall);
      anchor(dJointSetBallAnchor, joint.first_frame().position);
      if (length(sub(joint.frame_a().position, joint.frame_b().position)) > together)
        anchor(dJointSetBallAnchor2, joint.second_frame().position);
      break;
    case PLUMB_JOINT_HINGE:
      make(dJointCreateHinge);
      with_frames_together(joint, [&] {
        anchor(dJointSetHingeAnchor, joint.first_frame().position);
        anchor(dJointSetHingeAxis, axis_of(joint.first_frame(), 0));
      });
      break;
    case PLUMB_JOINT_SLIDER:
      make(dJointCreateSlider);
      with_frames_together(joint, [&] { anchor(dJointSetSliderAxis, axis_of(joint.first_frame(), 0)); });
      break;
    case PLUMB_JOINT_FIXED:
      make(dJointCreateFixed);
      with_frames_together(joint, [&] { dJointSetFixed(joint.id); });
      break;
    case PLUMB_JOINT_UNIVERSAL:
      make(dJointCreateUniversal);
      with_frames_together(joint, [&] {
        anchor(dJointSetUniversalAnchor, joint.first_frame().position);
        const bool swapped = joint.swapped();
        anchor(dJointSetUniversalAxis1, swapped ? axis_of(joint.frame_a(), 0) : axis_of(joint.frame_b(), 1));
        anchor(dJointSetUniversalAxis2, swapped ? axis_of(joint.frame_b(), 1) : axis_of(joint.frame_a(), 0));
      });
      break;
    case PLUMB_JOINT_DISTANCE:
      // With limits the contact rows of prepare() do all the work, unless there is a spring as well.
      if (joint.has_distance_limits() && joint.desc.springs[0].enabled == 0) {
        make(dJointCreateNull);
        break;
      }
      make(dJointCreateDBall);
      anchor(dJointSetDBallAnchor1, joint.first_frame().position);
      anchor(dJointSetDBallAnchor2, joint.second_frame().position);
      dJointSetDBallDistance(joint.id, joint.desc.rest_length);
      break;
    case PLUMB_JOINT_GENERIC:
      make(dJointCreateAMotor);
      prepare_motor(joint);
      break;
    default:
      throw Error(PLUMB_E_UNSUPPORTED, std::string("ODE has no ") + backend::joint_name(joint.desc.type) + " joint");
  }
  if (joint.watched) dJointSetFeedback(joint.id, &joint.feedback);
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (joint.desc.springs[axis].enabled != 0) joint.spring_mass[axis] = effective_mass(joint, axis);
}

void set_parameters(const Joint& joint, const Settings& settings, double h) {
  switch (joint.desc.type) {
    case PLUMB_JOINT_GENERIC: return;  // prepare() tells all of it in each sub-step
    case PLUMB_JOINT_BALL:
      dJointSetBallParam(joint.id, dParamERP, settings.erp);
      return dJointSetBallParam(joint.id, dParamCFM, settings.cfm);
    case PLUMB_JOINT_FIXED:
      dJointSetFixedParam(joint.id, dParamERP, settings.erp);
      return dJointSetFixedParam(joint.id, dParamCFM, settings.cfm);
    case PLUMB_JOINT_DISTANCE: {
      if (dJointGetType(joint.id) != dJointTypeDBall) return;
      dJointSetDBallDistance(joint.id, joint.desc.rest_length);
      const bool soft = joint.desc.springs[0].enabled != 0;
      SoftRow row{settings.erp, settings.cfm};
      if (soft) row = soft_row(joint.desc.springs[0], joint.spring_mass[0], h);
      dJointSetDBallParam(joint.id, dParamERP, row.erp);
      return dJointSetDBallParam(joint.id, dParamCFM, row.cfm);
    }
    default:
      for (std::size_t axis = 0; axis < 6; ++axis)
        if ((free_axes(joint.desc.type) >> axis & 1u) != 0) set_row(joint, axis, settings, h);
  }
}

void RowMaker::add(Joint& joint, dContact contact) const {
  const PlumbVec3 at = joint.frame_b().position;
  contact.geom.pos[0] = at.x;
  contact.geom.pos[1] = at.y;
  contact.geom.pos[2] = at.z;
  PLUMB_ASSERT(joint.rows < joint.row_feedbacks.size());
  const dJointID row = dJointCreateContact(world, group, &contact);
  dJointAttach(row, joint.first().body, joint.second());
  if (joint.watched) dJointSetFeedback(row, &joint.row_feedbacks[joint.rows]);
  ++joint.rows;
}

void RowMaker::add_push(Joint& joint, const PlumbVec3& push, double depth) const {
  dContact contact{};
  contact.surface.mode = dContactSoftERP | dContactSoftCFM;
  contact.surface.soft_erp = settings.erp;
  contact.surface.soft_cfm = settings.cfm;
  contact.geom.depth = depth;
  contact.geom.normal[0] = push.x;
  contact.geom.normal[1] = push.y;
  contact.geom.normal[2] = push.z;
  add(joint, contact);
}

namespace {

/// Of ODE's joint, and so of its first body seen from its second: the coordinate of one of our axes, and its rate.
struct Motion {
  double at, rate;
};
Motion motion_of(const Joint& joint, std::size_t axis) {
  const dJointID id = joint.id;
  switch (joint.desc.type) {
    case PLUMB_JOINT_HINGE: return {dJointGetHingeAngle(id), dJointGetHingeAngleRate(id)};
    case PLUMB_JOINT_SLIDER: return {dJointGetSliderPosition(id), dJointGetSliderPositionRate(id)};
    default:
      return (axis == 3) == joint.swapped() ? Motion{dJointGetUniversalAngle1(id), dJointGetUniversalAngle1Rate(id)}
                                            : Motion{dJointGetUniversalAngle2(id), dJointGetUniversalAngle2Rate(id)};
  }
}

void push(const Joint& joint, std::size_t axis, double force) {
  switch (joint.desc.type) {
    case PLUMB_JOINT_HINGE: return dJointAddHingeTorque(joint.id, force);
    case PLUMB_JOINT_SLIDER: return dJointAddSliderForce(joint.id, force);
    default: {
      const bool first = (axis == 3) == joint.swapped();
      return dJointAddUniversalTorques(joint.id, first ? force : 0, first ? 0 : force);
    }
  }
}

/// Between its limits the one row that ODE has for the axis is a motor as soft as the spring, at a limit or beside a
/// motor the spring is a force: implicit against the mass of the two bodies by themselves, than which no less moves.
void drive_spring(const Joint& joint, std::size_t axis, double h) {
  const PlumbSpring& spring = joint.desc.springs[axis];
  const PlumbLimit& limit = joint.desc.limits[axis];
  const Motion now = motion_of(joint, axis);
  const double sign = joint.swapped() ? -1 : 1, x = sign * now.at;
  double off = x - spring.rest;
  if (axis >= 3) off = std::remainder(off, 2 * std::numbers::pi);
  const double drag = spring.damping_ratio + h * spring.frequency;
  if (joint.desc.motors[axis].enabled == 0) {
    const bool between = x > limit.lower && x < limit.upper && drag > 0;
    set_parameter(joint, axis, dParamFMax, between ? dInfinity : 0);
    set_parameter(joint, axis, dParamVel, between ? -sign * spring.frequency * off / drag : 0);
    if (between) return set_parameter(joint, axis, dParamCFM, 1 / drag);
  }
  const double damped = spring.frequency * off + drag * sign * now.rate;
  push(joint, axis, -sign * damped / (1 + h * drag / joint.spring_mass[axis]));
}

}  // namespace

void prepare(Joint& joint, const RowMaker& rows) {
  PLUMB_ASSERT(joint.solved() && rows.h > 0);
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (joint.spring_shares_row(axis)) drive_spring(joint, axis, rows.h);
  joint.rows = 0;
  const PlumbPose frame_b = joint.frame_b();
  joint.arm = sub(frame_b.position, joint.first().centre());
  if (joint.desc.type == PLUMB_JOINT_GENERIC) return prepare_generic(joint, rows);
  if (!joint.has_distance_limits()) return;
  const PlumbLimit& limit = joint.desc.limits[0];
  const PlumbVec3 way = sub(frame_b.position, joint.frame_a().position);
  const double distance = length(way);
  const bool far = distance >= limit.upper;
  if (!far && distance > limit.lower) return;
  const PlumbVec3 out = distance > together ? scale(1 / distance, way) : axis_of(joint.frame_a(), 0);
  rows.add_push(joint, scale(far == joint.swapped() ? 1 : -1, out),
                far ? distance - limit.upper : limit.lower - distance);
}

void take_reaction(Joint& joint, double share) {
  PLUMB_ASSERT(joint.watched && joint.rows <= joint.row_feedbacks.size());
  const double on_b = joint.swapped() ? -share : share;
  const auto take = [&](const dJointFeedback& feedback) {
    const PlumbVec3 force = vec(feedback.f1);
    joint.force = add(joint.force, scale(on_b, force));
    joint.torque = add(joint.torque, scale(on_b, sub(vec(feedback.t1), cross(joint.arm, force))));
  };
  take(joint.feedback);
  for (std::size_t i = 0; i < joint.rows; ++i) take(joint.row_feedbacks[i]);
}

bool overloaded(const Joint& joint) {
  const auto above = [](const PlumbVec3& load, double strength) { return strength > 0 && length(load) > strength; };
  return above(joint.force, joint.desc.break_force) || above(joint.torque, joint.desc.break_torque);
}

void read_coordinates(const Joint& joint, double* row) {
  const PlumbPose relative = compose(inverse(joint.frame_a()), joint.frame_b());
  const Matrix3 r = backend::rotation_matrix(relative.orientation);
  row[0] = relative.position.x;
  row[1] = relative.position.y;
  row[2] = relative.position.z;
  row[3] = std::atan2(-r[1][2], r[2][2]);
  row[4] = std::asin(std::clamp(r[0][2], -1.0, 1.0));
  row[5] = std::atan2(-r[0][1], r[0][0]);
}

}  // namespace plumb::ode
