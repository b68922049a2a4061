// The step: that of DART's own world, with our forces, contacts and rows put in between.
#include <cmath>

#include "joints/joint_rows.hpp"
#include "world.hpp"

namespace plumb::dart6 {
namespace {

/// By a vector of axis times angle, world axes.
PlumbQuat turned(const PlumbQuat& q, const PlumbVec3& by) {
  const double angle = length(by), half = angle == 0 ? 0.5 : std::sin(angle / 2) / angle;
  return normalized(multiply({half * by.x, half * by.y, half * by.z, std::cos(angle / 2)}, q));
}

/// DART checks its numbers by assertions, which end the process: what is as large as this is stopped before.
constexpr double kTooLarge = 1e60, kShortest = 1e-30;
/// m, from the origin: ODE counts the cells of a quarter of a metre in which it looks for pairs by an int, and ends the
/// process where it cannot.
constexpr double kFarthest = 4e8;

}  // namespace

World::World(const WorldInit& init)
    : needs_(init.desc.needs), settings_(settings_table().values(init)), gravity_(init.desc.gravity) {}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  gravity_ = gravity;
  for (const auto& skeleton : skeletons_.all) skeleton->setGravity(eigen(gravity));
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  const double h = dt / settings_.substeps;
  if (h < kShortest)
    throw Error(PLUMB_E_INVALID_ARGUMENT,
                "a sub-step of " + std::to_string(dt) + " s / " + std::to_string(settings_.substeps) +
                    " is shorter than 1e-30 s, which DART cannot divide by; take a larger dt or fewer substeps");
  prepare();
  events_.clear();
  events_.swap(pending_events_);
  meeting_.impulses.clear();
  for (const auto& joint : joints_)
    if (joint) joint->force = joint->torque = {};
  for (const auto& skeleton : skeletons_.all) skeleton->setTimeStep(h);
  steer_kinematics(dt);
  for (sub_step_ = 0; sub_step_ < settings_.substeps; ++sub_step_) sub_step(h);
  settle_kinematics();
  read_state();
  finish_contacts();
  break_joints();
  touches_.finish_step(events_);
  backend::sort_events(events_);
  return PLUMB_OK;
}

/// As World::step of DART.
void World::sub_step(double h) {
  require_finite();
  apply_forces(h);
  for (const auto& skeleton : skeletons_.all) {
    if (!skeleton->isMobile()) continue;
    skeleton->computeForwardDynamics();
    skeleton->integrateVelocities(h);
  }
  std::vector<::dart::constraint::ConstraintBasePtr> constraints;
  find_contacts(h, constraints);
  add_holds(h, constraints);
  solver_.solve(settings_, h, constraints);
  for (const auto& skeleton : skeletons_.all) {
    if (!skeleton->isMobile() || !skeleton->isImpulseApplied()) continue;
    skeleton->computeImpulseForwardDynamics();
    skeleton->setImpulseApplied(false);
  }
  gather_impulses(h);
  gather_reactions(h);
  for (const auto& skeleton : skeletons_.all) {
    if (!skeleton->isMobile()) continue;
    skeleton->integratePositions(h);
    skeleton->clearExternalForces();
  }
  move_kinematics(h);
}

// --- kinematic bodies ------------------------------------------------------------------------------------------------

void World::steer_kinematics(double dt) {
  for (Body* body : skeletons_.bodies) {
    if (!body->is(PLUMB_KINEMATIC)) continue;
    if (body->moving == Body::Moving::to_target) {
      const PlumbQuat turn = multiply(body->target.orientation, backend::conjugate(body->pose.orientation));
      body->velocity = scale(1 / dt, sub(body->target.position, body->pose.position));
      body->spin = scale(1 / dt, backend::rotation_vector(turn));
    } else if (body->moving == Body::Moving::arrived) {
      body->velocity = body->spin = {};
      body->moving = Body::Moving::as_told;
    }
    place(*body);
  }
}

/// DART's joints of theirs are told how fast they move; where they are, so that it is exact, is ours.
void World::move_kinematics(double h) {
  for (Body* body : skeletons_.bodies) {
    if (!body->is(PLUMB_KINEMATIC)) continue;
    body->pose = {add(body->pose.position, scale(h, body->velocity)),
                  turned(body->pose.orientation, scale(h, body->spin))};
    place(*body);
  }
}

void World::settle_kinematics() {
  for (Body* body : skeletons_.bodies) {
    if (body->moving != Body::Moving::to_target) continue;
    body->pose = body->target;
    body->moving = Body::Moving::arrived;
    place(*body);
  }
  for (const auto& body : bodies_)
    if (body) body->force = body->torque = {};
}

// --- forces ----------------------------------------------------------------------------------------------------------

/// By sums, which are NaN where one of the numbers is.
void World::require_finite() const {
  const auto lose = [](const Body& body, const std::string& what) {
    throw Error(PLUMB_E_WORLD_LOST, "body " + std::to_string(slot_of(body.handle)) + " " + what +
                                        ", which DART does not survive; destroy the world and take a smaller dt, more "
                                        "substeps or smaller forces");
  };
  for (const Body* body : skeletons_.bodies) {
    const double away = body->node->getWorldTransform().translation().cwiseAbs().sum();
    if (!(away < kFarthest)) lose(*body, "is " + std::to_string(away) + " m away");
    if (body->is(PLUMB_STATIC)) continue;
    if (!(body->node->getSpatialVelocity().cwiseAbs().sum() < kTooLarge))
      lose(*body, "is faster than 1e60 m/s or rad/s");
    if (!(length(body->force) + length(body->torque) < kTooLarge)) lose(*body, "is pushed by more than 1e60 N or N m");
  }
}

