// Bodies of a world: made, placed, read, written, taken away.
#include <algorithm>
#include <cmath>
#include <string>

#include "bodies/axis_locks.hpp"
#include "plugin/ranges.hpp"
#include "plugin/rows/put_rows.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

bool is_isotropic(const PlumbVec3& inertia) { return inertia.x == inertia.y && inertia.y == inertia.z; }

}  // namespace

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  for (std::size_t i = 0; i < descs.size(); ++i) require_range(descs[i], i);
  std::uint32_t slots = simulation_.bodies.count;
  for (const PlumbBody id : ids) slots = std::max(slots, slot_of(id) + 1);
  simulation_.reserve_bodies(slots);
  if (bodies_.size() < slots) bodies_.resize(slots);
  simulation_.bodies.count = slots;
  rows_.ids.resize(slots);
  Simulation::Slots sleepers;
  std::size_t made = 0;
  try {
    for (; made < descs.size(); ++made) {
      if ((descs[made].flags & PLUMB_BODY_ASLEEP) != 0) sleepers.push_back(slot_of(ids[made]));
      make_body(descs[made], ids[made]);
    }
  } catch (...) {  // no memory is left
    for (std::size_t i = 0; i <= made; ++i) unmake_body(slot_of(ids[i]));
    sensors_.remove_if([&](std::uint32_t slot) { return bodies_[slot].id == 0; });
    simulation_.bodies_changed();
    throw;
  }
  ++rows_.generation;
  simulation_.bodies_changed();
  if (!sleepers.empty()) simulation_.put_to_sleep(sleepers);
  return PLUMB_OK;
}

/// What of a body is in the engine's rows.
void World::unmake_body(std::uint32_t slot) {
  if (bodies_[slot].motion == PLUMB_DYNAMIC) --dynamic_count_;
  detach(slot);
  bodies_[slot] = {};
  rows_.ids[slot] = 0;
  simulation_.bodies.mass.edit(slot) = {};
  simulation_.bodies.force.edit(slot) = {};
  simulation_.bodies.state.velocity[slot] = {};
  simulation_.bodies.state.touch(slot, kVelocityPart);
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  if (init_.needs(PLUMB_NEED_EVENTS) || init_.needs(PLUMB_NEED_SENSORS)) told_.touches.forget(ids, told_.early_events);
  if (init_.needs(PLUMB_NEED_CONTACTS)) contacts();  // while the bodies are where the step left them
  wake_for_write(PLUMB_FIELD_POSE, ids);
  for (const PlumbBody id : ids) unmake_body(slot_of(id));
  sensors_.remove_if([&](std::uint32_t slot) { return bodies_[slot].id == 0; });
  std::erase_if(told_.records, [&](const ContactRecord& record) {  // their slots will be others'
    return bodies_[record.bodies.a].id == 0 || bodies_[record.bodies.b].id == 0;
  });
  std::erase_if(lent_.contacts, [&](const PlumbContact& contact) {
    return bodies_[slot_of(contact.body_a)].id == 0 || bodies_[slot_of(contact.body_b)].id == 0;
  });
  Simulation::Slots gone;
  for (const PlumbBody id : ids) gone.push_back(slot_of(id));
  simulation_.forget(gone);
  ++rows_.generation;
  simulation_.bodies_changed();
  pacing_.lets_go = true;
  return PLUMB_OK;
}

void World::make_body(const PlumbBodyDesc& desc, PlumbBody id) {
  const std::uint32_t slot = slot_of(id);
  BodyRecord& body = bodies_[slot];
  body = {};
  body.id = rows_.ids[slot] = id;
  body.material = desc.material;
  body.filter = desc.filter;
  body.gravity_scale = desc.gravity_scale;
  body.linear_damping = desc.linear_damping;
  body.angular_damping = desc.angular_damping;
  body.rolling_friction = desc.rolling_friction;
  body.spinning_friction = desc.spinning_friction;
  simulation_.bodies.force.edit(slot) = {};
  embody(slot, desc);
}

