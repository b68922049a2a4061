// The step, what it reports, and the settings that it is done with.
#include <Jolt/Jolt.h>

#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/JobSystemThreadPool.h>

#include <algorithm>
#include <bit>

#include "world.hpp"

namespace plumb::jolt {
namespace {

/// What Jolt keeps room for: it never grows. Most of it is touched only when it is used.
struct Room {
  std::uint32_t bodies, pairs, contacts;

  explicit Room(const PlumbWorldDesc& desc) {
    constexpr std::uint64_t least = 65536;
    const std::uint64_t asked = std::min<std::uint64_t>(desc.body_capacity, JPH::PhysicsSystem::cMaxBodiesLimit / 2);
    bodies = static_cast<std::uint32_t>(std::max(least, 2 * asked));
    contacts = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(std::max({least, 8 * asked, std::uint64_t{desc.contact_capacity}}), 1u << 21));
    pairs = 4 * contacts;
  }
  [[nodiscard]] std::size_t scratch() const {
    constexpr std::size_t beside = 32u << 20;  // bytes: pairs in flight, islands, bodies that are cast
    return beside + contacts * std::size_t{JPH::ContactConstraintManager::cMaxConstraintSize + sizeof(JPH::uint32)};
  }
};

std::unique_ptr<JPH::JobSystem> make_jobs(std::uint32_t threads) {
  if (threads == 1) return std::make_unique<JPH::JobSystemSingleThreaded>(JPH::cMaxPhysicsJobs);
  return std::make_unique<JPH::JobSystemThreadPool>(JPH::cMaxPhysicsJobs, JPH::cMaxPhysicsBarriers,
                                                    static_cast<int>(threads) - 1);
}

}  // namespace

World::World(const WorldInit& init)
    : needs_(init.desc.needs),
      settings_(settings_table().values(init)),
      threads_(std::min(init.desc.threads, info().max_threads)),
      jobs_(make_jobs(threads_)),
      listener_(needs(PLUMB_NEED_CONTACTS | PLUMB_NEED_EVENTS), needs(PLUMB_NEED_SURFACE_VELOCITY)) {
  const Room room(init.desc);
  scratch_ = std::make_unique<JPH::TempAllocatorImplWithMallocFallback>(room.scratch());
  system_.Init(room.bodies, 0, room.pairs, room.contacts, layers_, layers_, layers_);
  system_.SetGravity(vector(init.desc.gravity, "gravity"));
  if (listener_.is_asked()) system_.SetContactListener(&listener_);
  apply_settings();
}

World::~World() {
  for (const auto& joint : joints_)
    if (joint) remove_joint(*joint);
  for (const auto& body : bodies_) {
    if (!body) continue;
    interface().RemoveBody(body->id());
    interface().DestroyBody(body->jolt->GetID());
  }
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  system_.SetGravity(vector(gravity, "gravity"));
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  const float length = scalar(dt, "dt");
  steer_kinematics(dt);
  remember_axes();
  listener_.forget_all();
  const JPH::EPhysicsUpdateError lost = system_.Update(length, settings_.collision_steps, scratch_.get(), jobs_.get());
  listener_.finish_step();
  last_.part = dt / settings_.collision_steps;
  last_.dropped = static_cast<std::uint32_t>(std::popcount(static_cast<std::uint32_t>(lost)));
  last_.contacts_fresh = false;
  settle_kinematics();
  gather_events();
  return PLUMB_OK;
}

void World::steer_kinematics(double dt) {
  for (Body* body : kinematic_) {
    if (body->moving == Body::Moving::to_target) {
      interface().MoveKinematic(body->id(), position(body->target.position, "target"),
                                quaternion(body->target.orientation), static_cast<float>(dt));
    } else if (body->moving == Body::Moving::arrived) {
      interface().SetLinearAndAngularVelocity(body->id(), JPH::Vec3::sZero(), JPH::Vec3::sZero());
      body->moving = Body::Moving::as_told;
    }
  }
}

/// Where rounding has left them beside their targets.
void World::settle_kinematics() {
  for (Body* body : kinematic_) {
    if (body->moving != Body::Moving::to_target) continue;
    interface().SetPositionAndRotation(body->id(), position(body->target.position, "target"),
                                       quaternion(body->target.orientation), JPH::EActivation::DontActivate);
    body->moving = Body::Moving::arrived;
  }
}

PlumbResult World::wait(PlumbStepReport& report) {
  report.threads = threads_;
  report.dropped = last_.dropped;
  report.contacts = needs(PLUMB_NEED_CONTACTS) ? static_cast<std::uint32_t>(contacts().size()) : 0;
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    if (!body->asleep()) ++report.awake;
    const JPH::Body& at = *body->jolt;
    const JPH::Vec3 moves = at.GetLinearVelocity() + at.GetAngularVelocity();
    const auto place = at.GetCenterOfMassPosition();
    const JPH::Quat turn = at.GetRotation();
    if (!std::isfinite(moves.GetX() + moves.GetY() + moves.GetZ()) || place.IsNaN() || turn.IsNaN() ||
        !std::isfinite(place.GetX() + place.GetY() + place.GetZ()))
      ++report.nonfinite;
  }
  return PLUMB_OK;
}

/// Parts of a step after its first forget the contacts of those before.
void World::apply_settings() {
  system_.SetPhysicsSettings(physics_settings(settings_, needs(PLUMB_NEED_SLEEPING)));
  const bool listens = listener_.is_asked() && settings_.collision_steps > 1;
  if (listens == listens_to_parts_) return;
  listens ? system_.AddStepListener(&listener_) : system_.RemoveStepListener(&listener_);
  listens_to_parts_ = listens;
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  settings_table().set(settings_, name, value);
  apply_settings();
  return PLUMB_OK;
}

}  // namespace plumb::jolt
