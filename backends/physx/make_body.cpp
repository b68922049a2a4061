#include "make_body.hpp"

#include "filter.hpp"
#include "start.hpp"

namespace plumb::px {
namespace {

constexpr std::uint32_t kTurns = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y | PLUMB_LOCK_ANGULAR_Z;
static_assert(PLUMB_LOCK_LINEAR_X == static_cast<int>(PxRigidDynamicLockFlag::eLOCK_LINEAR_X) &&
              PLUMB_LOCK_ANGULAR_Z == static_cast<int>(PxRigidDynamicLockFlag::eLOCK_ANGULAR_Z));

std::uint32_t locks_of(const PlumbBodyDesc& desc) {
  return desc.locks | ((desc.flags & PLUMB_BODY_NO_ROTATION) != 0 ? kTurns : 0);
}

/// An axis without a moment does not turn, neither here nor in PhysX.
void check_inverse(double value, const char* name) {
  if (value != 0 && !std::isnormal(1 / scalar(value, name)))
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(name) + " is " + backend::number_text(value) +
                                              ", too far from 1 for PhysX's single precision");
}

/// Those of a piece, the first for what has none of its own.
std::vector<PxMaterial*> materials_of(const Body& body, const Piece& piece, Materials& materials) {
  std::vector<PxMaterial*> all = {&materials.of(body.material_of(piece))};
  for (const PlumbMaterial& material : body.shape->materials) all.push_back(&materials.of(material));
  return all;
}

void attach(Body& body, const Piece& piece, Common& common) {
  PxShapeFlags flags;
  if (!body.is_sensor()) flags |= PxShapeFlag::eSIMULATION_SHAPE;
  if (common.needs_any(PLUMB_NEED_QUERIES | PLUMB_NEED_SENSORS)) flags |= PxShapeFlag::eSCENE_QUERY_SHAPE;
  const std::vector<PxMaterial*> materials = materials_of(body, piece, common.materials);
  PxShape* shape =
      physics().createShape(piece.geometry.any(), materials.data(), static_cast<PxU16>(materials.size()), true, flags);
  if (shape == nullptr) throw Error(PLUMB_E_OUT_OF_MEMORY, "PhysX makes no such shape" + because());
  const auto& part = body.parts.emplace_back(std::make_unique<Part>(Part{&body, &piece}));
  shape->userData = part.get();
  shape->setLocalPose(piece.at);
  shape->setSimulationFilterData(filter_data(slot_of(body.handle)));
  shape->setRestOffset(static_cast<float>(common.settings.contacts.rest_offset));
  shape->setContactOffset(static_cast<float>(common.settings.contacts.offset));
  const bool attached = body.actor->attachShape(*shape);
  shape->release();
  if (!attached) throw Error(PLUMB_E_UNSUPPORTED, "PhysX does not let the body have this shape" + because());
}

void put_motion(const Body& body, const Common& common) {
  const PlumbBodyDesc& desc = body.desc;
  const Settings& settings = common.settings;
  PxRigidDynamic& actor = body.dynamic();
  if (body.is(PLUMB_KINEMATIC)) {
    actor.setRigidBodyFlag(PxRigidBodyFlag::eKINEMATIC, true);
    return;
  }
  actor.setMass(static_cast<float>(desc.mass));
  actor.setMassSpaceInertiaTensor(vector(desc.inertia, "inertia"));
  actor.setCMassLocalPose(transform({desc.centre_of_mass, desc.inertia_orientation}, "centre_of_mass"));
  actor.setRigidDynamicLockFlags(PxRigidDynamicLockFlags(static_cast<PxU8>(locks_of(desc))));
  actor.setMaxAngularVelocity(static_cast<float>(settings.max_angular_speed));
  actor.setMaxDepenetrationVelocity(static_cast<float>(settings.max_depenetration_speed));
  actor.setSolverIterationCounts(static_cast<PxU32>(settings.position_iterations),
                                 static_cast<PxU32>(settings.velocity_iterations));
  actor.setRigidBodyFlag(PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, common.needs_any(PLUMB_NEED_GYROSCOPIC));
  if ((desc.flags & PLUMB_BODY_CCD) != 0)
    actor.setRigidBodyFlag(settings.continuous.by == Settings::Ccd::swept ? PxRigidBodyFlag::eENABLE_CCD
                                                                          : PxRigidBodyFlag::eENABLE_SPECULATIVE_CCD,
                           true);
  const bool sleeps = common.needs_any(PLUMB_NEED_SLEEPING) && (desc.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  actor.setSleepThreshold(sleeps ? static_cast<float>(settings.sleep.threshold) : 0);
  if (!sleeps) actor.setStabilizationThreshold(0);
  put_gravity(body);
  put_damping(body);
  put_velocity(body, {desc.linear_velocity, desc.angular_velocity});
}

}  // namespace

void check_body(const PlumbBodyDesc& desc) {
  (void)transform(desc.pose, "pose.position");
  (void)vector(desc.linear_velocity, "linear_velocity");
  (void)vector(desc.angular_velocity, "angular_velocity");
  (void)scalar(desc.material.friction, "friction");
  (void)scalar(desc.linear_damping, "linear_damping");
  (void)scalar(desc.angular_damping, "angular_damping");
  (void)scalar(desc.gravity_scale, "gravity_scale");
  if (desc.motion != PLUMB_DYNAMIC) return;
  (void)vector(desc.centre_of_mass, "centre_of_mass");
  check_inverse(desc.mass, "mass");
  check_inverse(desc.inertia.x, "inertia.x");
  check_inverse(desc.inertia.y, "inertia.y");
  check_inverse(desc.inertia.z, "inertia.z");
}

void make_actor(Body& body, Common& common) {
  const PxTransform at = transform(body.desc.pose, "pose.position");
  if (body.is(PLUMB_STATIC))
    body.actor = physics().createRigidStatic(at);
  else
    body.actor = physics().createRigidDynamic(at);
  if (body.actor == nullptr) throw Error(PLUMB_E_OUT_OF_MEMORY, "PhysX has no room for more bodies" + because());
  body.actor->userData = &body;
  try {
    if (body.shape != nullptr)
      for (const Piece& piece : body.shape->pieces) attach(body, piece, common);
  } catch (...) {
    release_actor(body);
    throw;
  }
  if (!body.is(PLUMB_STATIC)) put_motion(body, common);
}

void release_actor(Body& body) {
  body.actor->release();
  body.actor = nullptr;
  body.parts.clear();
}

void attach_anew(Body& body, Common& common) {
  std::vector<PxShape*> before(body.actor->getNbShapes());
  body.actor->getShapes(before.data(), static_cast<PxU32>(before.size()));
  for (PxShape* shape : before) body.actor->detachShape(*shape, false);
  body.parts.clear();
  for (const Piece& piece : body.shape->pieces) attach(body, piece, common);
}

void put_material(const Body& body, Common& common) {
  std::vector<PxShape*> shapes(body.actor->getNbShapes());
  body.actor->getShapes(shapes.data(), static_cast<PxU32>(shapes.size()));
  for (PxShape* shape : shapes) {
    const std::vector<PxMaterial*> materials = materials_of(body, *part_of(*shape).piece, common.materials);
    shape->setMaterials(materials.data(), static_cast<PxU16>(materials.size()));
  }
}

/// PhysX has gravity on or off: of others the step adds their share.
void put_gravity(const Body& body) {
  body.actor->setActorFlag(PxActorFlag::eDISABLE_GRAVITY, body.desc.gravity_scale != 1);
}

void put_damping(const Body& body) {
  body.dynamic().setLinearDamping(static_cast<float>(body.desc.linear_damping));
  body.dynamic().setAngularDamping(static_cast<float>(body.desc.angular_damping));
}

Velocity unlocked(const PlumbBodyDesc& desc, Velocity velocity) {
  const std::uint32_t locks = locks_of(desc);
  double* const axes[] = {&velocity.linear.x,  &velocity.linear.y,  &velocity.linear.z,
                          &velocity.angular.x, &velocity.angular.y, &velocity.angular.z};
  for (std::size_t i = 0; i < 6; ++i)
    if ((locks >> i & 1) != 0) *axes[i] = 0;
  return velocity;
}

void put_velocity(const Body& body, const Velocity& velocity) {
  const Velocity free = unlocked(body.desc, velocity);
  body.dynamic().setLinearVelocity(vector(free.linear, "linear velocity"));
  body.dynamic().setAngularVelocity(vector(free.angular, "angular velocity"));
}

}  // namespace plumb::px