/// What the engine has of a body, of the motion, shape, mass, flags, locks, pose and velocities of a descriptor.
void World::embody(std::uint32_t slot, const PlumbBodyDesc& desc) {
  BodyRecord& body = bodies_[slot];
  body.motion = desc.motion;
  BodyFrame frame{{0, 0, 0}, {0, 0, 0, 1}};
  BodyMass mass{};
  Real inverse_mass = 0;
  const bool dynamic = desc.motion == PLUMB_DYNAMIC;
  if (dynamic) ++dynamic_count_;
  if (desc.motion != PLUMB_STATIC) mass.flags |= kBodyMoves | kBodyTurns;
  if (desc.motion == PLUMB_KINEMATIC && continuous_) mass.flags |= kBodySweeps;
  if ((desc.flags & PLUMB_BODY_MODIFY_CONTACTS) != 0) {
    mass.flags |= kBodyShowsContacts;
    simulation_.expect_modification();
  }
  if (dynamic) {
    mass.flags |= kBodyDynamic;
    if ((desc.flags & PLUMB_BODY_NEVER_SLEEPS) != 0) mass.flags |= kBodyNeverSleeps;
    if ((desc.flags & PLUMB_BODY_CCD) != 0) {
      mass.flags |= kBodyContinuous;
      make_continuous(true);
    }
    inverse_mass = static_cast<Real>(1 / desc.mass);
    frame.centre_of_mass = to_position(desc.centre_of_mass);
    if (desc.locks != 0) mass.flags |= kBodyLocked | desc.locks * kLockLinear;
    const bool turns = (desc.flags & PLUMB_BODY_NO_ROTATION) == 0 && init_.needs(PLUMB_NEED_ROTATION);
    if (turns) {
      mass.inertia = to_vec(desc.inertia);
      const auto inverse = [](double moment) { return moment > 0 ? static_cast<Real>(1 / moment) : Real(0); };
      mass.inverse_inertia = {inverse(desc.inertia.x), inverse(desc.inertia.y), inverse(desc.inertia.z)};
      if (!is_isotropic(desc.inertia)) {
        if ((desc.locks >> 3) == 0) mass.flags |= kBodyGyroscopic;  // whoever is held does not tumble
        frame.principal = to_double(desc.inertia_orientation);
      }
    } else {
      mass.flags &= ~static_cast<std::uint32_t>(kBodyTurns);
    }
  }
  simulation_.bodies.mass.edit(slot) = mass;
  simulation_.bodies.frames.edit(slot) = frame;
  Velocity& velocity = simulation_.bodies.state.velocity[slot];
  velocity.inverse_mass = inverse_mass;
  velocity.linear = desc.motion == PLUMB_STATIC ? Vec{0, 0, 0} : to_vec(desc.linear_velocity);
  velocity.angular = (mass.flags & kBodyTurns) != 0 ? to_vec(desc.angular_velocity) : Vec{0, 0, 0};
  hold_locked(slot);
  stop_infinite(slot);
  simulation_.bodies.state.touch(slot, kVelocityPart);
  place(slot, desc.pose);

  put_body_rows(slot);
  body.senses = (desc.flags & PLUMB_BODY_SENSOR) != 0;
  if (body.senses) sensors_.add(slot);
  const bool has_place = init_.needs(PLUMB_NEED_COLLISION) || init_.needs(PLUMB_NEED_SENSORS);
  if (desc.shape != 0 && has_place) attach(slot, slot_of(desc.shape));
}

/// From the first flagged body on: where there is none kinematic bodies go as they would without.
void World::make_continuous(bool continuous) {
  if (continuous_ == continuous) return;
  continuous_ = continuous;
  simulation_.make_continuous(continuous);
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot) {
    if (bodies_[slot].id == 0 || bodies_[slot].motion != PLUMB_KINEMATIC) continue;
    std::uint32_t& flags = simulation_.bodies.mass.edit(slot).flags;
    flags = continuous ? flags | kBodySweeps : flags & ~static_cast<std::uint32_t>(kBodySweeps);
  }
}

/// What of a body's record is copied into rows that kernels read.
void World::put_body_rows(std::uint32_t slot) {
  const BodyRecord& body = bodies_[slot];
  BodyMass& mass = simulation_.bodies.mass.edit(slot);
  mass.gravity_scale = static_cast<Real>(body.gravity_scale);
  mass.linear_damping = static_cast<Real>(body.linear_damping);
  mass.angular_damping = static_cast<Real>(body.angular_damping);
  if (slot < simulation_.bodies.rolling_frictions.size())
    simulation_.bodies.rolling_frictions.edit(slot) = {static_cast<Real>(body.rolling_friction),
                                                       static_cast<Real>(body.spinning_friction)};
  if (body.proxy != kNone) put_proxy_row(slot, body.proxy);
  for (const std::uint32_t row : body.more_proxies) put_proxy_row(slot, row);
}

