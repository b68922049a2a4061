// Making and unmaking a world and its shapes, and its settings.
#include "world.hpp"

#include "slots.hpp"

namespace plumb::ode {
namespace {

/// ODE was left in the middle of something: taking it apart would only find that out with an abort. So what is left of
/// a lost world stays in memory, and known to leak checkers.
struct Wreck {
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  std::vector<std::unique_ptr<Shape>> shapes;
};

void keep_wreck(Wreck wreck) {
  static std::mutex mutex;
  static auto& wrecks = *new std::vector<Wreck>;  // never destroyed: its shapes are still referred to
  const std::scoped_lock lock(mutex);
  wrecks.push_back(std::move(wreck));
}

dWorldID create_ode_world() {
  ensure_ode();
  return dWorldCreate();
}

}  // namespace

World::World(const WorldInit& init)
    : init_(init),
      settings_(settings_table().values(init)),
      gravity_(init.desc.gravity),
      world_(create_ode_world()),
      contacts_(init_, world_),
      seed_(static_cast<unsigned long>(settings_.random_seed)) {
  inside_ode([&] {
    dWorldSetGravity(world_, gravity_.x, gravity_.y, gravity_.z);
    apply_to_world(settings_, world_);
    contacts_.configure(settings_);
    if (init_.needs(PLUMB_NEED_COLLISION) || init_.needs(PLUMB_NEED_SENSORS) || init_.needs(PLUMB_NEED_QUERIES))
      space_ = make_space(settings_);
    if (settings_.threads > 1) {
      const auto threads = static_cast<unsigned>(settings_.threads);
      threads_.implementation = dThreadingAllocateMultiThreadedImplementation();
      threads_.pool = dThreadingAllocateThreadPool(threads, 0, static_cast<unsigned>(dAllocateFlagBasicData), nullptr);
      dThreadingThreadPoolServeMultiThreadedImplementation(threads_.pool, threads_.implementation);
      dWorldSetStepIslandsProcessingMaxThreadCount(world_, threads);
      dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threads_.implementation),
                                           threads_.implementation);
    }
  });
}

World::~World() {
  if (!usable_) {
    keep_wreck({world_, space_, contacts_.group(), std::move(slots_.shapes)});
    return;
  }
  const ErrorScope scope(init_);
  if (threads_.implementation != nullptr) {
    dThreadingImplementationShutdownProcessing(threads_.implementation);
    dThreadingFreeThreadPool(threads_.pool);
    dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
    dThreadingFreeImplementation(threads_.implementation);
  }
  contacts_.destroy();
  if (space_ != nullptr) dSpaceDestroy(space_);  // and its geoms
  dWorldDestroy(world_);                         // and its bodies and joints
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  gravity_ = gravity;
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  return PLUMB_OK;
}

// --- shapes ----------------------------------------------------------------------------------------------------------

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  return inside_ode([&] {
    std::vector<std::unique_ptr<Shape>> made;
    for (const PlumbShapeDesc& desc : descs) {
      std::vector<const Shape*> children;
      for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i)
        children.push_back(slots_.shapes[slot_of(desc.children[i].shape)].get());
      made.push_back(stocks_.shapes.take());
      fill_shape(*made.back(), desc, children);
    }
    for (std::size_t i = 0; i < made.size(); ++i) put(slots_.shapes, ids[i], std::move(made[i]));
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) slots_.shapes[slot_of(id)].reset();
  return PLUMB_OK;
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  return inside_ode([&] {
    settings_table().set(settings_, name, value);
    apply_to_world(settings_, world_);
    contacts_.configure(settings_);
    for (Body* body : lists_.dynamic) apply_body_settings(*body);
    for (Joint* joint : joint_lists_.all)
      if (joint->solved() && substep_.h != 0) set_parameters(*joint, settings_, substep_.h);
    return PLUMB_OK;
  });
}

}  // namespace plumb::ode
