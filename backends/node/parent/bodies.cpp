// Bodies and the fields of their state.
#include "append.hpp"
#include "plumb/backend/mass_properties.hpp"
#include "plumb/backend/small_math.hpp"
#include "world.hpp"

namespace plumb::wire {

using namespace backend;

namespace {

/// The fields whose value is what was last written: the child is told, and never asked.
bool is_mirrored(PlumbField field) { return field > PLUMB_FIELD_MASS; }

void read_mirror(PlumbField field, const PlumbBodyDesc& desc, std::vector<double>& row) {
  row.clear();
  switch (field) {
    case PLUMB_FIELD_MATERIAL: row = {desc.material.friction, desc.material.restitution}; break;
    case PLUMB_FIELD_GRAVITY_SCALE: row = {desc.gravity_scale}; break;
    case PLUMB_FIELD_DAMPING: row = {desc.linear_damping, desc.angular_damping}; break;
    case PLUMB_FIELD_SURFACE_VELOCITY: append(row, desc.material.surface_velocity); break;
    case PLUMB_FIELD_ROLLING_FRICTION: row = {desc.rolling_friction, desc.spinning_friction}; break;
    default: append(row, desc.filter);
  }
}

/// I^-1 L in world axes. A body with inertia 0 does not turn.
PlumbVec3 spin_of(const PlumbBodyDesc& desc, const PlumbQuat& orientation, const PlumbVec3& angular_momentum) {
  if (desc.inertia.x <= 0 || (desc.flags & PLUMB_BODY_NO_ROTATION) != 0) return {};
  const PlumbQuat axes = multiply(orientation, desc.inertia_orientation);
  const PlumbVec3 l = unrotate(axes, angular_momentum);
  return rotate(axes, {l.x / desc.inertia.x, l.y / desc.inertia.y, l.z / desc.inertia.z});
}

}  // namespace

PlumbBody World::handle_of(double slot) const {
  const auto place = static_cast<std::size_t>(slot);
  if (!(slot >= 0) || place >= bodies_.size() || bodies_[place].handle == 0)
    throw Error(PLUMB_E_WORLD_LOST, "the child named body slot " + std::to_string(slot) + ", which is nobody's");
  return bodies_[place].handle;
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  std::vector<double> rows = {double(descs.size())};
  for (std::size_t i = 0; i < descs.size(); ++i) append_body(rows, slot_of(ids[i]), descs[i]);
  call(Call::kCreateBodies, rows);
  for (std::size_t i = 0; i < descs.size(); ++i) {
    if (slot_of(ids[i]) >= bodies_.size()) bodies_.resize(slot_of(ids[i]) + 1);
    body(ids[i]) = {ids[i], descs[i], (descs[i].flags & PLUMB_BODY_ASLEEP) == 0};
  }
  tell_rolling_friction(descs, ids);
  return PLUMB_OK;
}

/// A body's row has none.
void World::tell_rolling_friction(std::span<const PlumbBodyDesc> descs, std::span<const PlumbBody> ids) {
  std::vector<PlumbBody> rough;
  std::vector<double> rows;
  for (std::size_t i = 0; i < descs.size(); ++i) {
    if (descs[i].rolling_friction == 0 && descs[i].spinning_friction == 0) continue;
    rough.push_back(ids[i]);
    rows.insert(rows.end(), {descs[i].rolling_friction, descs[i].spinning_friction});
  }
  write_rows(PLUMB_FIELD_ROLLING_FRICTION, rough, rows);
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  std::vector<double> slots;
  for (const PlumbBody id : ids) slots.push_back(slot_of(id));
  call(Call::kDestroyBodies, slots);
  touches_.forget(ids, ended_);
  for (const PlumbBody id : ids) {
    pushes_.erase(id);
    targets_.erase(id);
    std::erase(aimed_, id);
    body(id) = {};
  }
  return PLUMB_OK;
}

std::vector<double> World::read_rows(PlumbField field, std::span<const PlumbBody> ids) {
  std::vector<double> row = {double(field)};
  for (const PlumbBody id : ids) row.push_back(slot_of(id));
  Frame reply = call(Call::kRead, row);
  if (reply.numbers.size() != ids.size() * columns_of(field))
    throw Error(PLUMB_E_INTERNAL, "the child answered a read with " + std::to_string(reply.numbers.size()) +
                                      " numbers instead of " + std::to_string(ids.size() * columns_of(field)));
  return std::move(reply.numbers);
}

void World::write_rows(PlumbField field, std::span<const PlumbBody> ids, std::span<const double> rows) {
  if (ids.empty()) return;
  const std::size_t columns = columns_of(field);
  std::vector<double> numbers = {double(field)};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    numbers.push_back(slot_of(ids[i]));
    const auto row = rows.subspan(i * columns, columns);
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  call(Call::kWrite, numbers);
}

std::vector<World::Motion> World::motions(std::span<const PlumbBody> ids) {
  const std::vector<double> poses = read_rows(PLUMB_FIELD_POSE, ids), speeds = read_rows(PLUMB_FIELD_VELOCITY, ids);
  std::vector<Motion> all;
  for (std::size_t i = 0; i < ids.size(); ++i)
    all.push_back({pose_at(&poses[7 * i]), vec3_at(&speeds[6 * i]), vec3_at(&speeds[6 * i + 3])});
  return all;
}

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  if (ids.empty()) return PLUMB_OK;
  const std::size_t columns = columns_of(field);
  std::vector<double> row;
  if (is_mirrored(field)) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      read_mirror(field, body(ids[i]).desc, row);
      rows.put(i, row.data(), columns);
    }
    return PLUMB_OK;
  }
  row = read_rows(field, ids);
  for (std::size_t i = 0; i < ids.size(); ++i) rows.put(i, &row[i * columns], columns);
  return PLUMB_OK;
}

