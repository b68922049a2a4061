// Shapes and bodies of a world: made, added to Bullet, removed.
#include <algorithm>

#include "moving_mesh.hpp"
#include "plumb/assert.hpp"
#include "plumb/backend/small_math.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

/// Numbers of a mass frame below these, relative to its size, come from rounding.
constexpr double kNoOffset = 1e-9;

struct MassFrame {
  btVector3 inertia;
  btTransform body_to_mass;  ///< mass frame seen from the body's frame
  bool identity;
};

/// Bullet's body stands in its centre of mass with its axes along the principal ones. Where the tensor is diagonal in
/// the body's own axes these serve, so that no frame is moved without need.
MassFrame mass_frame(const PlumbBodyDesc& desc) {
  const backend::Matrix3 turn = backend::rotation_matrix(desc.inertia_orientation);
  const backend::Matrix3 tensor = backend::multiply(
      backend::multiply(turn, backend::Matrix3::diagonal(desc.inertia.x, desc.inertia.y, desc.inertia.z)),
      backend::transpose(turn));
  const double largest = std::max({desc.inertia.x, desc.inertia.y, desc.inertia.z});
  const double off_diagonal = std::max({std::abs(tensor[0][1]), std::abs(tensor[0][2]), std::abs(tensor[1][2])});
  const bool turned = off_diagonal > kNoOffset * largest;
  const bool moved = backend::length(desc.centre_of_mass) > kNoOffset;
  const PlumbVec3 inertia = turned || largest == 0 ? desc.inertia : PlumbVec3{tensor[0][0], tensor[1][1], tensor[2][2]};
  if (largest > 0) positive_scalar(std::min({inertia.x, inertia.y, inertia.z}), "inertia");
  MassFrame frame{vector(inertia, "inertia"), btTransform::getIdentity(), !turned && !moved};
  if (moved) frame.body_to_mass.setOrigin(vector(desc.centre_of_mass, "centre_of_mass"));
  if (turned) frame.body_to_mass.setRotation(quaternion(desc.inertia_orientation));
  return frame;
}

btVector3 free_axes(std::uint32_t locks, std::uint32_t first) {
  const auto factor = [&](std::uint32_t bit) { return btScalar((locks & bit) != 0 ? 0 : 1); };
  return {factor(first), factor(first << 1), factor(first << 2)};
}

}  // namespace

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  std::vector<std::shared_ptr<const Shape>> made;
  for (const PlumbShapeDesc& desc : descs) {
    std::vector<Shape::Child> children;
    if (desc.type == PLUMB_COMPOUND) children = children_of(desc, [this](PlumbShape id) { return shape(id); });
    made.push_back(make_shape(desc, std::move(children), settings_.shape_options()));
  }
  put_shapes(std::move(made), ids);
  return PLUMB_OK;
}

void World::put_shapes(std::vector<std::shared_ptr<const Shape>> made, std::span<const PlumbShape> ids) {
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::size_t slot = slot_of(ids[i]);
    if (shapes_.size() <= slot) shapes_.resize(slot + 1);
    shapes_[slot] = std::move(made[i]);
  }
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) shapes_[slot_of(id)].reset();
  return PLUMB_OK;
}

MadeOf World::made_of(const PlumbBodyDesc& desc) const {
  MadeOf made;
  made.shape = desc.shape == 0 ? nullptr : shape(desc.shape);
  const bool dynamic = desc.motion == PLUMB_DYNAMIC;
  MassFrame frame{btVector3(0, 0, 0), btTransform::getIdentity(), true};
  if (dynamic) frame = mass_frame(desc);
  made.mass = dynamic ? positive_scalar(desc.mass, "mass") : btScalar(0);
  made.inertia = frame.inertia;
  made.body_to_mass = frame.body_to_mass;
  made.offset_frame = !frame.identity;
  if (dynamic && made.shape && made.shape->type == PLUMB_TRIANGLE_MESH)
    made.own_shape = make_moving_mesh(*made.shape, frame.body_to_mass.inverse());
  else if (made.shape && made.offset_frame)
    made.own_shape = make_offset_shape(*made.shape, frame.body_to_mass.inverse());
  return made;
}

btRigidBody::btRigidBodyConstructionInfo World::construction(const MadeOf& made, const btTransform& pose) {
  // Bullet only reads a shape that is in use.
  btCollisionShape* bullet_shape = made.own_shape ? made.own_shape.get()
                                   : made.shape   ? made.shape->bullet.get()
                                                  : &no_shape_;
  btRigidBody::btRigidBodyConstructionInfo info(made.mass, nullptr, bullet_shape, made.inertia);
  info.m_linearSleepingThreshold = static_cast<btScalar>(settings_.number("sleep_linear_threshold"));
  info.m_angularSleepingThreshold = static_cast<btScalar>(settings_.number("sleep_angular_threshold"));
  info.m_startWorldTransform = made.offset_frame ? pose * made.body_to_mass : pose;
  return info;
}

