// Shapes and bodies of a world: made, placed, read, written, taken away.
#include <algorithm>
#include <cmath>
#include <string>

#include "exec/floating_point.hpp"
#include "plugin/ranges.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

PlumbQuat plumb_quat(const QuatD& q) { return {q.x, q.y, q.z, q.w}; }
bool is_identity(const QuatD& q) { return q.x == 0 && q.y == 0 && q.z == 0; }
bool is_isotropic(const PlumbVec3& inertia) { return inertia.x == inertia.y && inertia.y == inertia.z; }

Shape to_shape(const PlumbShapeDesc& desc, HullPool& hulls) {
  Shape shape{};
  switch (desc.type) {
    case PLUMB_SPHERE:
      shape.type = ShapeType::kSphere;
      shape.size = {static_cast<Real>(desc.radius), 0, 0};
      shape.reach = shape.size.x;
      break;
    case PLUMB_BOX:
      shape.type = ShapeType::kBox;
      shape.size = to_vec(desc.half_extents);
      shape.reach = length(shape.size);
      break;
    case PLUMB_CAPSULE:
      shape.type = ShapeType::kCapsule;
      shape.size = {static_cast<Real>(desc.radius), static_cast<Real>(desc.half_height), 0};
      shape.reach = shape.size.x + shape.size.y;
      break;
    case PLUMB_CONVEX_HULL:
      shape.type = ShapeType::kHull;
      shape.hull = hulls.add({reinterpret_cast<const PlumbVec3*>(desc.vertices), desc.vertex_count});
      shape.reach = hulls.reach(shape.hull);
      break;
    default: throw Error(PLUMB_E_UNSUPPORTED, "shape type " + std::to_string(desc.type) + " is not in impulse yet");
  }
  return shape;
}

void dismantle(const Shape& shape, HullPool& hulls) {
  if (shape.type == ShapeType::kHull) hulls.remove(shape.hull);
}

}  // namespace

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  for (std::size_t i = 0; i < descs.size(); ++i) require_range(descs[i], i);
  std::vector<Shape> made;
  made.reserve(descs.size());
  try {
    for (const PlumbShapeDesc& desc : descs) made.push_back(to_shape(desc, simulation_.hulls));
  } catch (...) {
    for (const Shape& shape : made) dismantle(shape, simulation_.hulls);
    throw;
  }
  for (std::size_t i = 0; i < descs.size(); ++i) {
    simulation_.reserve_shapes(slot_of(ids[i]) + 1);
    simulation_.shapes[slot_of(ids[i])] = made[i];
  }
  simulation_.bodies_changed();
  return PLUMB_OK;
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) dismantle(simulation_.shapes[slot_of(id)], simulation_.hulls);
  return PLUMB_OK;
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  const FloatingPointScope scope;
  for (std::size_t i = 0; i < descs.size(); ++i) require_range(descs[i], i);
  std::uint32_t slots = simulation_.body_count();
  for (const PlumbBody id : ids) slots = std::max(slots, slot_of(id) + 1);
  simulation_.reserve_bodies(slots);
  simulation_.bring_state_to_host();
  if (bodies_.size() < slots) bodies_.resize(slots);
  for (std::uint32_t slot = simulation_.body_count(); slot < slots; ++slot) simulation_.proxies[slot].shape = kNone;
  simulation_.set_body_count(slots);
  for (std::size_t i = 0; i < descs.size(); ++i) make_body(descs[i], ids[i]);
  simulation_.bodies_changed();
  simulation_.state_changed();
  return PLUMB_OK;
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  simulation_.bring_state_to_host();
  if (init_.needs(PLUMB_NEED_EVENTS)) touches_.forget(ids, early_events_);
  if (init_.needs(PLUMB_NEED_CONTACTS)) records();  // while the bodies are where the step left them
  for (const PlumbBody id : ids) {
    const std::uint32_t slot = slot_of(id);
    if (bodies_[slot].motion == PLUMB_DYNAMIC) --dynamic_count_;
    bodies_[slot] = {};
    simulation_.proxies[slot].shape = kNone;
    simulation_.mass[slot] = {};
    simulation_.velocity[slot] = {};
    simulation_.force[slot] = {};
  }
  std::erase_if(records_, [&](const ContactRecord& record) {  // their slots will be others'
    return bodies_[record.pair.a].id == 0 || bodies_[record.pair.b].id == 0;
  });
  simulation_.bodies_changed();
  simulation_.state_changed();
  return PLUMB_OK;
}