void World::write_mirror(PlumbField field, PlumbBody id, const double* row) {
  PlumbBodyDesc& desc = body(id).desc;
  switch (field) {
    case PLUMB_FIELD_MATERIAL: desc.material.friction = row[0], desc.material.restitution = row[1]; break;
    case PLUMB_FIELD_GRAVITY_SCALE: desc.gravity_scale = row[0]; break;
    case PLUMB_FIELD_DAMPING: desc.linear_damping = row[0], desc.angular_damping = row[1]; break;
    case PLUMB_FIELD_SURFACE_VELOCITY: desc.material.surface_velocity = vec3_at(row); break;
    case PLUMB_FIELD_FILTER:
      desc.filter = {static_cast<std::uint32_t>(row[0]), static_cast<std::uint32_t>(row[1]),
                     static_cast<std::int32_t>(row[2]), 0};
      break;
    case PLUMB_FIELD_ROLLING_FRICTION: desc.rolling_friction = row[0], desc.spinning_friction = row[1]; break;
    default: break;
  }
}

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  const std::size_t columns = columns_of(field);
  std::vector<double> values(ids.size() * columns);
  for (std::size_t i = 0; i < ids.size(); ++i) rows.get(i, &values[i * columns], columns);
  if (manifest_.takes(field)) return write_rows(field, ids, values), PLUMB_OK;
  switch (field) {
    case PLUMB_FIELD_FORCE:
    case PLUMB_FIELD_TORQUE:
    case PLUMB_FIELD_FORCE_AT_POINT: add_pushes(field, ids, values); break;
    case PLUMB_FIELD_IMPULSE:
    case PLUMB_FIELD_ANGULAR_IMPULSE:
    case PLUMB_FIELD_IMPULSE_AT_POINT: add_impulses(field, ids, values); break;
    case PLUMB_FIELD_KINEMATIC_TARGET:
      for (std::size_t i = 0; i < ids.size(); ++i) targets_[ids[i]] = pose_at(&values[7 * i]);
      break;
    default:
      if (field == PLUMB_FIELD_VELOCITY) take_away_locked(ids, values);
      write_rows(field, ids, values);
      for (std::size_t i = 0; i < ids.size(); ++i) write_mirror(field, ids[i], &values[i * columns]);
  }
  return PLUMB_OK;
}

void World::take_away_locked(std::span<const PlumbBody> ids, std::span<double> velocities) const {
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t axis = 0; axis < 6; ++axis)
      if ((body(ids[i]).desc.locks >> axis & 1) != 0) velocities[6 * i + axis] = 0;
}

void World::add_pushes(PlumbField field, std::span<const PlumbBody> ids, std::span<const double> rows) {
  const std::size_t columns = columns_of(field);
  std::vector<double> poses;
  if (field == PLUMB_FIELD_FORCE_AT_POINT) poses = read_rows(PLUMB_FIELD_POSE, ids);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (body(ids[i]).desc.motion != PLUMB_DYNAMIC) continue;
    Push& push = pushes_[ids[i]];
    const PlumbVec3 given = vec3_at(&rows[i * columns]);
    if (field == PLUMB_FIELD_TORQUE) {
      push.torque = add(push.torque, given);
      continue;
    }
    push.force = add(push.force, given);
    if (field != PLUMB_FIELD_FORCE_AT_POINT) continue;
    const PlumbPose pose = pose_at(&poses[7 * i]);
    const PlumbVec3 centre = compose(pose, {body(ids[i]).desc.centre_of_mass, {0, 0, 0, 1}}).position;
    push.torque = add(push.torque, cross(sub(vec3_at(&rows[i * columns + 3]), centre), given));
  }
}

void World::add_impulses(PlumbField field, std::span<const PlumbBody> ids, std::span<const double> rows) {
  const std::size_t columns = columns_of(field);
  const std::vector<Motion> before = motions(ids);
  std::vector<PlumbBody> changed;
  std::vector<double> speeds;
  std::map<PlumbBody, PlumbVec3> linear, angular;  // a body may be named more than once
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const PlumbBodyDesc& desc = body(ids[i]).desc;
    if (desc.motion != PLUMB_DYNAMIC) continue;
    const PlumbVec3 given = vec3_at(&rows[i * columns]);
    const PlumbPose& pose = before[i].pose;
    PlumbVec3 turning{};
    if (field == PLUMB_FIELD_ANGULAR_IMPULSE) turning = given;
    if (field == PLUMB_FIELD_IMPULSE_AT_POINT)
      turning = cross(sub(vec3_at(&rows[i * columns + 3]), compose(pose, {desc.centre_of_mass, {0, 0, 0, 1}}).position),
                      given);
    if (linear.try_emplace(ids[i], before[i].linear).second) changed.push_back(ids[i]);
    angular.try_emplace(ids[i], before[i].angular);
    if (field != PLUMB_FIELD_ANGULAR_IMPULSE)
      linear[ids[i]] = add(linear[ids[i]], without_locked(scale(1 / desc.mass, given), desc.locks));
    angular[ids[i]] = add(angular[ids[i]], without_locked(spin_of(desc, pose.orientation, turning), desc.locks >> 3));
  }
  for (const PlumbBody id : changed) {
    append(speeds, linear[id]);
    append(speeds, angular[id]);
  }
  write_rows(PLUMB_FIELD_VELOCITY, changed, speeds);
}

}  // namespace plumb::wire