/// The host's forces, gravity that is scaled, and damping, as a force that gives exp(-c h) whatever c is.
void World::apply_forces(double h) {
  for (const Body* body : skeletons_.bodies) {
    if (!body->is(PLUMB_DYNAMIC)) continue;
    const PlumbBodyDesc& desc = body->desc;
    PlumbVec3 force = add(body->force, scale((desc.gravity_scale - 1) * desc.mass, gravity_)), torque = body->torque;
    if (desc.linear_damping != 0 || desc.angular_damping != 0) {
      const auto rate = [h](double c) { return -(1 - std::exp(-c * h)) / h; };
      const PlumbQuat axes = multiply(pose_of(body->node->getWorldTransform()).orientation, desc.inertia_orientation);
      const PlumbVec3 w = unrotate(axes, vec(body->node->getAngularVelocity())), &i = desc.inertia;
      force = add(force, scale(rate(desc.linear_damping) * desc.mass, vec(body->node->getCOMLinearVelocity())));
      torque = add(torque, rotate(axes, scale(rate(desc.angular_damping), {i.x * w.x, i.y * w.y, i.z * w.z})));
    }
    body->node->addExtForce(eigen(force), body->node->getLocalCOM(), false, true);
    if (body->turns()) body->node->addExtTorque(eigen(torque), false);
  }
}

// --- joints that are no links, and locks -----------------------------------------------------------------------------

void World::add_holds(double h, std::vector<::dart::constraint::ConstraintBasePtr>& constraints) {
  holds_.clear();
  const auto node = [](const Body* body) { return body == nullptr ? nullptr : body->node; };
  for (const auto& joint : joints_) {
    if (!joint || joint->is_link) continue;
    holds_.push_back({joint.get(), std::make_shared<RowsConstraint>(node(joint->a), node(joint->b),
                                                                    joint_rows(*joint, settings_, h))});
    constraints.push_back(holds_.back().rows);
  }
  for (const Body* body : skeletons_.bodies)
    if (body->is(PLUMB_DYNAMIC) && body->desc.locks != 0)
      constraints.push_back(std::make_shared<RowsConstraint>(nullptr, body->node, lock_rows(*body)));
}

void World::gather_reactions(double h) {
  const double share = 1.0 / settings_.substeps;
  const auto take = [share](Joint& joint, const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
    joint.force = add(joint.force, scale(share, vec(force)));
    joint.torque = add(joint.torque, scale(share, vec(torque)));
  };
  const auto origin = [](const Joint& joint) { return eigen(frame_in_world(joint.b, joint.desc.frame_b).position); };
  for (const Body* body : skeletons_.bodies) {
    if (body->link == nullptr) continue;
    const Eigen::Isometry3d& pose = body->node->getWorldTransform();
    const Eigen::Vector6d& wrench = body->node->getBodyForce();  // that its joint gives it
    const double sign = body->reversed ? -1 : 1;
    const Eigen::Vector3d force = sign * (pose.linear() * wrench.tail<3>()),
                          torque = sign * (pose.linear() * wrench.head<3>());
    const Eigen::Vector3d arm = pose.translation() - origin(*body->link);
    take(*body->link, force, torque + arm.cross(force));
  }
  for (const Hold& hold : holds_) {
    const Eigen::Vector3d at = origin(*hold.joint);
    for (std::size_t i = 0; i < hold.rows->rows().size(); ++i) {
      const Row& row = hold.rows->rows()[i];
      const double size = hold.rows->impulses()[i] / h;
      take(*hold.joint, size * row.force_b, size * (row.torque_b + (row.at - at).cross(row.force_b)));
    }
  }
}

void World::break_joints() {
  std::vector<PlumbJoint> broken;
  for (const auto& joint : joints_) {
    if (!joint || !joint->may_break()) continue;
    const PlumbJointDesc& desc = joint->desc;
    const bool pulled = desc.break_force > 0 && length(joint->force) > desc.break_force;
    const bool bent = desc.break_torque > 0 && length(joint->torque) > desc.break_torque;
    if (!pulled && !bent) continue;
    events_.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, desc.body_a, desc.body_b, joint->handle});
    broken.push_back(joint->handle);
  }
  if (!broken.empty()) destroy_joints(broken);
}

// --- what came of it -------------------------------------------------------------------------------------------------

PlumbResult World::wait(PlumbStepReport& report) {
  report.contacts = static_cast<std::uint32_t>(meeting_.touching.size());
  if (std::exchange(solver_.fell_back, false)) report.remarks |= PLUMB_REMARK_SOLVER_FELL_BACK;
  for (const auto& body : bodies_)
    if (body && body->is(PLUMB_DYNAMIC)) ++report.awake;
  return PLUMB_OK;
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  settings_table().set(settings_, name, value);
  return PLUMB_OK;
}

}  // namespace plumb::dart6
