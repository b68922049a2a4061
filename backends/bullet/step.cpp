// The step, and what it reports.
#include "plumb/assert.hpp"
#include "world.hpp"

namespace plumb::bullet {

World::World(const WorldInit& init)
    : needs_(init.desc.needs),
      settings_(init),
      parts_(settings_.collision_options()),
      solver_kind_(settings_.solver_kind()),
      solver_(make_solver(solver_kind_)),
      world_(parts_, solver_->solver(), *this),
      ground_(btScalar(0), nullptr, nullptr),
      gravity_(init.desc.gravity) {
  install_material_callbacks();
  set_gravity(init.desc.gravity);
  if (needs(PLUMB_NEED_FILTERS | PLUMB_NEED_SENSORS))
    parts_.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(this);
  apply_settings();
}

World::~World() {
  for (auto& joint : joints_)
    if (joint) remove_joint(*joint);
  for (auto& body : bodies_)
    if (body) world_.removeRigidBody(body.get());
}

PlumbResult World::step(double dt) {
  const int sub_steps = static_cast<int>(settings_.number("substeps"));
  sub_step_.h = dt / sub_steps;
  static_cast<void>(positive_scalar(sub_step_.h, "dt / substeps"));
  PLUMB_ASSERT(sub_step_.left == 0 && modification_.changed.empty());  // the step before was waited for
  begin_events();
  solver_->begin_step();
  world_.begin_step();
  sub_step_.left = sub_steps;
  find_contacts();
  if (!needs(PLUMB_NEED_CONTACT_MODIFICATION)) finish_step();
  return PLUMB_OK;
}

/// The first half of a sub-step.
void World::find_contacts() {
  const auto h = static_cast<btScalar>(sub_step_.h);
  move_kinematic(sub_step_.left, h);
  world_.find_contacts(h);
}

/// The second half, and the first of the next.
void World::respond() {
  PLUMB_ASSERT(sub_step_.left > 0);
  world_.respond(static_cast<btScalar>(sub_step_.h));
  if (--sub_step_.left == 0) return;
  keep_sub_step_contacts();
  find_contacts();
}

void World::finish_step() {
  while (sub_step_.left > 0) respond();
  PLUMB_ASSERT(modification_.changed.empty());
  world_.end_step();
  forget_targets();
  if (needs(PLUMB_NEED_EVENTS | PLUMB_NEED_SENSORS)) finish_events();
}

void World::before_motion(btScalar h) {
  keep_coasting();
  damp(h);
}

void World::before_solve() {
  solver_->begin_sub_step();
  if (needs(PLUMB_NEED_SURFACE_VELOCITY)) apply_surface_velocities(parts_.dispatcher);
  apply_manifold_changes();
  if (lists_.joint_count != 0) prepare_joints(static_cast<btScalar>(sub_step_.h));
}

void World::after_solve() {
  take_back_manifold_changes();
  hold_locks();
  if (lists_.joint_count != 0) break_joints();
}

void World::begin_events() {
  events_.rows.clear();
  contacts_.of_sub_steps.clear();
  contacts_.fresh = false;
}

void World::keep_sub_step_contacts() {
  if (!needs(PLUMB_NEED_CONTACTS)) return;
  gather_contacts();
  contacts_.of_sub_steps.insert(contacts_.of_sub_steps.end(), contacts_.rows.begin(), contacts_.rows.end());
}

void World::forget_targets() {
  for (Body* body : lists_.kinematic) {
    if (body->has_target) body->coasting.on = false;
    body->has_target = false;
  }
}

void World::finish_events() {
  events_.rows.insert(events_.rows.end(), events_.pending.begin(), events_.pending.end());
  events_.pending.clear();
  track_touches();
  if (needs(PLUMB_NEED_EVENTS) && needs(PLUMB_NEED_SLEEPING)) track_sleep();
  backend::sort_events(events_.rows);
}

void World::track_sleep() {
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    const bool asleep = body->is_asleep();
    if (asleep != body->was_asleep)
      events_.rows.push_back({asleep ? PLUMB_EVENT_SLEEP : PLUMB_EVENT_WAKE, 0, body->handle, 0, 0});
    body->was_asleep = asleep;
  }
}

PlumbResult World::wait(PlumbStepReport& report) {
  if (needs(PLUMB_NEED_CONTACT_MODIFICATION)) finish_step();
  report.pairs = static_cast<std::uint32_t>(parts_.broadphase.getOverlappingPairCache()->getNumOverlappingPairs());
  report.contacts = solver_->contacts();
  report.residual = solver_->residual();
  if (solver_->fell_back()) report.remarks |= PLUMB_REMARK_SOLVER_FELL_BACK;
  count_bodies(report);
  for (std::size_t phase = 0; phase <= PLUMB_PHASE_CONTINUOUS; ++phase)
    report.phase_seconds[phase] = world_.seconds()[phase];
  return PLUMB_OK;
}

void World::count_bodies(PlumbStepReport& report) const {
  PLUMB_ASSERT(report.awake == 0 && report.nonfinite == 0);
  const btAlignedObjectArray<btRigidBody*>& moving = world_.getNonStaticRigidBodies();
  for (int i = 0; i < moving.size(); ++i) {
    const Body& body = *our_body(moving[i]);
    if (body.isStaticOrKinematicObject()) continue;
    if (!body.is_asleep()) ++report.awake;
    // A sum of products with 0 is 0 unless something in it is infinite or not a number.
    const btTransform& pose = body.getWorldTransform();
    const btVector3 sum = pose.getOrigin() + pose.getBasis()[0] + pose.getBasis()[1] + pose.getBasis()[2] +
                          body.getLinearVelocity() + body.getAngularVelocity();
    if (!((sum.x() + sum.y() + sum.z()) * 0 == 0)) ++report.nonfinite;
  }
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_.value(name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  settings_.set(name, value);
  apply_settings();
  return PLUMB_OK;
}

/// All of them: a setting is written far less often than a step is made.
void World::apply_settings() {
  settings_.apply(world_, parts_.dispatcher, needs(PLUMB_NEED_SURFACE_VELOCITY));
  if (settings_.solver_kind() != solver_kind_) {
    auto solver = make_solver(settings_.solver_kind());
    world_.setConstraintSolver(&solver->solver());
    solver_ = std::move(solver);
    solver_kind_ = settings_.solver_kind();
  }
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    constexpr int gyroscopic = BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                               BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
    body->setFlags((body->getFlags() & ~gyroscopic) | settings_.gyroscopic_flags());
    body->setSleepingThresholds(static_cast<btScalar>(settings_.number("sleep_linear_threshold")),
                                static_cast<btScalar>(settings_.number("sleep_angular_threshold")));
    prepare_ccd(*body);
    set_anchor(*body);
  }
}

}  // namespace plumb::bullet
