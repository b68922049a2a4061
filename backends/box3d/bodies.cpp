// Shapes and bodies of a world: made and taken away, and which pairs of bodies are kept apart.
#include "plumb/backend/mass_properties.hpp"
#include "world.hpp"

namespace plumb::box3d {
namespace {

b3BodyType type_of(PlumbMotion motion) {
  return motion == PLUMB_STATIC ? b3_staticBody : motion == PLUMB_KINEMATIC ? b3_kinematicBody : b3_dynamicBody;
}

b3MotionLocks locks_of(const PlumbBodyDesc& desc) {
  const auto locked = [&](std::uint32_t bit) { return (desc.locks & bit) != 0; };
  const bool turns = (desc.flags & PLUMB_BODY_NO_ROTATION) == 0;
  return {locked(PLUMB_LOCK_LINEAR_X),
          locked(PLUMB_LOCK_LINEAR_Y),
          locked(PLUMB_LOCK_LINEAR_Z),
          !turns || locked(PLUMB_LOCK_ANGULAR_X),
          !turns || locked(PLUMB_LOCK_ANGULAR_Y),
          !turns || locked(PLUMB_LOCK_ANGULAR_Z)};
}

b3MassData mass_of(const PlumbBodyDesc& desc) {
  const backend::Matrix3 m = backend::inertia_tensor(desc.inertia, desc.inertia_orientation);
  const auto column = [&](std::size_t k) { return vector({m[0][k], m[1][k], m[2][k]}, "inertia"); };
  b3MassData mass{};
  mass.mass = scalar(desc.mass, "mass");
  mass.center = vector(desc.centre_of_mass, "centre_of_mass");
  mass.inertia = {column(0), column(1), column(2)};
  if (mass.mass == 0) throw Error(PLUMB_E_INVALID_ARGUMENT, "mass is too small for Box3D's single precision");
  return mass;
}

b3BodyDef def_of(const PlumbBodyDesc& desc, const Settings& settings, std::uint32_t slot) {
  b3BodyDef def = b3DefaultBodyDef();
  def.type = type_of(desc.motion);
  def.position = position(desc.pose.position, "pose.position");
  def.rotation = quaternion(desc.pose.orientation);
  def.linearVelocity = vector(desc.linear_velocity, "linear_velocity");
  def.angularVelocity = vector(desc.angular_velocity, "angular_velocity");
  def.linearDamping = scalar(desc.linear_damping, "linear_damping");
  def.angularDamping = scalar(desc.angular_damping, "angular_damping");
  def.gravityScale = scalar(desc.gravity_scale, "gravity_scale");
  def.sleepThreshold = static_cast<float>(settings.sleep_threshold);
  def.enableSleep = (desc.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  def.isBullet = (desc.flags & PLUMB_BODY_CCD) != 0;
  def.allowFastRotation = settings.fast_rotation;
  def.motionLocks = locks_of(desc);
  def.userData = reinterpret_cast<void*>(std::uintptr_t{slot});
  return def;
}

}  // namespace

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  std::vector<std::unique_ptr<Shape>> made;
  for (const PlumbShapeDesc& desc : descs) {
    std::vector<const Shape*> children;
    for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i)
      children.push_back(&shape(desc.children[i].shape));
    made.push_back(make_shape(desc, std::move(children), settings_.cylinder_sides));
  }
  for (std::size_t i = 0; i < made.size(); ++i) put(shapes_, ids[i], std::move(made[i]));
  return PLUMB_OK;
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) shapes_[slot_of(id)].reset();
  return PLUMB_OK;
}

void World::make_body(Body& body) {
  const b3BodyDef def = def_of(body.desc, settings_, slot_of(body.handle));
  const b3MassData mass = body.is(PLUMB_DYNAMIC) ? mass_of(body.desc) : b3MassData{};
  body.id = b3CreateBody(world_, &def);
  if (body.shape != nullptr) attach_shapes(body, needs(PLUMB_NEED_SENSORS));
  if (body.is(PLUMB_DYNAMIC)) {
    b3Body_SetMassData(body.id, mass);
    // Box3D takes the velocity as that of the centre of mass, which it knows only now.
    b3Body_SetLinearVelocity(body.id, def.linearVelocity);
  }
  if ((body.desc.flags & PLUMB_BODY_ASLEEP) != 0 && body.is(PLUMB_DYNAMIC)) {
    b3Body_SetAwake(body.id, false);
    body.was_asleep = true;
  }
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  std::vector<std::unique_ptr<Body>> made;
  try {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      made.push_back(std::make_unique<Body>());
      made.back()->handle = ids[i];
      made.back()->desc = descs[i];
      made.back()->shape = descs[i].shape == 0 ? nullptr : &shape(descs[i].shape);
      make_body(*made.back());
    }
  } catch (...) {
    for (const auto& body : made)
      if (b3Body_IsValid(body->id)) b3DestroyBody(body->id);
    throw;
  }
  for (auto& body : made) {
    if (body->is(PLUMB_KINEMATIC)) kinematic_.push_back(body.get());
    put(bodies_, body->handle, std::move(body));
  }
  return PLUMB_OK;
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  touches_.forget(ids, pending_events_);
  for (const PlumbBody id : ids) {
    std::erase(kinematic_, &body(id));
    b3DestroyBody(body(id).id);
    bodies_[slot_of(id)].reset();
  }
  contacts_.clear();
  contacts_fresh_ = true;
  return PLUMB_OK;
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) {
    const std::pair slots(slot_of(pair.body_a), slot_of(pair.body_b));
    if (touch) {
      excepted_.erase(slots);
    } else {
      excepted_.insert(slots);
    }
    find_pairs_again(body(pair.body_a));
    find_pairs_again(body(pair.body_b));
  }
  return PLUMB_OK;
}

bool World::may_collide(b3ShapeId a, b3ShapeId b, void* context) {
  const World& world = *static_cast<const World*>(context);
  if (world.excepted_.empty()) return true;
  const std::uint32_t i = slot_of(world.owner(a).handle), k = slot_of(world.owner(b).handle);
  return !world.excepted_.contains(std::minmax(i, k));
}

const Body& World::owner(b3ShapeId shape) const {
  return *bodies_[reinterpret_cast<std::uintptr_t>(b3Body_GetUserData(b3Shape_GetBody(shape)))];
}

std::uint32_t child_of(const Body& body, b3ShapeId shape, int triangle) {
  if (body.shape->type == PLUMB_TRIANGLE_MESH)
    return triangle < 0 ? 0 : body.shape->triangles[static_cast<std::size_t>(triangle)];
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(b3Shape_GetUserData(shape)));
}

}  // namespace plumb::box3d
