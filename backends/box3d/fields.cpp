// State of bodies, read and written by field.
#include "world.hpp"

namespace plumb::box3d {
namespace {

void put_vector(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

void read_row(PlumbField field, const Body& body, double* row) {
  const PlumbBodyDesc& desc = body.desc;
  switch (field) {
    case PLUMB_FIELD_POSE: {
      const PlumbPose pose = body.pose();
      put_vector(pose.position, row);
      put_vector({pose.orientation.x, pose.orientation.y, pose.orientation.z}, row + 3);
      row[6] = pose.orientation.w;
      return;
    }
    case PLUMB_FIELD_VELOCITY:
      put_vector(to_plumb(b3Body_GetLinearVelocity(body.id)), row);
      return put_vector(to_plumb(b3Body_GetAngularVelocity(body.id)), row + 3);
    case PLUMB_FIELD_AWAKE: row[0] = body.asleep() ? 0 : 1; return;
    case PLUMB_FIELD_MATERIAL:
      row[0] = desc.material.friction;
      row[1] = desc.material.restitution;
      return;
    case PLUMB_FIELD_GRAVITY_SCALE: row[0] = desc.gravity_scale; return;
    case PLUMB_FIELD_DAMPING:
      row[0] = desc.linear_damping;
      row[1] = desc.angular_damping;
      return;
    case PLUMB_FIELD_SURFACE_VELOCITY: return put_vector(desc.material.surface_velocity, row);
    case PLUMB_FIELD_FILTER:
      return put_vector({double(desc.filter.category), double(desc.filter.mask), double(desc.filter.group)}, row);
    case PLUMB_FIELD_ROLLING_FRICTION:
      row[0] = desc.rolling_friction;
      row[1] = desc.spinning_friction;
      return;
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
  }
}

void wake(const Body& body) {
  if (!body.is(PLUMB_STATIC)) b3Body_SetAwake(body.id, true);
}

}  // namespace

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  const std::uint32_t columns = columns_of(field);
  double row[16];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    read_row(field, body(ids[i]), row);
    rows.put(i, row, columns);
  }
  return PLUMB_OK;
}

/// What float cannot hold is refused before the first row is written.
PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  const std::uint32_t columns = columns_of(field);
  double row[16];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, columns);
    for (std::uint32_t k = 0; k < columns; ++k) (void)scalar(row[k], "a number in the rows");
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, columns);
    write_row(field, body(ids[i]), row);
  }
  return PLUMB_OK;
}

void World::write_row(PlumbField field, Body& at, const double* row) {
  const b3Vec3 v = field == PLUMB_FIELD_FILTER ? b3Vec3_zero : vector(row, "row");
  const auto point = [&] { return position({row[3], row[4], row[5]}, "point"); };
  PlumbBodyDesc& desc = at.desc;
  switch (field) {
    case PLUMB_FIELD_POSE:
      b3Body_SetTransform(at.id, position({row[0], row[1], row[2]}, "pose"), quaternion(pose_of(row).orientation));
      at.moving = Body::Moving::as_told;
      return wake(at);
    case PLUMB_FIELD_VELOCITY:
      wake(at);
      b3Body_SetLinearVelocity(at.id, v);
      b3Body_SetAngularVelocity(at.id, vector(row + 3, "row"));
      at.moving = Body::Moving::as_told;
      return;
    case PLUMB_FIELD_FORCE: return b3Body_ApplyForceToCenter(at.id, v, true);
    case PLUMB_FIELD_TORQUE: return b3Body_ApplyTorque(at.id, v, true);
    case PLUMB_FIELD_IMPULSE: return b3Body_ApplyLinearImpulseToCenter(at.id, v, true);
    case PLUMB_FIELD_ANGULAR_IMPULSE: return b3Body_ApplyAngularImpulse(at.id, v, true);
    case PLUMB_FIELD_FORCE_AT_POINT: return b3Body_ApplyForce(at.id, v, point(), true);
    case PLUMB_FIELD_IMPULSE_AT_POINT: return b3Body_ApplyLinearImpulse(at.id, v, point(), true);
    case PLUMB_FIELD_AWAKE: return b3Body_SetAwake(at.id, row[0] != 0);
    case PLUMB_FIELD_KINEMATIC_TARGET:
      at.target = pose_of(row);
      at.moving = Body::Moving::to_target;
      return;
    case PLUMB_FIELD_MATERIAL:
      desc.material.friction = row[0];
      desc.material.restitution = row[1];
      return apply_material(at);
    case PLUMB_FIELD_ROLLING_FRICTION:
      desc.rolling_friction = row[0];
      desc.spinning_friction = row[1];
      return apply_material(at);
    case PLUMB_FIELD_GRAVITY_SCALE:
      desc.gravity_scale = row[0];
      b3Body_SetGravityScale(at.id, v.x);
      return wake(at);
    case PLUMB_FIELD_DAMPING:
      desc.linear_damping = row[0];
      desc.angular_damping = row[1];
      b3Body_SetLinearDamping(at.id, v.x);
      return b3Body_SetAngularDamping(at.id, v.y);
    case PLUMB_FIELD_SURFACE_VELOCITY:
      desc.material.surface_velocity = {row[0], row[1], row[2]};
      return apply_material(at);
    case PLUMB_FIELD_FILTER:
      desc.filter = {static_cast<std::uint32_t>(row[0]), static_cast<std::uint32_t>(row[1]),
                     static_cast<std::int32_t>(row[2]), 0};
      apply_filter(at);
      return wake(at);
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::box3d
