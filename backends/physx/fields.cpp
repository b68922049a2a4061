// State of bodies, read and written by field.
#include "world.hpp"

namespace plumb::px {
namespace {

void put_vector(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

/// PhysX tells none of kinematic bodies that the descriptor does not say.
Velocity velocity_of(const Body& body) {
  if (body.is(PLUMB_STATIC)) return {};
  if (body.is(PLUMB_KINEMATIC)) return {body.desc.linear_velocity, body.desc.angular_velocity};
  return {to_plumb(body.dynamic().getLinearVelocity()), to_plumb(body.dynamic().getAngularVelocity())};
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
    case PLUMB_FIELD_VELOCITY: {
      const Velocity velocity = velocity_of(body);
      put_vector(velocity.linear, row);
      return put_vector(velocity.angular, row + 3);
    }
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

/// PhysX keeps impulses for its next step; ours change the velocity at once.
void push(const Body& body, const PlumbVec3& impulse, const PlumbVec3& moment) {
  const PxRigidDynamic& actor = body.dynamic();
  const PlumbQuat turn = to_plumb(actor.getGlobalPose() * actor.getCMassLocalPose()).orientation;
  const PlumbVec3 inverse = to_plumb(actor.getMassSpaceInvInertiaTensor());
  const PlumbVec3 within = backend::unrotate(turn, moment);
  const PlumbVec3 spin = backend::rotate(turn, {inverse.x * within.x, inverse.y * within.y, inverse.z * within.z});
  const Velocity now = velocity_of(body);
  put_velocity(
      body, {backend::add(now.linear, backend::scale(1 / body.desc.mass, impulse)), backend::add(now.angular, spin)});
}

PlumbVec3 arm_to(const Body& body, const PlumbVec3& point) {
  const PxRigidDynamic& actor = body.dynamic();
  return backend::sub(point, to_plumb(actor.getGlobalPose() * actor.getCMassLocalPose()).position);
}

void add_force(const Body& body, const PlumbVec3& force, const PlumbVec3& torque) {
  if (backend::length(force) > 0) body.dynamic().addForce(vector(force, "force"));
  if (backend::length(torque) > 0) body.dynamic().addTorque(vector(torque, "torque"));
}

PlumbVec3 at(const double* row, std::size_t from = 0) { return {row[from], row[from + 1], row[from + 2]}; }

/// Forces and impulses act on dynamic bodies; the guard lets no others through.
void act(PlumbField field, const Body& body, const double* row) {
  const PlumbVec3 push_of = at(row);
  switch (field) {
    case PLUMB_FIELD_FORCE: return add_force(body, push_of, {});
    case PLUMB_FIELD_TORQUE: return add_force(body, {}, push_of);
    case PLUMB_FIELD_IMPULSE: return push(body, push_of, {});
    case PLUMB_FIELD_ANGULAR_IMPULSE: return push(body, {}, push_of);
    case PLUMB_FIELD_FORCE_AT_POINT: return add_force(body, push_of, backend::cross(arm_to(body, at(row, 3)), push_of));
    default: return push(body, push_of, backend::cross(arm_to(body, at(row, 3)), push_of));
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

void World::write_row(PlumbField field, Body& body, const double* row) {
  const bool dynamic = body.is(PLUMB_DYNAMIC);
  const auto wake = [&] {
    if (dynamic) body.dynamic().wakeUp();
  };
  PlumbBodyDesc& desc = body.desc;
  switch (field) {
    case PLUMB_FIELD_POSE:
      wake_around(body);
      body.actor->setGlobalPose(transform(pose_of(row), "pose"));
      wake_around(body);
      body.moving = Body::Moving::as_told;
      return wake();
    case PLUMB_FIELD_VELOCITY:
      body.moving = Body::Moving::as_told;
      if (dynamic) {
        wake();
        put_velocity(body, {at(row), at(row, 3)});
      }
      desc.linear_velocity = at(row);
      desc.angular_velocity = at(row, 3);
      return;
    case PLUMB_FIELD_FORCE:
    case PLUMB_FIELD_TORQUE:
    case PLUMB_FIELD_IMPULSE:
    case PLUMB_FIELD_ANGULAR_IMPULSE:
    case PLUMB_FIELD_FORCE_AT_POINT:
    case PLUMB_FIELD_IMPULSE_AT_POINT:
      if (dynamic) act(field, body, row);
      return;
    case PLUMB_FIELD_AWAKE:
      if (dynamic) row[0] != 0 ? body.dynamic().wakeUp() : body.dynamic().putToSleep();
      return;
    case PLUMB_FIELD_KINEMATIC_TARGET:
      body.target = pose_of(row);
      body.moving = Body::Moving::to_target;
      return;
    case PLUMB_FIELD_MATERIAL:
      desc.material.friction = row[0];
      desc.material.restitution = row[1];
      return put_material(body, common_);
    case PLUMB_FIELD_GRAVITY_SCALE:
      desc.gravity_scale = row[0];
      put_gravity(body);
      sort_scaled(body);
      return wake();
    case PLUMB_FIELD_DAMPING:
      desc.linear_damping = row[0];
      desc.angular_damping = row[1];
      if (dynamic) put_damping(body);
      return;
    case PLUMB_FIELD_SURFACE_VELOCITY:
      desc.material.surface_velocity = at(row);
      wake_around(body);
      return wake();
    case PLUMB_FIELD_FILTER:
      desc.filter = {static_cast<std::uint32_t>(row[0]), static_cast<std::uint32_t>(row[1]),
                     static_cast<std::int32_t>(row[2]), 0};
      rules_.set_filter(slot_of(body.handle), desc.filter);
      scene_->resetFiltering(*body.actor);
      wake_around(body);
      return wake();
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

}  // namespace plumb::px