void Body::take(MadeOf made) {
  shape = std::move(made.shape);
  own_shape = std::move(made.own_shape);
  offset_frame = made.offset_frame;
  body_to_mass = made.body_to_mass;
  mass_to_body = made.body_to_mass.inverse();
}

std::unique_ptr<Body> World::make_body(const PlumbBodyDesc& desc, PlumbBody handle) {
  MadeOf made = made_of(desc);
  btRigidBody::btRigidBodyConstructionInfo info = construction(made, transform(desc.pose, "pose"));
  info.m_friction = scalar(desc.material.friction, "friction");
  info.m_restitution = static_cast<btScalar>(desc.material.restitution);
  info.m_rollingFriction = scalar(desc.rolling_friction, "rolling_friction");
  info.m_spinningFriction = scalar(desc.spinning_friction, "spinning_friction");
  auto body = std::make_unique<Body>(info, handle, desc);
  body->take(std::move(made));
  body->conveys = !(desc.material.surface_velocity.x == 0 && desc.material.surface_velocity.y == 0 &&
                    desc.material.surface_velocity.z == 0);
  (void)vector(desc.material.surface_velocity, "surface_velocity");
  (void)scalar(desc.gravity_scale, "gravity_scale");
  if (desc.motion != PLUMB_STATIC) {
    body->setLinearVelocity(vector(desc.linear_velocity, "linear_velocity"));
    const btVector3 spin = vector(desc.angular_velocity, "angular_velocity");
    body->setAngularVelocity((desc.flags & PLUMB_BODY_NO_ROTATION) != 0 ? btVector3(0, 0, 0) : spin);
  }
  return body;
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  std::vector<std::unique_ptr<Body>> made;
  for (std::size_t i = 0; i < descs.size(); ++i) made.push_back(make_body(descs[i], ids[i]));
  for (auto& body : made) {
    add_to_bullet(*body);
    const std::size_t slot = slot_of(body->handle);
    if (bodies_.size() <= slot) bodies_.resize(slot + 1);
    bodies_[slot] = std::move(body);
  }
  return PLUMB_OK;
}

void World::add_to_bullet(Body& body) {
  PLUMB_ASSERT(body.getBroadphaseHandle() == nullptr && body.getWorldArrayIndex() == -1);
  int flags = body.getCollisionFlags();
  if (body.is(PLUMB_KINEMATIC))
    flags = (flags & ~btCollisionObject::CF_STATIC_OBJECT) | btCollisionObject::CF_KINEMATIC_OBJECT;
  if (body.is_sensor()) flags |= btCollisionObject::CF_NO_CONTACT_RESPONSE;
  if (needs_contact_material(body)) flags |= btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK;
  body.setCollisionFlags(flags);
  set_anchor(body);
  prepare_motion(body);
  if (!needs(PLUMB_NEED_COLLISION) || !body.shape)
    world_.addRigidBody(&body, 0, 0);
  else
    world_.addRigidBody(&body);
  if (body.is(PLUMB_DYNAMIC)) apply_gravity_scale(body);
  if (needs(PLUMB_NEED_SLEEPING)) {
    body.was_asleep = (body.flags & PLUMB_BODY_ASLEEP) != 0 && body.is(PLUMB_DYNAMIC);
    if (body.was_asleep) body.forceActivationState(ISLAND_SLEEPING);
  }
}

void World::take_from_bullet(Body& body) {
  world_.removeRigidBody(&body);
  world_.forget_predictions(body);
  for (auto* list : {&lists_.kinematic, &lists_.damped, &lists_.locked}) std::erase(*list, &body);
}

