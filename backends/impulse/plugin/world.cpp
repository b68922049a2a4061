#include "plugin/world.hpp"

#include <algorithm>

namespace plumb::impulse {

namespace {

SolverFeatures features_of(const WorldInit& init) {
  return {init.needs(PLUMB_NEED_ROTATION),
          init.needs(PLUMB_NEED_COLLISION),
          init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION),
          init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_RESTITUTION),
          init.needs(PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC),
          init.needs(PLUMB_NEED_CONTACT_IMPULSES),
          init.needs(PLUMB_NEED_SLEEPING),
          init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_CCD),
          init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SURFACE_VELOCITY)};
}

PlumbVec3 plumb_vec(const Position& p) { return {p.x, p.y, p.z}; }

}  // namespace

World::World(const WorldInit& init)
    : init_(init),
      simulation_(init.host, init.desc.threads, features_of(init)),
      settings_(settings_table().values(init)),
      gravity_(init.desc.gravity) {
  // The step with belts has the code of all joints, which reactions ask for.
  if (init.needs(PLUMB_NEED_JOINT_REACTIONS) || features_of(init).belts) simulation_.joints.want_reactions();
  if (init.desc.body_capacity != 0) simulation_.reserve_bodies(init.desc.body_capacity);
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  gravity_ = gravity;
  tell(PLUMB_EVENT_WAKE, simulation_.wake_all(), early_events_);
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  steer_kinematics(dt);
  dt_ = dt;
  records_known_ = false;
  parts_ = {};
  parts_.count = divides_for_ > 0 ? kParts : 1;
  divides_for_ -= dt;
  start(dt_ / parts_.count, parts_.count > 1 ? 1 : 0);
  return PLUMB_OK;
}

PlumbResult World::wait(PlumbStepReport& report) {
  events_.swap(early_events_);
  early_events_.clear();
  finish_steps();
  settle_kinematics();
  clear_forces();
  break_joints();
  if (init_.needs(PLUMB_NEED_EVENTS) || init_.needs(PLUMB_NEED_SENSORS)) find_events();
  const StepCounters& counters = simulation_.counters();
  report.threads = simulation_.executor().threads();
  report.pairs = simulation_.candidate_count();
  report.contacts = counters.points;
  report.dropped = 0;
  report.awake = dynamic_count_ - simulation_.sleeper_count();
  report.nonfinite = counters.nonfinite + stopped_ + parts_.nonfinite;
  for (PlumbPhase phase = 0; phase < PLUMB_PHASE_COUNT; ++phase)
    report.phase_seconds[phase] = simulation_.phase_seconds(phase);
  stopped_ = 0;
  if (parts_.gained) report.remarks |= PLUMB_REMARK_ENERGY_BOUNDED;
  if (parts_.repeated) report.remarks |= PLUMB_REMARK_STEP_REPEATED;
  if (parts_.grew) report.remarks |= PLUMB_REMARK_CAPACITY_GREW;
  return parts_.grew ? PLUMB_GROWN : PLUMB_OK;
}

/// A kinematic body that is sent somewhere gets the velocity that leads there in one step; one that has arrived rests.
void World::steer_kinematics(double dt) {
  steered_.remove_if([&](std::uint32_t slot) { return bodies_[slot].id == 0; });
  simulation_.bodies.state.fetch(steered_.all(), kPosePart);
  for (const std::uint32_t slot : steered_) {
    BodyRecord& body = bodies_[slot];
    Velocity& velocity = simulation_.bodies.state.velocity[slot];
    if (body.to_target) {
      const PlumbPose from = pose(slot);
      const auto rate = [dt](double to, double at) { return static_cast<Real>((to - at) / dt); };
      velocity.linear = {rate(body.target.position.x, from.position.x), rate(body.target.position.y, from.position.y),
                         rate(body.target.position.z, from.position.z)};
      velocity.angular = angular_velocity_between(from.orientation, body.target.orientation, dt);
    } else if (body.arrived) {
      velocity.linear = velocity.angular = {0, 0, 0};
      body.arrived = false;
    }
    simulation_.bodies.state.touch(slot, kVelocityPart);
  }
  steered_.remove_if([&](std::uint32_t slot) { return !bodies_[slot].to_target; });
}

void World::settle_kinematics() {
  for (const std::uint32_t slot : steered_) {
    BodyRecord& body = bodies_[slot];
    if (body.id == 0 || !body.to_target) continue;
    place(slot, body.target);
    body.to_target = false;
    body.arrived = true;
  }
}

void World::clear_forces() {
  for (const std::uint32_t slot : pushed_) simulation_.bodies.force.edit(slot) = {};
  pushed_.clear();
}

const std::vector<ContactRecord>& World::records() {
  if (!records_known_) {
    records_ = simulation_.contacts();
    records_.insert(records_.end(), parts_.contacts.begin(), parts_.contacts.end());
  }
  records_known_ = true;
  return records_;
}

void World::find_events() {
  if (init_.needs(PLUMB_NEED_EVENTS)) find_touches();
  if (!sensors_.empty()) sense();
  touches_.finish_step(events_);
  backend::sort_events(events_);
}

void World::find_touches() {
  for (const ContactRecord& record : records())
    for (std::uint32_t p = 0; p < record.count; ++p)
      if (record.separation[p] <= 0 || record.normal_impulse[p] > 0) {
        touches_.touch(bodies_[record.bodies.a].id, bodies_[record.bodies.b].id);
        break;
      }
}

std::span<const PlumbContact> World::contacts() {
  contacts_.clear();
  const bool impulses = init_.needs(PLUMB_NEED_CONTACT_IMPULSES);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const ContactRecord& record : records())
    for (std::uint32_t p = 0; p < record.count; ++p) {
      PlumbContact contact{};
      contact.body_a = bodies_[record.bodies.a].id;
      contact.body_b = bodies_[record.bodies.b].id;
      contact.child_a = child_of(record.pair.a, record.part);
      contact.child_b = child_of(record.pair.b, record.part);
      contact.position = plumb_vec(record.position[p]);
      contact.normal = to_plumb(record.normal);
      contact.depth = -static_cast<double>(record.separation[p]);
      contact.normal_impulse = impulses ? static_cast<double>(record.normal_impulse[p]) : unknown;
      contact.tangent_impulse = impulses ? to_plumb(record.tangent_impulse[p]) : PlumbVec3{unknown, unknown, unknown};
      contact.feature = record.feature[p] + std::uint64_t{1};
      contacts_.push_back(contact);
    }
  return contacts_;
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  settings_table().set(settings_, name, value);
  return PLUMB_OK;
}

}  // namespace plumb::impulse
