// The step, what it reports, and the settings that it is done with.
#include <algorithm>

#include "device.hpp"
#include "start.hpp"
#include "world.hpp"

namespace plumb::px {
namespace {

/// Where one thread is all, the caller's does the work.
PxDefaultCpuDispatcher* make_dispatcher(std::uint32_t threads) {
  (void)physics();
  return PxDefaultCpuDispatcherCreate(threads == 1 ? 0 : threads);
}

PxPairFlags pair_flags(const Common& common) {
  PxPairFlags flags = PxPairFlag::eCONTACT_DEFAULT;
  if (common.needs_any(PLUMB_NEED_CONTACTS | PLUMB_NEED_EVENTS))
    flags |= PxPairFlag::eNOTIFY_TOUCH_FOUND | PxPairFlag::eNOTIFY_TOUCH_PERSISTS | PxPairFlag::eNOTIFY_CONTACT_POINTS;
  if (common.needs_any(PLUMB_NEED_CCD)) flags |= PxPairFlag::eDETECT_CCD_CONTACT;
  if (common.needs_any(PLUMB_NEED_SURFACE_VELOCITY)) flags |= PxPairFlag::eMODIFY_CONTACTS;
  return flags;
}

/// Where a body is that goes on as it does for a time.
PlumbPose moved(const PlumbPose& from, const PlumbBodyDesc& desc, double dt) {
  const double angle = dt * backend::length(desc.angular_velocity), half = angle / 2;
  PlumbPose to = from;
  to.position = backend::add(from.position, backend::scale(dt, desc.linear_velocity));
  if (angle == 0) return to;
  const PlumbVec3 axis = backend::scale(std::sin(half) * dt / angle, desc.angular_velocity);
  to.orientation = backend::multiply({axis.x, axis.y, axis.z, std::cos(half)}, from.orientation);
  return to;
}

bool stands(const PlumbBodyDesc& desc) {
  return backend::length(desc.linear_velocity) == 0 && backend::length(desc.angular_velocity) == 0;
}

}  // namespace

World::World(const WorldInit& init)
    : common_(init.desc.needs, settings_table().values(init)),
      threads_(std::min(init.desc.threads, info().max_threads)),
      dispatcher_(make_dispatcher(threads_)) {
  PxPhysics& with = physics();
  rules_.flags = pair_flags(common_);
  PxSceneDesc desc(with.getTolerancesScale());
  desc.gravity = vector(init.desc.gravity, "gravity");
  desc.cpuDispatcher = dispatcher_.get();
  desc.simulationEventCallback = &listener_;
  if (needs(PLUMB_NEED_SURFACE_VELOCITY)) desc.contactModifyCallback = &surfaces_;
  if (needs(PLUMB_NEED_CCD)) desc.flags |= PxSceneFlag::eENABLE_CCD;
  rules_.put_filter(desc);
  put_settings(common_.settings, desc);
  put_device(init.desc.body_capacity, init.desc.contact_capacity, desc);
  scene_.reset(with.createScene(desc));
  if (scene_ == nullptr) throw Error(PLUMB_E_INTERNAL, "PhysX makes no scene" + because());
  apply_settings(common_.settings, *scene_);
}

World::~World() {
  for (const auto& joint : joints_)
    if (joint) remove_joint(*joint);
  for (const auto& body : bodies_)
    if (body) remove_body(*body);
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  scene_->setGravity(vector(gravity, "gravity"));
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  const float length = scalar(dt, "dt");
  steer_kinematics(dt);
  pull_scaled();
  remember_turns();
  listener_.forget_all();
  const std::uint32_t before = losses();
  PxU32 failed = 0;
  if (!scene_->simulate(length) || !scene_->fetchResults(true, &failed) || failed != 0)
    throw Error(kOnGpu ? PLUMB_E_DEVICE_LOST : PLUMB_E_WORLD_LOST, "PhysX could not step" + because());
  dropped_ = losses() - before;
  listener_.finish_step();
  settle_kinematics();
  gather_events();
  return PLUMB_OK;
}

void World::steer_kinematics(double dt) {
  for (Body* body : kinematic_) {
    PlumbBodyDesc& desc = body->desc;
    const PlumbPose from = body->pose();
    if (body->moving == Body::Moving::to_target) {
      const PlumbPose& to = body->target;
      const PlumbQuat turn = backend::multiply(to.orientation, backend::conjugate(from.orientation));
      desc.linear_velocity = backend::scale(1 / dt, backend::sub(to.position, from.position));
      desc.angular_velocity = backend::scale(1 / dt, backend::rotation_vector(turn));
      body->dynamic().setKinematicTarget(transform(to, "target"));
      continue;
    }
    if (body->moving == Body::Moving::arrived) {
      desc.linear_velocity = desc.angular_velocity = {};
      body->moving = Body::Moving::as_told;
    }
    if (!stands(desc)) body->dynamic().setKinematicTarget(transform(moved(from, desc, dt), "velocity"));
  }
}

void World::settle_kinematics() {
  for (Body* body : kinematic_)
    if (body->moving == Body::Moving::to_target) body->moving = Body::Moving::arrived;
}

/// Their share of gravity, for which nobody wakes.
void World::pull_scaled() {
  const PxVec3 gravity = scene_->getGravity();
  for (const Body* body : scaled_)
    if (!body->asleep())
      body->dynamic().addForce(static_cast<float>(body->desc.gravity_scale) * gravity, PxForceMode::eACCELERATION,
                               false);
}

void World::sort_scaled(Body& body) {
  std::erase(scaled_, &body);
  const double scale = body.desc.gravity_scale;
  if (body.is(PLUMB_DYNAMIC) && scale != 1 && scale != 0) scaled_.push_back(&body);
}

PlumbResult World::wait(PlumbStepReport& report) {
  report.threads = threads_;
  report.dropped = dropped_;
  report.contacts = needs(PLUMB_NEED_CONTACTS) ? static_cast<std::uint32_t>(contacts().size()) : 0;
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    const PxRigidDynamic& at = body->dynamic();
    if (!at.isSleeping()) ++report.awake;
    if (!at.getGlobalPose().isFinite() || !at.getLinearVelocity().isFinite() || !at.getAngularVelocity().isFinite())
      ++report.nonfinite;
  }
  return PLUMB_OK;
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(common_.settings, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  Settings& settings = common_.settings;
  settings_table().set(settings, name, value);
  apply_settings(settings, *scene_);
  for (const auto& body : bodies_)
    if (body && body->is(PLUMB_DYNAMIC))
      body->dynamic().setSolverIterationCounts(static_cast<PxU32>(settings.position_iterations),
                                               static_cast<PxU32>(settings.velocity_iterations));
  return PLUMB_OK;
}

}  // namespace plumb::px