void World::prepare_motion(Body& body) {
  const bool may_sleep = needs(PLUMB_NEED_SLEEPING) && (body.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  if (!may_sleep && !body.is(PLUMB_STATIC)) body.setActivationState(DISABLE_DEACTIVATION);
  if (body.is(PLUMB_KINEMATIC)) {
    PLUMB_ASSERT(std::find(lists_.kinematic.begin(), lists_.kinematic.end(), &body) == lists_.kinematic.end());
    lists_.kinematic.push_back(&body);
    body.coast(body.getLinearVelocity(), body.getAngularVelocity());
  }
  if (!body.is(PLUMB_DYNAMIC)) return;
  body.setFlags(settings_.gyroscopic_flags());
  if (body.gravity_scale != 1) body.setFlags(body.getFlags() | BT_DISABLE_WORLD_GRAVITY);
  if ((body.flags & PLUMB_BODY_NO_ROTATION) != 0) body.setAngularFactor(btScalar(0));
  if (body.locks != 0) {
    body.setLinearFactor(free_axes(body.locks, PLUMB_LOCK_LINEAR_X));
    body.setAngularFactor(body.getAngularFactor() * free_axes(body.locks, PLUMB_LOCK_ANGULAR_X));
    lists_.locked.push_back(&body);
  }
  if (body.linear_damping != 0 || body.angular_damping != 0) lists_.damped.push_back(&body);
  prepare_ccd(body);
}

void World::prepare_ccd(Body& body) const {
  if ((body.flags & PLUMB_BODY_CCD) == 0 || !body.shape) return;
  const double radius = body.shape->inner_radius;
  PLUMB_ASSERT(radius >= 0);
  body.setCcdMotionThreshold(static_cast<btScalar>(radius * settings_.number("ccd_threshold")));
  body.setCcdSweptSphereRadius(static_cast<btScalar>(radius * settings_.number("ccd_radius")));
}

void World::set_anchor(Body& body) const {
  constexpr int anchor = btCollisionObject::CF_HAS_FRICTION_ANCHOR;
  body.setCollisionFlags(settings_.is_on("friction_anchors") ? body.getCollisionFlags() | anchor
                                                             : body.getCollisionFlags() & ~anchor);
}

void World::apply_gravity_scale(Body& body) const {
  body.setGravity(vector(gravity_, "gravity") * static_cast<btScalar>(body.gravity_scale));
}

/// Bullet's own setGravity passes by bodies that sleep.
PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  (void)vector(gravity, "gravity");
  gravity_ = gravity;
  world_.setGravity(vector(gravity, "gravity"));
  for (const auto& body : bodies_)
    if (body && body->is(PLUMB_DYNAMIC)) apply_gravity_scale(*body);
  return PLUMB_OK;
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  for (const PlumbBody id : ids) {
    Body& gone = body(id);
    wake_neighbours(gone);
    take_from_bullet(gone);
  }
  for (const PlumbBody id : ids) bodies_[slot_of(id)].reset();
  events_.touches.forget(ids, events_.pending);
  return PLUMB_OK;
}

void World::wake(Body& body) {
  if (!needs(PLUMB_NEED_SLEEPING) || body.is(PLUMB_STATIC)) return;
  body.forceActivationState(body.getActivationState() == DISABLE_DEACTIVATION ? DISABLE_DEACTIVATION : ACTIVE_TAG);
  body.setDeactivationTime(0);
}

/// What leans on a body that goes away must fall.
void World::wake_neighbours(const Body& body) {
  if (!needs(PLUMB_NEED_SLEEPING)) return;
  for (int i = 0; i < parts_.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *parts_.dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getBody0() == &body) wake(*our_body(manifold.getBody1()));
    if (manifold.getBody1() == &body) wake(*our_body(manifold.getBody0()));
  }
}

/// Joints write into the same lists: Bullet keeps a body there as often as it was put, and takes it out once a time.
PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) {
    Body &a = body(pair.body_a), &b = body(pair.body_b);
    a.setIgnoreCollisionCheck(&b, !touch);
    b.setIgnoreCollisionCheck(&a, !touch);
    if (!touch) forget_contacts(a, b);
  }
  return PLUMB_OK;
}

void World::forget_contacts(Body& a, Body& b) {
  btOverlappingPairCache& pairs = *parts_.broadphase.getOverlappingPairCache();
  if (btBroadphasePair* pair = pairs.findPair(a.getBroadphaseHandle(), b.getBroadphaseHandle()); pair != nullptr)
    pairs.cleanOverlappingPair(*pair, &parts_.dispatcher);
}

/// In force where filters or sensors were declared; without them Bullet's own rule will do.
bool World::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  if (a->m_collisionFilterGroup == 0 || b->m_collisionFilterGroup == 0) return false;
  PLUMB_ASSERT(a->m_clientObject != nullptr && b->m_clientObject != nullptr && a->m_clientObject != b->m_clientObject);
  const Body& body_a = *our_body(static_cast<const btCollisionObject*>(a->m_clientObject));
  const Body& body_b = *our_body(static_cast<const btCollisionObject*>(b->m_clientObject));
  const bool sensed = body_a.is_sensor() != body_b.is_sensor();
  const bool moved = sensed ? !(body_a.is(PLUMB_STATIC) && body_b.is(PLUMB_STATIC))
                            : body_a.is(PLUMB_DYNAMIC) || body_b.is(PLUMB_DYNAMIC);
  const bool both_sense = body_a.is_sensor() && body_b.is_sensor();
  return moved && !both_sense && may_touch(body_a.filter, body_b.filter);
}

}  // namespace plumb::bullet
