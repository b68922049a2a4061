// One step of the world, phase by phase.
#include <chrono>
#include <cmath>
#include <string>

#include "world.hpp"

namespace plumb::ode {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

/// quickstep draws from one random sequence for the whole process: a world brings its own seed, and nobody else may
/// draw meanwhile.
class OwnRandom {
 public:
  explicit OwnRandom(unsigned long& seed) : seed_(seed), lock_(mutex()) {
    others_ = dRandGetSeed();
    dRandSetSeed(seed);
  }
  OwnRandom(const OwnRandom&) = delete;
  OwnRandom& operator=(const OwnRandom&) = delete;
  ~OwnRandom() {
    seed_ = dRandGetSeed();
    dRandSetSeed(others_);
  }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  unsigned long& seed_;
  std::scoped_lock<std::mutex> lock_;
  unsigned long others_ = 0;
};

}  // namespace

PlumbResult World::step(double dt) {
  if (nonfinite_ != 0)
    throw Error(PLUMB_E_WORLD_LOST,
                std::to_string(nonfinite_) +
                    " bodies have become NaN or infinite, with which ODE cannot "
                    "go on; destroy the world and take a smaller dt, more substeps or another stepper");
  return inside_ode([&] {
    broad_narrow_seconds_ = solve_seconds_ = output_seconds_ = 0;
    contacts_.begin_step();
    events_.begin_step();
    substeps_left_ = settings_.substeps;
    set_substep(dt / substeps_left_);
    forget_reactions();
    steer_kinematics(dt);
    detect();
    if (!init_.needs(PLUMB_NEED_CONTACT_MODIFICATION)) finish_step();
    return PLUMB_OK;
  });
}

/// The first half of a sub-step.
void World::detect() {
  push_bodies();
  find_contacts();
}

/// The second half, and the first of the next.
void World::respond(std::span<const PlumbManifoldChange> changes) {
  contacts_.respond(changes);
  prepare_joints(substep_);
  count_idling(substep_);
  solve(substep_);
  gather(substep_, 1.0 / settings_.substeps);
  if (--substeps_left_ > 0) detect();
}

void World::finish_step() {
  while (substeps_left_ > 0) respond({});
  settle_kinematics();
  break_joints();
  look_for_nonfinite();
  note_sleep();
  contacts_.end_step(events_);
  events_.end_step();
}

PlumbResult World::read_manifolds(std::span<const PlumbManifold>& manifolds) {
  return inside_ode([&] {
    while (substeps_left_ > 0 && contacts_.shown().empty()) respond({});
    manifolds = substeps_left_ > 0 ? contacts_.shown() : std::span<const PlumbManifold>{};
    return PLUMB_OK;
  });
}

PlumbResult World::modify_manifolds(std::span<const PlumbManifoldChange> changes) {
  return inside_ode([&] {
    respond(changes);
    return PLUMB_OK;
  });
}

PlumbResult World::wait(PlumbStepReport& report) {
  if (init_.needs(PLUMB_NEED_CONTACT_MODIFICATION))
    inside_ode([&] {
      finish_step();
      return PLUMB_OK;
    });
  report.threads = static_cast<std::uint32_t>(settings_.threads);
  report.awake = awake_;
  report.pairs = contacts_.pair_count();
  report.contacts = contacts_.point_count();
  report.nonfinite = nonfinite_;
  report.phase_seconds[PLUMB_PHASE_BROAD] = broad_narrow_seconds_;
  report.phase_seconds[PLUMB_PHASE_SOLVE] = solve_seconds_;
  report.phase_seconds[PLUMB_PHASE_OUTPUT] = output_seconds_;
  return PLUMB_OK;
}

/// Damping and springs are worked out for a length of the sub-step.
void World::set_substep(double h) {
  if (h == substep_) return;
  substep_ = h;
  for (Body* body : damped_) set_damping(*body, h);
  for (Joint* joint : joint_order_)
    if (joint->solved()) set_parameters(*joint, settings_, h);
}

void World::forget_reactions() {
  for (Joint* joint : busy_joints_) joint->force = joint->torque = {};
}

void World::steer_kinematics(double dt) {
  for (Body* body : kinematic_) {
    if (body->moving == Body::Moving::to_target) head_for_target(*body, dt);
    if (body->moving == Body::Moving::arrived) {
      body->set_velocity({}, {});
      body->moving = Body::Moving::as_told;
    }
  }
  if (init_.needs(PLUMB_NEED_SLEEPING)) let_kinematics_rest();
}

