// The step, what it reports, and the settings that it is done with.
#include <algorithm>
#include <mutex>

#include "world.hpp"

namespace plumb::box3d {
namespace {

b3WorldDef def_of(const WorldInit& init) {
  b3WorldDef def = b3DefaultWorldDef();
  def.gravity = vector(init.desc.gravity, "gravity");
  def.workerCount = std::min<std::uint32_t>(init.desc.threads, B3_MAX_WORKERS);
  def.enableSleep = init.needs(PLUMB_NEED_SLEEPING);
  return def;
}

/// Box3D holds its worlds in one table of the process, where only the host can keep two threads from one place.
std::mutex& world_table() {
  static std::mutex mutex;
  return mutex;
}

b3WorldId make_world(const b3WorldDef& def) {
  const std::lock_guard lock(world_table());
  return b3CreateWorld(&def);
}

}  // namespace

World::World(const WorldInit& init) : needs_(init.desc.needs), settings_(settings_table().values(init)) {
  const b3WorldDef def = def_of(init);
  threads_ = def.workerCount;
  world_ = make_world(def);
  if (!b3World_IsValid(world_))
    throw Error(PLUMB_E_OUT_OF_MEMORY,
                "Box3D holds " + std::to_string(b3GetMaxWorldCount()) + " worlds in a process; destroy one of them");
  apply_to_world(settings_, world_);
  b3World_SetCustomFilterCallback(world_, &World::may_collide, this);
  const b3BodyDef ground = b3DefaultBodyDef();
  ground_ = b3CreateBody(world_, &ground);
}

World::~World() {
  const std::lock_guard lock(world_table());
  b3DestroyWorld(world_);
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  b3World_SetGravity(world_, vector(gravity, "gravity"));
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  const float length = scalar(dt, "dt");
  steer_kinematics(dt);
  b3World_Step(world_, length, settings_.substeps);
  settle_kinematics();
  contacts_fresh_ = false;
  gather_events();
  return PLUMB_OK;
}

void World::steer_kinematics(double dt) {
  for (Body* body : kinematic_) {
    if (body->moving == Body::Moving::to_target) {
      const PlumbPose now = body->pose();
      const PlumbQuat turn = backend::multiply(backend::normalized(body->target.orientation),
                                               backend::conjugate(backend::normalized(now.orientation)));
      b3Body_SetAwake(body->id, true);
      b3Body_SetLinearVelocity(
          body->id, vector(backend::scale(1 / dt, backend::sub(body->target.position, now.position)), "target"));
      b3Body_SetAngularVelocity(body->id, vector(backend::scale(1 / dt, backend::rotation_vector(turn)), "target"));
    } else if (body->moving == Body::Moving::arrived) {
      b3Body_SetLinearVelocity(body->id, b3Vec3_zero);
      b3Body_SetAngularVelocity(body->id, b3Vec3_zero);
      body->moving = Body::Moving::as_told;
    }
  }
}

/// Where rounding has left them beside their targets.
void World::settle_kinematics() {
  for (Body* body : kinematic_) {
    if (body->moving != Body::Moving::to_target) continue;
    b3Body_SetTransform(body->id, position(body->target.position, "target"), quaternion(body->target.orientation));
    body->moving = Body::Moving::arrived;
  }
}

PlumbResult World::wait(PlumbStepReport& report) {
  const b3Profile profile = b3World_GetProfile(world_);
  const auto seconds = [](float milliseconds) { return static_cast<double>(milliseconds) * 1e-3; };
  report.threads = threads_;
  report.phase_seconds[PLUMB_PHASE_BROAD] = seconds(profile.pairs);
  report.phase_seconds[PLUMB_PHASE_NARROW] = seconds(profile.collide);
  report.phase_seconds[PLUMB_PHASE_SOLVE] = seconds(profile.solve);
  report.pairs = static_cast<std::uint32_t>(b3World_GetCounters(world_).contactCount);
  report.contacts = needs(PLUMB_NEED_CONTACTS) ? static_cast<std::uint32_t>(contacts().size()) : 0;
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    if (!body->asleep()) ++report.awake;
    const b3WorldTransform at = b3Body_GetTransform(body->id);
    const b3Vec3 v = b3Body_GetLinearVelocity(body->id), w = b3Body_GetAngularVelocity(body->id);
    const auto sum =
        at.p.x + at.p.y + at.p.z + at.q.v.x + at.q.v.y + at.q.v.z + at.q.s + v.x + v.y + v.z + w.x + w.y + w.z;
    if (!std::isfinite(sum)) ++report.nonfinite;
  }
  return PLUMB_OK;
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  settings_table().set(settings_, name, value);
  apply_to_world(settings_, world_);
  return PLUMB_OK;
}

}  // namespace plumb::box3d
