#include "plugin/world.hpp"

#include <algorithm>

#include "plugin/ranges.hpp"

namespace plumb::impulse {

namespace {

SolverFeatures features_of(const WorldInit& init) {
  return {.rotation = init.needs(PLUMB_NEED_ROTATION),
          .collision = init.needs(PLUMB_NEED_COLLISION),
          .friction = init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION),
          .restitution = init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_RESTITUTION),
          .gyroscopic = init.needs(PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC),
          .contact_impulses = init.needs(PLUMB_NEED_CONTACT_IMPULSES),
          .sleeping = init.needs(PLUMB_NEED_SLEEPING),
          .continuous = init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_CCD),
          .surface_velocity = init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SURFACE_VELOCITY),
          .contact_modification = init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_CONTACT_MODIFICATION),
          .rolling_friction = init.needs(PLUMB_NEED_COLLISION | PLUMB_NEED_ROTATION | PLUMB_NEED_ROLLING_FRICTION)};
}

/// Steps are divided from the start for so long after one that made energy: what moves so that whole steps do goes on
/// to for a while. s
constexpr double kStaysDivided = 0.5;

}  // namespace

World::World(const WorldInit& init)
    : init_(init),
      simulation_(init.host, init.desc.threads, features_of(init)),
      settings_(settings_table().values(init)),
      gravity_(init.desc.gravity) {
  // The step with surface effects has the code of all joints, which reactions ask for.
  if (init.needs(PLUMB_NEED_JOINT_REACTIONS) || features_of(init).has_surface_effects())
    simulation_.joints.want_reactions();
  if (init.desc.body_capacity != 0) simulation_.reserve_bodies(init.desc.body_capacity);
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  gravity_ = gravity;
  tell(PLUMB_EVENT_WAKE, simulation_.wake_all(), told_.early_events);
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  require_step(dt);
  steer_kinematics(dt);
  pacing_.dt = dt;
  told_.records_known = told_.contacts_known = false;
  pacing_.parts = {};
  told_.events.swap(told_.early_events);
  told_.early_events.clear();
  if (pacing_.divides_for > 0)
    divide({dt, 0});
  else
    pacing_.parts.to_do.push_back({dt, 0});
  pacing_.divides_for -= dt;
  start(pacing_.parts.to_do.back());
  return PLUMB_OK;
}

PlumbResult World::wait(PlumbStepReport& report) {
  while (!advance()) simulation_.respond(std::vector<ManifoldChange>(simulation_.shown_count()));
  if (pacing_.parts.gained) pacing_.divides_for = kStaysDivided;
  pacing_.lets_go = false;
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
  report.nonfinite = counters.nonfinite + stopped_ + pacing_.parts.nonfinite;
  for (PlumbPhase phase = 0; phase < PLUMB_PHASE_COUNT; ++phase)
    report.phase_seconds[phase] = simulation_.phase_seconds(phase);
  stopped_ = 0;
  if (pacing_.parts.gained) report.remarks |= PLUMB_REMARK_ENERGY_BOUNDED;
  if (pacing_.parts.repeated) report.remarks |= PLUMB_REMARK_STEP_REPEATED;
  if (pacing_.parts.grew) report.remarks |= PLUMB_REMARK_CAPACITY_GREW;
  return pacing_.parts.grew ? PLUMB_GROWN : PLUMB_OK;
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
  if (!told_.records_known) {
    told_.records = simulation_.contacts();
    told_.records.insert(told_.records.end(), pacing_.parts.contacts.begin(), pacing_.parts.contacts.end());
  }
  told_.records_known = true;
  return told_.records;
}

void World::find_events() {
  if (init_.needs(PLUMB_NEED_EVENTS)) find_touches();
  if (!sensors_.empty()) sense();
  told_.touches.finish_step(told_.events);
  backend::sort_events(told_.events);
}

void World::find_touches() {
  for (const ContactRecord& record : records())
    for (std::uint32_t p = 0; p < record.count; ++p)
      if (record.separation[p] <= 0 || record.normal_impulse[p] > 0) {
        told_.touches.touch(bodies_[record.bodies.a].id, bodies_[record.bodies.b].id);
        break;
      }
}

std::span<const PlumbContact> World::contacts() {
  if (told_.contacts_known) return lent_.contacts;
  lent_.contacts.clear();
  const bool impulses = init_.needs(PLUMB_NEED_CONTACT_IMPULSES);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const ContactRecord& record : records())
    for (std::uint32_t p = 0; p < record.count; ++p) {
      PlumbContact contact{};
      contact.body_a = bodies_[record.bodies.a].id;
      contact.body_b = bodies_[record.bodies.b].id;
      contact.child_a = child_of(record.pair.a, record.triangle[p]);
      contact.child_b = child_of(record.pair.b, record.triangle[p]);
      contact.position = plumb_vec(record.position[p]);
      contact.normal = to_plumb(record.normal);
      contact.depth = -static_cast<double>(record.separation[p]);
      contact.normal_impulse = impulses ? static_cast<double>(record.normal_impulse[p]) : unknown;
      contact.tangent_impulse = impulses ? to_plumb(record.tangent_impulse[p]) : PlumbVec3{unknown, unknown, unknown};
      contact.feature = record.feature[p] + std::uint64_t{1};
      lent_.contacts.push_back(contact);
    }
  told_.contacts_known = true;
  return lent_.contacts;
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
