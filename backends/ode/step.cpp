// One step of the world, phase by phase.
#include <chrono>
#include <cmath>
#include <string>

#include "plumb/assert.hpp"
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
  if (figures_.nonfinite != 0)
    throw Error(PLUMB_E_WORLD_LOST,
                std::to_string(figures_.nonfinite) +
                    " bodies have become NaN or infinite, with which ODE cannot "
                    "go on; destroy the world and take a smaller dt, more substeps or another stepper");
  PLUMB_ASSERT(substep_.left == 0);  // the step before was waited for
  return inside_ode([&] {
    figures_.broad_narrow_seconds = figures_.solve_seconds = figures_.output_seconds = 0;
    contacts_.begin_step();
    events_.begin_step();
    substep_.left = settings_.substeps;
    set_substep(dt / substep_.left);
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
  PLUMB_ASSERT(substep_.left > 0);
  contacts_.respond(changes);
  prepare_joints(substep_.h);
  count_idling(substep_.h);
  solve(substep_.h);
  gather(substep_.h, 1.0 / settings_.substeps);
  if (--substep_.left > 0) detect();
}

void World::finish_step() {
  while (substep_.left > 0) respond({});
  settle_kinematics();
  break_joints();
  look_for_nonfinite();
  note_sleep();
  contacts_.end_step(events_);
  events_.end_step();
}

PlumbResult World::read_manifolds(std::span<const PlumbManifold>& manifolds) {
  return inside_ode([&] {
    while (substep_.left > 0 && contacts_.shown().empty()) respond({});
    manifolds = substep_.left > 0 ? contacts_.shown() : std::span<const PlumbManifold>{};
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
  report.awake = figures_.awake;
  report.pairs = contacts_.pair_count();
  report.contacts = contacts_.point_count();
  report.nonfinite = figures_.nonfinite;
  report.phase_seconds[PLUMB_PHASE_BROAD] = figures_.broad_narrow_seconds;
  report.phase_seconds[PLUMB_PHASE_SOLVE] = figures_.solve_seconds;
  report.phase_seconds[PLUMB_PHASE_OUTPUT] = figures_.output_seconds;
  return PLUMB_OK;
}

/// Damping and springs are worked out for a length of the sub-step.
void World::set_substep(double h) {
  if (h == substep_.h) return;
  substep_.h = h;
  for (Body* body : lists_.damped) set_damping(*body, h);
  for (Joint* joint : joint_lists_.all)
    if (joint->solved()) set_parameters(*joint, settings_, h);
}

void World::forget_reactions() {
  for (Joint* joint : joint_lists_.busy) joint->force = joint->torque = {};
}

void World::steer_kinematics(double dt) {
  for (Body* body : lists_.kinematic) {
    if (body->target.moving == Body::Moving::to_target) head_for_target(*body, dt);
    if (body->target.moving == Body::Moving::arrived) {
      body->set_velocity({}, {});
      body->target.moving = Body::Moving::as_told;
    }
  }
  if (init_.needs(PLUMB_NEED_SLEEPING)) let_kinematics_rest();
}

/// A kinematic body that stands still is disabled: enabled, it would keep awake whatever lies on it.
void World::let_kinematics_rest() {
  for (Body* body : lists_.kinematic) {
    const bool still = is_zero(body->linear_velocity()) && is_zero(body->angular_velocity());
    if (still) {
      dBodyDisable(body->body);
    } else if (body->asleep()) {
      dBodyEnable(body->body);
    }
  }
}

void World::push_bodies() {
  for (const Body* body : lists_.pushed) {
    PLUMB_ASSERT(body->dynamic() && body->push.any);
    dBodyAddForce(body->body, body->push.force.x, body->push.force.y, body->push.force.z);
    dBodyAddTorque(body->body, body->push.torque.x, body->push.torque.y, body->push.torque.z);
  }
  for (const Body* body : lists_.weighed) {
    if (body->asleep()) continue;
    const PlumbVec3 weight = scale(body->gravity_scale / body->mass.inverse, gravity_);
    dBodyAddForce(body->body, weight.x, weight.y, weight.z);
  }
}

void World::find_contacts() {
  contacts_.begin_substep();
  if (space_ == nullptr || !(init_.needs(PLUMB_NEED_COLLISION) || init_.needs(PLUMB_NEED_SENSORS))) return;
  const Stopwatch watch(figures_.broad_narrow_seconds);
  contacts_.detect(space_);
}

void World::prepare_joints(double h) {
  const RowMaker rows{world_, contacts_.group(), settings_, h};
  for (Joint* joint : joint_lists_.busy) prepare(*joint, rows);
}

/// ODE counts too, but does not tell; a snapshot has to know.
void World::count_idling(double h) {
  if (!init_.needs(PLUMB_NEED_SLEEPING | PLUMB_NEED_SNAPSHOT)) return;
  for (Body* body : lists_.dynamic) body->count_idling(h);
}

void World::solve(double h) {
  PLUMB_ASSERT(h > 0);
  const Stopwatch watch(figures_.solve_seconds);
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
  const Stopwatch watch(figures_.output_seconds);
  contacts_.end_substep(h);
  for (Joint* joint : joint_lists_.busy) {
    PLUMB_ASSERT(joint->solved());
    if (joint->watched) take_reaction(*joint, share);
  }
  for (const Body* body : lists_.locked)
    if (!body->asleep()) project_locks(*body);
}

void World::settle_kinematics() {
  for (Body* body : lists_.kinematic) {
    if (body->target.moving != Body::Moving::to_target) continue;
    body->set_frame(body->target.pose);
    body->target.moving = Body::Moving::arrived;
  }
  for (Body* body : lists_.pushed) body->push = {};
  lists_.pushed.clear();
  // Bounds are brought up to date now, not when first asked: so queries change nothing, not even the order of lists.
  if (space_ != nullptr) {
    const Stopwatch watch(figures_.broad_narrow_seconds);
    dSpaceClean(space_);
  }
}

void World::break_joints() {
  for (std::size_t i = 0; i < joint_lists_.busy.size();) {
    Joint& joint = *joint_lists_.busy[i];
    if (joint.watched && overloaded(joint)) {
      events_.add_broken(joint.handle);
      remove_joint(joint);  // takes it from the list
    } else {
      ++i;
    }
  }
}

void World::note_sleep() {
  figures_.awake = static_cast<std::uint32_t>(lists_.dynamic.size());
  if (!init_.needs(PLUMB_NEED_SLEEPING)) return;
  const bool tell = init_.needs(PLUMB_NEED_EVENTS);
  for (Body* body : lists_.dynamic) {
    const bool awake = !body->asleep();
    if (!awake) --figures_.awake;
    if (awake != body->sleep.was_awake && tell) events_.add(awake ? PLUMB_EVENT_WAKE : PLUMB_EVENT_SLEEP, body->handle);
    body->sleep.was_awake = awake;
  }
}

void World::look_for_nonfinite() {
  PLUMB_ASSERT(lists_.dynamic_ids.size() == lists_.dynamic.size());
  figures_.nonfinite = 0;
  for (const dBodyID body : lists_.dynamic_ids) {
    const dReal *at = dBodyGetPosition(body), *q = dBodyGetQuaternion(body), *v = dBodyGetLinearVel(body),
                *w = dBodyGetAngularVel(body);
    double sum = q[3];  // one that is not finite leaves it so
    for (int i = 0; i < 3; ++i) sum += at[i] + q[i] + v[i] + w[i];
    if (!std::isfinite(sum)) ++figures_.nonfinite;
  }
}

}  // namespace plumb::ode
