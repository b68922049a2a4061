// Rows of bodies: read in bulk, written one by one.
#include <string>

#include "slots.hpp"
#include "world.hpp"

namespace plumb::ode {
namespace {

PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

void put_vec(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

void put_pose(const PlumbVec3& position, const PlumbQuat& q, double* row) {
  put_vec(position, row);
  row[3] = q.x;
  row[4] = q.y;
  row[5] = q.z;
  row[6] = q.w;
}

}  // namespace

PlumbResult World::read_poses(std::span<const PlumbBody> ids, const Rows& rows) {
  double row[7];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (const dBodyID plain = slots_.plain[slot_of(ids[i])]; plain != nullptr) {
      put_pose(vec(dBodyGetPosition(plain)), quat(dBodyGetQuaternion(plain)), row);
    } else {
      const PlumbPose pose = body(ids[i]).frame();
      put_pose(pose.position, pose.orientation, row);
    }
    rows.put(i, row, 7);
  }
  return PLUMB_OK;
}

PlumbResult World::read_velocities(std::span<const PlumbBody> ids, const Rows& rows) {
  double row[6];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (const dBodyID plain = slots_.plain[slot_of(ids[i])]; plain != nullptr) {
      put_vec(vec(dBodyGetLinearVel(plain)), row);
      put_vec(vec(dBodyGetAngularVel(plain)), row + 3);
    } else {
      put_vec(body(ids[i]).linear_velocity(), row);
      put_vec(body(ids[i]).angular_velocity(), row + 3);
    }
    rows.put(i, row, 6);
  }
  return PLUMB_OK;
}

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  const auto each = [&]<std::size_t Columns>(void (*read_row)(const Body&, double(&)[Columns])) {
    double row[Columns];
    for (std::size_t i = 0; i < ids.size(); ++i) {
      read_row(body(ids[i]), row);
      rows.put(i, row, Columns);
    }
    return PLUMB_OK;
  };
  switch (field) {
    case PLUMB_FIELD_POSE: return read_poses(ids, rows);
    case PLUMB_FIELD_VELOCITY: return read_velocities(ids, rows);
    case PLUMB_FIELD_AWAKE:
      return each(+[](const Body& body, double(&row)[1]) { row[0] = body.dynamic() && body.asleep() ? 0 : 1; });
    case PLUMB_FIELD_MATERIAL:
      return each(+[](const Body& body, double(&row)[2]) {
        row[0] = body.surface.material.friction;
        row[1] = body.surface.material.restitution;
      });
    case PLUMB_FIELD_GRAVITY_SCALE:
      return each(+[](const Body& body, double(&row)[1]) { row[0] = body.gravity_scale; });
    case PLUMB_FIELD_DAMPING:
      return each(+[](const Body& body, double(&row)[2]) {
        row[0] = body.damping.linear;
        row[1] = body.damping.angular;
      });
    case PLUMB_FIELD_SURFACE_VELOCITY:
      return each(+[](const Body& body, double(&row)[3]) { put_vec(body.surface.material.surface_velocity, row); });
    case PLUMB_FIELD_FILTER:
      return each(+[](const Body& body, double(&row)[3]) {
        row[0] = body.filter.category;
        row[1] = body.filter.mask;
        row[2] = body.filter.group;
      });
    case PLUMB_FIELD_ROLLING_FRICTION:
      return each(+[](const Body& body, double(&row)[2]) {
        row[0] = body.surface.rolling_friction;
        row[1] = body.surface.spinning_friction;
      });
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
  }
}

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  return inside_ode([&] {
    const std::uint32_t columns = columns_of(field);
    double row[16];
    for (std::size_t i = 0; i < ids.size(); ++i) {
      rows.get(i, row, columns);
      write_row(field, body(ids[i]), row);
    }
    return PLUMB_OK;
  });
}

void World::write_row(PlumbField field, Body& body, const double* row) {
  const PlumbVec3 v{row[0], row[1], row[2]};
  const auto wake = [&] { body.wake(); };
  const auto push = [&](const PlumbVec3& force, const PlumbVec3& torque) {
    if (!body.push.any) lists_.pushed.push_back(&body);
    body.push.any = true;
    body.push.force = add(body.push.force, force);
    body.push.torque = add(body.push.torque, torque);
    wake();
  };
  const auto arm = [&] { return sub({row[3], row[4], row[5]}, body.centre()); };
  switch (field) {
    case PLUMB_FIELD_POSE:
      wake_neighbours(body);
      body.set_frame(pose_of(row));
      body.target.moving = Body::Moving::as_told;
      wake_neighbours(body);
      return wake();
    case PLUMB_FIELD_VELOCITY:
      body.set_velocity(v, {row[3], row[4], row[5]});
      body.target.moving = Body::Moving::as_told;
      return wake();
    case PLUMB_FIELD_FORCE: return push(v, {});
    case PLUMB_FIELD_TORQUE: return push({}, v);
    case PLUMB_FIELD_FORCE_AT_POINT: return push(v, cross(arm(), v));
    case PLUMB_FIELD_IMPULSE: body.add_impulse(v, {}); return wake();
    case PLUMB_FIELD_ANGULAR_IMPULSE: body.add_impulse({}, v); return wake();
    case PLUMB_FIELD_IMPULSE_AT_POINT: body.add_impulse(v, cross(arm(), v)); return wake();
    case PLUMB_FIELD_AWAKE:
      if (row[0] != 0) return wake();
      body.set_velocity({}, {});
      return dBodyDisable(body.body);
    case PLUMB_FIELD_KINEMATIC_TARGET:
      body.target.pose = pose_of(row);
      body.target.moving = Body::Moving::to_target;
      return;
    case PLUMB_FIELD_MATERIAL:
      body.surface.material.friction = row[0];
      body.surface.material.restitution = row[1];
      return refresh_tags(body);
    case PLUMB_FIELD_ROLLING_FRICTION:
      body.surface.rolling_friction = row[0];
      body.surface.spinning_friction = row[1];
      return refresh_tags(body);
    case PLUMB_FIELD_GRAVITY_SCALE: set_gravity_scale(body, row[0]); return wake();
    case PLUMB_FIELD_DAMPING:
      body.damping.linear = row[0];
      body.damping.angular = row[1];
      std::erase(lists_.damped, &body);
      lists_.damped.push_back(&body);
      return set_damping(body, substep_.h);
    case PLUMB_FIELD_SURFACE_VELOCITY: body.surface.material.surface_velocity = v; return refresh_tags(body);
    case PLUMB_FIELD_FILTER:
      body.filter.category = static_cast<std::uint32_t>(row[0]);
      body.filter.mask = static_cast<std::uint32_t>(row[1]);
      body.filter.group = static_cast<std::int32_t>(row[2]);
      return;
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::ode
