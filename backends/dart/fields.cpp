// State of bodies, read and written by field. Bodies hold it; what is written goes to DART before it is next used.
#include "world.hpp"

namespace plumb::dart6 {
namespace {

void read_row(PlumbField field, const Body& body, double* row) {
  const PlumbBodyDesc& desc = body.desc;
  switch (field) {
    case PLUMB_FIELD_POSE:
      put(body.pose.position, row);
      put(PlumbVec3{body.pose.orientation.x, body.pose.orientation.y, body.pose.orientation.z}, row + 3);
      row[6] = body.pose.orientation.w;
      return;
    case PLUMB_FIELD_VELOCITY: put(body.velocity, row); return put(body.spin, row + 3);
    case PLUMB_FIELD_AWAKE: row[0] = 1; return;
    case PLUMB_FIELD_MATERIAL:
      row[0] = desc.material.friction;
      row[1] = desc.material.restitution;
      return;
    case PLUMB_FIELD_GRAVITY_SCALE: row[0] = desc.gravity_scale; return;
    case PLUMB_FIELD_DAMPING:
      row[0] = desc.linear_damping;
      row[1] = desc.angular_damping;
      return;
    case PLUMB_FIELD_SURFACE_VELOCITY: return put(desc.material.surface_velocity, row);
    case PLUMB_FIELD_FILTER:
      row[0] = desc.filter.category;
      row[1] = desc.filter.mask;
      row[2] = desc.filter.group;
      return;
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
  }
}

}  // namespace

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  double row[16] = {};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    read_row(field, body(ids[i]), row);
    rows.put(i, row, columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  double row[16] = {};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, columns_of(field));
    write_row(field, body(ids[i]), row);
  }
  return PLUMB_OK;
}

/// What is linked to it is linked to the world where it stands.
void World::move_ground(const Body& ground) {
  for (const auto& joint : joints_)
    if (joint && (joint->a == &ground || joint->b == &ground)) return make_stale();
}

void World::write_row(PlumbField field, Body& at, const double* row) {
  const PlumbVec3 v{row[0], row[1], row[2]};
  const auto arm = [&] { return sub({row[3], row[4], row[5]}, at.centre()); };
  PlumbBodyDesc& desc = at.desc;
  switch (field) {
    case PLUMB_FIELD_POSE:
      at.pose = {v, normalized(pose_of(row).orientation)};
      at.moving = Body::Moving::as_told;
      at.written = true;
      if (at.is(PLUMB_STATIC)) move_ground(at);
      return;
    case PLUMB_FIELD_VELOCITY:
      at.velocity = v;
      at.spin = {row[3], row[4], row[5]};
      at.moving = Body::Moving::as_told;
      at.written = true;
      return;
    case PLUMB_FIELD_FORCE: at.force = add(at.force, v); return;
    case PLUMB_FIELD_TORQUE: at.torque = add(at.torque, v); return;
    case PLUMB_FIELD_FORCE_AT_POINT:
      at.force = add(at.force, v);
      at.torque = add(at.torque, cross(arm(), v));
      return;
    case PLUMB_FIELD_IMPULSE: return push(at, v, {});
    case PLUMB_FIELD_ANGULAR_IMPULSE: return push(at, {}, v);
    case PLUMB_FIELD_IMPULSE_AT_POINT: return push(at, v, cross(arm(), v));
    case PLUMB_FIELD_KINEMATIC_TARGET:
      at.target = {v, normalized(pose_of(row).orientation)};
      at.moving = Body::Moving::to_target;
      return;
    case PLUMB_FIELD_MATERIAL:
      desc.material.friction = row[0];
      desc.material.restitution = row[1];
      return;
    case PLUMB_FIELD_GRAVITY_SCALE: desc.gravity_scale = row[0]; return;
    case PLUMB_FIELD_DAMPING:
      desc.linear_damping = row[0];
      desc.angular_damping = row[1];
      return;
    case PLUMB_FIELD_SURFACE_VELOCITY: desc.material.surface_velocity = v; return;
    case PLUMB_FIELD_FILTER:
      desc.filter = {static_cast<std::uint32_t>(row[0]), static_cast<std::uint32_t>(row[1]),
                     static_cast<std::int32_t>(row[2]), 0};
      return;
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::dart6