void World::place(std::uint32_t slot, const PlumbPose& pose) {
  const BodyFrame& frame = simulation_.bodies.frames[slot];
  const QuatD q = to_double(pose.orientation);
  simulation_.bodies.state.position[slot] = to_position(pose.position) + rotate(q, frame.centre_of_mass);
  simulation_.bodies.state.orientation[slot] = to_quat(q * frame.principal);
  simulation_.bodies.state.touch(slot, kPosePart);
  if (bodies_[slot].motion == PLUMB_STATIC) simulation_.statics_changed();
}

/// Where the host's row is right.
PlumbPose World::pose(std::uint32_t slot) const {
  const BodyState& state = simulation_.bodies.state;
  const PoseRow row = pose_row(simulation_.bodies.frames[slot], state.position[slot], state.orientation[slot]);
  PlumbPose pose;
  static_assert(sizeof pose == sizeof row);
  std::memcpy(&pose, &row, sizeof pose);
  return pose;
}

/// Where the host's rows are not right, all rows of the field are brought here at once: who reads reads many.
void World::read_state(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  const BodyState& state = simulation_.bodies.state;
  Executor& executor = simulation_.executor();
  if (field == PLUMB_FIELD_POSE) {
    if (!state.on_host()) return copy_rows(executor, simulation_.pose_rows(true)->rows.host(), ids, rows);
    return put_rows(executor, ids, rows, [&](std::uint32_t slot) {
      return pose_row(simulation_.bodies.frames[slot], state.position[slot], state.orientation[slot]);
    });
  }
  if (!state.on_host()) return copy_rows(executor, simulation_.velocity_rows(true)->rows.host(), ids, rows);
  put_rows(executor, ids, rows, [&](std::uint32_t slot) { return velocity_row(state.velocity[slot]); });
}

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  if (field == PLUMB_FIELD_POSE || field == PLUMB_FIELD_VELOCITY) return read_state(field, ids, rows), PLUMB_OK;
  double row[3];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const BodyRecord& body = bodies_[slot_of(ids[i])];
    switch (field) {
      case PLUMB_FIELD_AWAKE: row[0] = simulation_.sleeps(slot_of(ids[i])) ? 0 : 1; break;
      case PLUMB_FIELD_MATERIAL:
        row[0] = body.material.friction;
        row[1] = body.material.restitution;
        break;
      case PLUMB_FIELD_SURFACE_VELOCITY:
        row[0] = body.material.surface_velocity.x;
        row[1] = body.material.surface_velocity.y;
        row[2] = body.material.surface_velocity.z;
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
      case PLUMB_FIELD_ROLLING_FRICTION:
        row[0] = body.rolling_friction;
        row[1] = body.spinning_friction;
        break;
      default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
    }
    rows.put(i, row, columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  if (field == PLUMB_FIELD_POSE && init_.needs(PLUMB_NEED_CONTACTS)) records();  // they are told of by places
  if (field == PLUMB_FIELD_AWAKE) return write_awake(ids, rows), PLUMB_OK;
  double row[16];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (field != PLUMB_FIELD_SURFACE_VELOCITY && field != PLUMB_FIELD_ROLLING_FRICTION) break;
    rows.get(i, row, columns_of(field));
    const std::string name = "rows[" + std::to_string(i) + "]";
    field == PLUMB_FIELD_SURFACE_VELOCITY ? require_speed(name, {row[0], row[1], row[2]})
                                          : require_rolling_friction(name + ".", row[0], row[1]);
  }
  wake_for_write(field, ids);
  pacing_.lets_go = pacing_.lets_go || field == PLUMB_FIELD_POSE || field == PLUMB_FIELD_FILTER;
  fetch_for_write(field, ids);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, columns_of(field));
    write_row(field, slot_of(ids[i]), row);
  }
  return PLUMB_OK;
}

/// What of the bodies' state a write builds upon.
void World::fetch_for_write(PlumbField field, std::span<const PlumbBody> ids) {
  if (field < PLUMB_FIELD_IMPULSE || field > PLUMB_FIELD_IMPULSE_AT_POINT) return;
  std::vector<std::uint32_t> slots(ids.size());
  std::transform(ids.begin(), ids.end(), slots.begin(), [](PlumbBody id) { return slot_of(id); });
  simulation_.bodies.state.fetch(slots, kPosePart | kVelocityPart);
}

/// The quarantine of what comes from outside: a velocity beyond the engine's numbers is 0 and reported, or it would
/// spread to whatever the body touches.
void World::stop_infinite(std::uint32_t slot) {
  Velocity& velocity = simulation_.bodies.state.velocity[slot];
  if (is_finite(velocity.linear) && is_finite(velocity.angular)) return;
  velocity.linear = velocity.angular = {0, 0, 0};
  ++stopped_;
}