void World::make_body(const PlumbBodyDesc& desc, PlumbBody id) {
  const std::uint32_t slot = slot_of(id);
  BodyRecord& body = bodies_[slot];
  body = {};
  body.id = id;
  body.motion = desc.motion;
  body.material = desc.material;
  body.filter = desc.filter;
  body.gravity_scale = desc.gravity_scale;
  body.linear_damping = desc.linear_damping;
  body.angular_damping = desc.angular_damping;

  BodyMass mass{};
  Real inverse_mass = 0;
  const bool dynamic = desc.motion == PLUMB_DYNAMIC;
  if (desc.motion != PLUMB_STATIC) mass.flags |= kBodyMoves | kBodyTurns;
  if (dynamic) {
    mass.flags |= kBodyDynamic;
    ++dynamic_count_;
    inverse_mass = static_cast<Real>(1 / desc.mass);
    body.centre_of_mass = to_position(desc.centre_of_mass);
    const bool turns = (desc.flags & PLUMB_BODY_NO_ROTATION) == 0 && init_.needs(PLUMB_NEED_ROTATION);
    if (turns) {
      mass.inertia = to_vec(desc.inertia);
      const auto inverse = [](double moment) { return moment > 0 ? static_cast<Real>(1 / moment) : Real(0); };
      mass.inverse_inertia = {inverse(desc.inertia.x), inverse(desc.inertia.y), inverse(desc.inertia.z)};
      if (!is_isotropic(desc.inertia)) {
        mass.flags |= kBodyGyroscopic;
        body.principal = to_double(desc.inertia_orientation);
      }
    } else {
      mass.flags &= ~static_cast<std::uint32_t>(kBodyTurns);
    }
  }
  simulation_.mass[slot] = mass;
  Velocity& velocity = simulation_.velocity[slot];
  velocity.inverse_mass = inverse_mass;
  velocity.linear = desc.motion == PLUMB_STATIC ? Vec{0, 0, 0} : to_vec(desc.linear_velocity);
  velocity.angular = (mass.flags & kBodyTurns) != 0 ? to_vec(desc.angular_velocity) : Vec{0, 0, 0};
  stop_infinite(slot);
  simulation_.force[slot] = {};
  simulation_.forces_changed();
  place(slot, desc.pose);

  Proxy& proxy = simulation_.proxies[slot];
  proxy = {};
  proxy.body = slot;
  proxy.shape = desc.shape == 0 || !init_.needs(PLUMB_NEED_COLLISION) ? kNone : slot_of(desc.shape);
  proxy.born = simulation_.steps() + 1;
  const QuatD to_principal = conjugate(body.principal);
  proxy.frame.orientation = to_quat(to_principal);
  const Position offset = rotate(to_principal, -body.centre_of_mass);
  proxy.frame.position = {static_cast<Real>(offset.x), static_cast<Real>(offset.y), static_cast<Real>(offset.z)};
  put_proxy_rows(slot);
}

/// What of a body's record is copied into rows that kernels read.
void World::put_proxy_rows(std::uint32_t slot) {
  const BodyRecord& body = bodies_[slot];
  Proxy& proxy = simulation_.proxies[slot];
  proxy.friction = static_cast<Real>(body.material.friction);
  proxy.restitution = static_cast<Real>(body.material.restitution);
  BodyMass& mass = simulation_.mass[slot];
  mass.gravity_scale = static_cast<Real>(body.gravity_scale);
  mass.linear_damping = static_cast<Real>(body.linear_damping);
  mass.angular_damping = static_cast<Real>(body.angular_damping);
  const std::uint32_t immovable = body.motion == PLUMB_DYNAMIC ? 0 : kProxyImmovable;
  simulation_.filters[slot] = {slot, body.filter.category, body.filter.mask, body.filter.group, immovable};
  simulation_.bodies_changed();
}

void World::place(std::uint32_t slot, const PlumbPose& pose) {
  const BodyRecord& body = bodies_[slot];
  const QuatD q = to_double(pose.orientation);
  simulation_.position[slot] = to_position(pose.position) + rotate(q, body.centre_of_mass);
  simulation_.orientation[slot] = to_quat(q * body.principal);
  if (body.motion == PLUMB_STATIC) simulation_.statics_changed();
}

