// State of bodies, read and written by field.
#include "world.hpp"

namespace plumb::jolt {
namespace {

void put_vector(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

PlumbVec3 velocity_of(const Body& body) {
  return body.is(PLUMB_STATIC) ? PlumbVec3{} : to_plumb(body.jolt->GetLinearVelocity());
}
PlumbVec3 spin_of(const Body& body) {
  return body.is(PLUMB_STATIC) ? PlumbVec3{} : to_plumb(body.jolt->GetAngularVelocity());
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
    case PLUMB_FIELD_VELOCITY: put_vector(velocity_of(body), row); return put_vector(spin_of(body), row + 3);
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
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
  }
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
  const JPH::BodyID id = at.id();
  JPH::BodyInterface& jolt = interface();
  const auto v = [&](std::size_t from = 0) { return vector(row + from, "row"); };
  const auto point = [&] { return position({row[3], row[4], row[5]}, "point"); };
  const auto wake = [&] {
    if (!at.is(PLUMB_STATIC)) jolt.ActivateBody(id);
  };
  PlumbBodyDesc& desc = at.desc;
  switch (field) {
    case PLUMB_FIELD_POSE:
      touch_anew(at);
      jolt.SetPositionAndRotation(id, position({row[0], row[1], row[2]}, "pose"), quaternion(pose_of(row).orientation),
                                  JPH::EActivation::DontActivate);
      at.moving = Body::Moving::as_told;
      return wake();
    case PLUMB_FIELD_VELOCITY:
      at.moving = Body::Moving::as_told;
      if (at.is_pinned()) return;
      wake();
      return jolt.SetLinearAndAngularVelocity(id, v(), v(3));
    case PLUMB_FIELD_FORCE: return jolt.AddForce(id, v());
    case PLUMB_FIELD_TORQUE: return jolt.AddTorque(id, v());
    case PLUMB_FIELD_IMPULSE: return jolt.AddImpulse(id, v());
    case PLUMB_FIELD_ANGULAR_IMPULSE: return jolt.AddAngularImpulse(id, v());
    case PLUMB_FIELD_FORCE_AT_POINT: return jolt.AddForce(id, v(), point());
    case PLUMB_FIELD_IMPULSE_AT_POINT: return jolt.AddImpulse(id, v(), point());
    case PLUMB_FIELD_AWAKE: return row[0] != 0 ? jolt.ActivateBody(id) : jolt.DeactivateBody(id);
    case PLUMB_FIELD_KINEMATIC_TARGET:
      at.target = pose_of(row);
      at.moving = Body::Moving::to_target;
      return;
    case PLUMB_FIELD_MATERIAL:
      desc.material.friction = row[0];
      desc.material.restitution = row[1];
      at.jolt->SetFriction(static_cast<float>(row[0]));
      return at.jolt->SetRestitution(static_cast<float>(row[1]));
    case PLUMB_FIELD_GRAVITY_SCALE:
      desc.gravity_scale = row[0];
      jolt.SetGravityFactor(id, static_cast<float>(row[0]));
      return wake();
    case PLUMB_FIELD_DAMPING:
      desc.linear_damping = row[0];
      desc.angular_damping = row[1];
      if (at.is(PLUMB_STATIC)) return;
      at.jolt->GetMotionProperties()->SetLinearDamping(static_cast<float>(row[0]));
      return at.jolt->GetMotionProperties()->SetAngularDamping(static_cast<float>(row[1]));
    case PLUMB_FIELD_SURFACE_VELOCITY: desc.material.surface_velocity = {row[0], row[1], row[2]}; return wake();
    case PLUMB_FIELD_FILTER:
      desc.filter = {static_cast<std::uint32_t>(row[0]), static_cast<std::uint32_t>(row[1]),
                     static_cast<std::int32_t>(row[2]), 0};
      rules_.set_filter(slot_of(at.handle), desc.filter);
      touch_anew(at);
      return wake();
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::jolt