/// A kinematic body that stands still is disabled: enabled, it would keep awake whatever lies on it.
void World::let_kinematics_rest() {
  for (Body* body : kinematic_) {
    const bool still = is_zero(body->linear_velocity()) && is_zero(body->angular_velocity());
    if (still) {
      dBodyDisable(body->body);
    } else if (body->asleep()) {
      dBodyEnable(body->body);
    }
  }
}

void World::push_bodies() {
  for (const Body* body : pushed_) {
    dBodyAddForce(body->body, body->force.x, body->force.y, body->force.z);
    dBodyAddTorque(body->body, body->torque.x, body->torque.y, body->torque.z);
  }
  for (const Body* body : weighed_) {
    if (body->asleep()) continue;
    const PlumbVec3 weight = scale(body->gravity_scale / body->inverse_mass, gravity_);
    dBodyAddForce(body->body, weight.x, weight.y, weight.z);
  }
}

void World::find_contacts() {
  contacts_.begin_substep();
  if (space_ == nullptr || !(init_.needs(PLUMB_NEED_COLLISION) || init_.needs(PLUMB_NEED_SENSORS))) return;
  const Stopwatch watch(broad_narrow_seconds_);
  contacts_.detect(space_);
}

void World::prepare_joints(double h) {
  const RowMaker rows{world_, contacts_.group(), settings_, h};
  for (Joint* joint : busy_joints_) prepare(*joint, rows);
}

/// ODE counts too, but does not tell; a snapshot has to know.
void World::count_idling(double h) {
  if (!init_.needs(PLUMB_NEED_SLEEPING | PLUMB_NEED_SNAPSHOT)) return;
  for (Body* body : dynamic_) body->count_idling(h);
}

void World::solve(double h) {
  const Stopwatch watch(solve_seconds_);
  int done = 0;
  if (settings_.stepper == Stepper::quickstep) {
    const OwnRandom random(seed_);
    done = dWorldQuickStep(world_, h);
  } else {
    done = dWorldStep(world_, h);
  }
  if (done == 0) throw Error(PLUMB_E_WORLD_LOST, "ODE ran out of memory in a step; destroy the world");
}

/// Impulses, reactions and locked axes of a sub-step that was solved.
void World::gather(double h, double share) {
  const Stopwatch watch(output_seconds_);
  contacts_.end_substep(h);
  for (Joint* joint : busy_joints_)
    if (joint->watched) take_reaction(*joint, share);
  for (const Body* body : locked_)
    if (!body->asleep()) project_locks(*body);
}

void World::settle_kinematics() {
  for (Body* body : kinematic_) {
    if (body->moving != Body::Moving::to_target) continue;
    body->set_frame(body->target);
    body->moving = Body::Moving::arrived;
  }
  for (Body* body : pushed_) {
    body->force = body->torque = {};
    body->pushed = false;
  }
  pushed_.clear();
  // Bounds are brought up to date now, not when first asked: so queries change nothing, not even the order of lists.
  if (space_ != nullptr) {
    const Stopwatch watch(broad_narrow_seconds_);
    dSpaceClean(space_);
  }
}

void World::break_joints() {
  for (std::size_t i = 0; i < busy_joints_.size();) {
    Joint& joint = *busy_joints_[i];
    if (joint.watched && overloaded(joint)) {
      events_.add_broken(joint.handle);
      remove_joint(joint);  // takes it from the list
    } else {
      ++i;
    }
  }
}

void World::note_sleep() {
  awake_ = static_cast<std::uint32_t>(dynamic_.size());
  if (!init_.needs(PLUMB_NEED_SLEEPING)) return;
  const bool tell = init_.needs(PLUMB_NEED_EVENTS);
  for (Body* body : dynamic_) {
    const bool awake = !body->asleep();
    if (!awake) --awake_;
    if (awake != body->was_awake && tell) events_.add(awake ? PLUMB_EVENT_WAKE : PLUMB_EVENT_SLEEP, body->handle);
    body->was_awake = awake;
  }
}

void World::look_for_nonfinite() {
  nonfinite_ = 0;
  for (const dBodyID body : dynamic_ids_) {
    const dReal *at = dBodyGetPosition(body), *q = dBodyGetQuaternion(body), *v = dBodyGetLinearVel(body),
                *w = dBodyGetAngularVel(body);
    double sum = q[3];  // one that is not finite leaves it so
    for (int i = 0; i < 3; ++i) sum += at[i] + q[i] + v[i] + w[i];
    if (!std::isfinite(sum)) ++nonfinite_;
  }
}

}  // namespace plumb::ode
