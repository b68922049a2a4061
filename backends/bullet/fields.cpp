// State of bodies, read and written by field.
#include <algorithm>

#include "world.hpp"

namespace plumb::bullet {
namespace {

void read_row(PlumbField field, const Body& body, double* row) {
  switch (field) {
    case PLUMB_FIELD_POSE: return put_pose(body.frame_pose(), row);
    case PLUMB_FIELD_VELOCITY:
      put_vector(body.getLinearVelocity(), row);
      return put_vector(body.getAngularVelocity(), row + 3);
    case PLUMB_FIELD_AWAKE: row[0] = body.is(PLUMB_DYNAMIC) && body.is_asleep() ? 0 : 1; return;
    case PLUMB_FIELD_MATERIAL:
      row[0] = body.getFriction();
      row[1] = body.getRestitution();
      return;
    case PLUMB_FIELD_GRAVITY_SCALE: row[0] = body.gravity_scale; return;
    case PLUMB_FIELD_DAMPING:
      row[0] = body.linear_damping;
      row[1] = body.angular_damping;
      return;
    case PLUMB_FIELD_SURFACE_VELOCITY:
      row[0] = body.surface_velocity.x;
      row[1] = body.surface_velocity.y;
      row[2] = body.surface_velocity.z;
      return;
    case PLUMB_FIELD_FILTER:
      row[0] = body.filter.category;
      row[1] = body.filter.mask;
      row[2] = body.filter.group;
      return;
    case PLUMB_FIELD_ROLLING_FRICTION:
      row[0] = body.getRollingFriction();
      row[1] = body.getSpinningFriction();
      return;
    default: throw Error(PLUMB_E_UNSUPPORTED, "Bullet cannot read field " + std::to_string(field));
  }
}

/// What Bullet must be able to hold, checked for all rows before the first is written.
void check_row(const double* row, std::uint32_t columns) {
  for (std::uint32_t i = 0; i < columns; ++i) (void)scalar(row[i], "a number in the rows");
}

btVector3 arm(const Body& body, const double* point) { return vector(point, "point") - body.getCenterOfMassPosition(); }

bool turns(const Body& body) { return (body.flags & PLUMB_BODY_NO_ROTATION) == 0; }

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

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  const std::uint32_t columns = columns_of(field);
  double row[16];
  if (field != PLUMB_FIELD_FILTER)
    for (std::size_t i = 0; i < ids.size(); ++i) {
      rows.get(i, row, columns);
      check_row(row, columns);
    }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, columns);
    write_row(field, body(ids[i]), row);
  }
  return PLUMB_OK;
}

void World::write_row(PlumbField field, Body& at, const double* row) {
  switch (field) {
    case PLUMB_FIELD_POSE: return write_pose(at, row);
    case PLUMB_FIELD_VELOCITY:
      at.setLinearVelocity(vector(row, "velocity"));
      if (turns(at)) at.setAngularVelocity(vector(row + 3, "velocity"));
      if (at.is(PLUMB_KINEMATIC)) at.coast(at.getLinearVelocity(), at.getAngularVelocity());
      return wake(at);
    case PLUMB_FIELD_FORCE: at.applyCentralForce(vector(row, "force")); return wake(at);
    case PLUMB_FIELD_TORQUE: at.applyTorque(vector(row, "torque")); return wake(at);
    case PLUMB_FIELD_IMPULSE: at.applyCentralImpulse(vector(row, "impulse")); return wake(at);
    case PLUMB_FIELD_ANGULAR_IMPULSE: at.applyTorqueImpulse(vector(row, "impulse")); return wake(at);
    case PLUMB_FIELD_FORCE_AT_POINT: at.applyForce(vector(row, "force"), arm(at, row + 3)); return wake(at);
    case PLUMB_FIELD_IMPULSE_AT_POINT:
      at.applyCentralImpulse(vector(row, "impulse"));
      at.applyTorqueImpulse(arm(at, row + 3).cross(vector(row, "impulse")));
      return wake(at);
    case PLUMB_FIELD_AWAKE: return write_awake(at, row[0] != 0);
    case PLUMB_FIELD_KINEMATIC_TARGET:
      at.target = at.mass_pose(transform(pose_of(row), "target"));
      at.has_target = true;
      return;
    case PLUMB_FIELD_MATERIAL:
      at.setFriction(static_cast<btScalar>(row[0]));
      at.setRestitution(static_cast<btScalar>(row[1]));
      return refresh_materials(parts_.dispatcher, at);
    case PLUMB_FIELD_ROLLING_FRICTION:
      at.setRollingFriction(static_cast<btScalar>(row[0]));
      at.setSpinningFriction(static_cast<btScalar>(row[1]));
      return refresh_materials(parts_.dispatcher, at);
    case PLUMB_FIELD_GRAVITY_SCALE:
      at.gravity_scale = row[0];
      at.setFlags(row[0] == 1 ? at.getFlags() & ~BT_DISABLE_WORLD_GRAVITY : at.getFlags() | BT_DISABLE_WORLD_GRAVITY);
      if (at.is(PLUMB_DYNAMIC)) apply_gravity_scale(at);
      return wake(at);
    case PLUMB_FIELD_DAMPING:
      at.linear_damping = row[0];
      at.angular_damping = row[1];
      std::erase(lists_.damped, &at);
      if (at.is(PLUMB_DYNAMIC) && (row[0] != 0 || row[1] != 0)) lists_.damped.push_back(&at);
      return;
    case PLUMB_FIELD_SURFACE_VELOCITY:
      at.surface_velocity = {row[0], row[1], row[2]};
      at.conveys = true;
      return;
    case PLUMB_FIELD_FILTER:
      at.filter.category = static_cast<std::uint32_t>(row[0]);
      at.filter.mask = static_cast<std::uint32_t>(row[1]);
      at.filter.group = static_cast<std::int32_t>(row[2]);
      wake_neighbours(at);
      return world_.refreshBroadphaseProxy(&at);  // finds its pairs anew
    default: throw Error(PLUMB_E_UNSUPPORTED, "Bullet cannot write field " + std::to_string(field));
  }
}

void World::write_pose(Body& at, const double* row) {
  wake_neighbours(at);
  const btTransform pose = at.mass_pose(transform(pose_of(row), "pose"));
  at.setCenterOfMassTransform(pose);
  at.setInterpolationWorldTransform(pose);
  at.has_target = false;
  world_.updateSingleAabb(&at);
  wake(at);
}

void World::write_awake(Body& at, bool awake) {
  if (awake || !at.is(PLUMB_DYNAMIC)) return wake(at);
  if ((at.flags & PLUMB_BODY_NEVER_SLEEPS) != 0) return;
  at.setLinearVelocity(btVector3(0, 0, 0));
  at.setAngularVelocity(btVector3(0, 0, 0));
  at.forceActivationState(ISLAND_SLEEPING);
}

}  // namespace plumb::bullet