PlumbPose World::pose(std::uint32_t slot) const {
  const BodyRecord& body = bodies_[slot];
  const Position& p = simulation_.position[slot];
  QuatD q = to_double(simulation_.orientation[slot]);
  if (!is_identity(body.principal)) q = q * conjugate(body.principal);
  const Position at = p - rotate(q, body.centre_of_mass);
  return {{at.x, at.y, at.z}, plumb_quat(q)};
}

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  if (field == PLUMB_FIELD_POSE || field == PLUMB_FIELD_VELOCITY) simulation_.bring_state_to_host();
  double row[7];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t slot = slot_of(ids[i]);
    const BodyRecord& body = bodies_[slot];
    switch (field) {
      case PLUMB_FIELD_POSE: {
        const PlumbPose at = pose(slot);
        std::memcpy(row, &at, sizeof at);
        break;
      }
      case PLUMB_FIELD_VELOCITY: {
        const Velocity& v = simulation_.velocity[slot];
        const PlumbVec3 both[2] = {to_plumb(v.linear), to_plumb(v.angular)};
        std::memcpy(row, both, sizeof both);
        break;
      }
      case PLUMB_FIELD_AWAKE: row[0] = 1; break;
      case PLUMB_FIELD_MATERIAL:
        row[0] = body.material.friction;
        row[1] = body.material.restitution;
        break;
      case PLUMB_FIELD_GRAVITY_SCALE: row[0] = body.gravity_scale; break;
      case PLUMB_FIELD_DAMPING:
        row[0] = body.linear_damping;
        row[1] = body.angular_damping;
        break;
      case PLUMB_FIELD_FILTER:
        row[0] = body.filter.category;
        row[1] = body.filter.mask;
        row[2] = body.filter.group;
        break;
      default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
    }
    rows.put(i, row, columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  const FloatingPointScope scope;
  if (field == PLUMB_FIELD_POSE && init_.needs(PLUMB_NEED_CONTACTS)) records();  // they are told of by places
  simulation_.bring_state_to_host();
  double row[16];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, columns_of(field));
    write_row(field, slot_of(ids[i]), row);
  }
  return PLUMB_OK;
}

/// The quarantine of what comes from outside: a velocity beyond the engine's numbers is 0 and reported, or it would
/// spread to whatever the body touches.
void World::stop_infinite(std::uint32_t slot) {
  Velocity& velocity = simulation_.velocity[slot];
  if (is_finite(velocity.linear) && is_finite(velocity.angular)) return;
  velocity.linear = velocity.angular = {0, 0, 0};
  ++stopped_;
}

void World::push(std::uint32_t slot, const Vec& force, const Vec& torque) {
  BodyForce& all = simulation_.force[slot];
  all.force += force;
  all.torque += torque;
  if (!is_finite(all.force) || !is_finite(all.torque)) {
    all = {};
    ++stopped_;
  }
  pushed_.push_back(slot);
  simulation_.forces_changed();
}

void World::kick(std::uint32_t slot, const Vec& impulse, const Vec& angular_impulse) {
  Velocity& velocity = simulation_.velocity[slot];
  velocity.linear += velocity.inverse_mass * impulse;
  const Mat axes = to_matrix(simulation_.orientation[slot]);
  velocity.angular += rotated_diagonal(axes, simulation_.mass[slot].inverse_inertia) * angular_impulse;
  stop_infinite(slot);
  simulation_.state_changed();
}

void World::write_row(PlumbField field, std::uint32_t slot, const double* row) {
  BodyRecord& body = bodies_[slot];
  const Vec v = to_vec(row);
  const auto arm = [&] { return between(simulation_.position[slot], {row[3], row[4], row[5]}); };
  switch (field) {
    case PLUMB_FIELD_POSE: {
      place(slot, {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}});
      body.to_target = body.arrived = false;
      return simulation_.state_changed();
    }
    case PLUMB_FIELD_VELOCITY:
      if (body.motion == PLUMB_STATIC) return;
      simulation_.velocity[slot].linear = v;
      if ((simulation_.mass[slot].flags & kBodyTurns) != 0) simulation_.velocity[slot].angular = to_vec(row + 3);
      stop_infinite(slot);
      body.to_target = body.arrived = false;
      return simulation_.state_changed();
    case PLUMB_FIELD_FORCE: return push(slot, v, {0, 0, 0});
    case PLUMB_FIELD_TORQUE: return push(slot, {0, 0, 0}, v);
    case PLUMB_FIELD_FORCE_AT_POINT: return push(slot, v, cross(arm(), v));
    case PLUMB_FIELD_IMPULSE: return kick(slot, v, {0, 0, 0});
    case PLUMB_FIELD_ANGULAR_IMPULSE: return kick(slot, {0, 0, 0}, v);
    case PLUMB_FIELD_IMPULSE_AT_POINT: return kick(slot, v, cross(arm(), v));
    case PLUMB_FIELD_AWAKE: return;  // nothing sleeps
    case PLUMB_FIELD_KINEMATIC_TARGET:
      body.target = {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}};
      body.to_target = true;
      if (std::find(steered_.begin(), steered_.end(), slot) == steered_.end()) steered_.push_back(slot);
      return;
    case PLUMB_FIELD_MATERIAL:
      body.material.friction = row[0];
      body.material.restitution = row[1];
      return put_proxy_rows(slot);
    case PLUMB_FIELD_GRAVITY_SCALE: body.gravity_scale = row[0]; return put_proxy_rows(slot);
    case PLUMB_FIELD_DAMPING:
      body.linear_damping = row[0];
      body.angular_damping = row[1];
      return put_proxy_rows(slot);
    case PLUMB_FIELD_FILTER:
      body.filter.category = static_cast<std::uint32_t>(row[0]);
      body.filter.mask = static_cast<std::uint32_t>(row[1]);
      body.filter.group = static_cast<std::int32_t>(row[2]);
      return put_proxy_rows(slot);
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::impulse