void World::hold_locked(std::uint32_t slot) {
  const std::uint32_t flags = simulation_.bodies.mass[slot].flags;
  Velocity& velocity = simulation_.bodies.state.velocity[slot];
  velocity.linear = unlocked(flags, kLockLinear, velocity.linear);
  velocity.angular = unlocked(flags, kLockAngular, velocity.angular);
}

void World::push(std::uint32_t slot, const Vec& force, const Vec& torque) {
  BodyForce& all = simulation_.bodies.force.edit(slot);
  all.force += force;
  all.torque += torque;
  if (!is_finite(all.force) || !is_finite(all.torque)) {
    all = {};
    ++stopped_;
  }
  pushed_.push_back(slot);
}

void World::kick(std::uint32_t slot, const Vec& impulse, const Vec& angular_impulse) {
  Velocity& velocity = simulation_.bodies.state.velocity[slot];
  velocity.linear += velocity.inverse_mass * impulse;
  const BodyMass& mass = simulation_.bodies.mass[slot];
  velocity.angular += world_inverse_inertia(simulation_.bodies.state.orientation[slot], mass) * angular_impulse;
  hold_locked(slot);
  stop_infinite(slot);
  simulation_.bodies.state.touch(slot, kVelocityPart);
}

void World::write_row(PlumbField field, std::uint32_t slot, const double* row) {
  BodyRecord& body = bodies_[slot];
  const Vec v = to_vec(row);
  const auto arm = [&] { return between(simulation_.bodies.state.position[slot], {row[3], row[4], row[5]}); };
  switch (field) {
    case PLUMB_FIELD_POSE: {
      if (body.arrived) {  // the velocity was that of the way there
        simulation_.bodies.state.velocity[slot].linear = simulation_.bodies.state.velocity[slot].angular = {0, 0, 0};
        simulation_.bodies.state.touch(slot, kVelocityPart);
      }
      place(slot, {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}});
      body.to_target = body.arrived = false;
      return;
    }
    case PLUMB_FIELD_VELOCITY:
      if (body.motion == PLUMB_STATIC) return;
      simulation_.bodies.state.velocity[slot].linear = v;
      if ((simulation_.bodies.mass[slot].flags & kBodyTurns) != 0)
        simulation_.bodies.state.velocity[slot].angular = to_vec(row + 3);
      hold_locked(slot);
      stop_infinite(slot);
      body.to_target = body.arrived = false;
      return simulation_.bodies.state.touch(slot, kVelocityPart);
    case PLUMB_FIELD_FORCE: return push(slot, v, {0, 0, 0});
    case PLUMB_FIELD_TORQUE: return push(slot, {0, 0, 0}, v);
    case PLUMB_FIELD_FORCE_AT_POINT: return push(slot, v, cross(arm(), v));
    case PLUMB_FIELD_IMPULSE: return kick(slot, v, {0, 0, 0});
    case PLUMB_FIELD_ANGULAR_IMPULSE: return kick(slot, {0, 0, 0}, v);
    case PLUMB_FIELD_IMPULSE_AT_POINT: return kick(slot, v, cross(arm(), v));
    case PLUMB_FIELD_KINEMATIC_TARGET:
      body.target = {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}};
      body.to_target = true;
      return steered_.add(slot);
    case PLUMB_FIELD_MATERIAL:
      body.material.friction = row[0];
      body.material.restitution = row[1];
      return put_body_rows(slot);
    case PLUMB_FIELD_SURFACE_VELOCITY:
      body.material.surface_velocity = {row[0], row[1], row[2]};
      return put_body_rows(slot);
    case PLUMB_FIELD_GRAVITY_SCALE: body.gravity_scale = row[0]; return put_body_rows(slot);
    case PLUMB_FIELD_DAMPING:
      body.linear_damping = row[0];
      body.angular_damping = row[1];
      return put_body_rows(slot);
    case PLUMB_FIELD_FILTER:
      body.filter.category = static_cast<std::uint32_t>(row[0]);
      body.filter.mask = static_cast<std::uint32_t>(row[1]);
      body.filter.group = static_cast<std::int32_t>(row[2]);
      return put_body_rows(slot);
    case PLUMB_FIELD_ROLLING_FRICTION:
      body.rolling_friction = row[0];
      body.spinning_friction = row[1];
      return put_body_rows(slot);
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::impulse
