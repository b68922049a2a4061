// Frames and centres of mass, masses, damping, locks and kinematic targets of one body.
#include "bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "plumb/assert.hpp"
namespace plumb::ode {
namespace {

constexpr std::uint32_t linear_locks = PLUMB_LOCK_LINEAR_X | PLUMB_LOCK_LINEAR_Y | PLUMB_LOCK_LINEAR_Z;
constexpr std::uint32_t angular_locks = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y | PLUMB_LOCK_ANGULAR_Z;

/// R m R^T for the rotation of q; an identity leaves the bits alone.
Matrix3 turned(const PlumbQuat& q, const Matrix3& m) {
  if (q.x == 0 && q.y == 0 && q.z == 0) return m;
  const Matrix3 r = backend::rotation_matrix(q);
  return backend::multiply(r, backend::multiply(m, backend::transpose(r)));
}

}  // namespace

PlumbPose Body::frame() const {
  if (body == nullptr) return pose;
  const PlumbQuat q = quat(dBodyGetQuaternion(body));
  const PlumbVec3 at = vec(dBodyGetPosition(body));
  return {is_zero(mass.centre) ? at : sub(at, rotate(q, mass.centre)), q};
}

void Body::wake() {
  if (!dynamic()) return;
  dBodyEnable(body);
  sleep.idle = {dBodyGetAutoDisableSteps(body), dBodyGetAutoDisableTime(body)};
}

void Body::count_idling(double h) {
  if (asleep() || dBodyGetAutoDisableFlag(body) == 0 || dBodyGetNumJoints(body) == 0) return;
  const PlumbVec3 v = linear_velocity(), w = vec(dBodyGetAngularVel(body));
  const double slow = dBodyGetAutoDisableLinearThreshold(body), slow_turn = dBodyGetAutoDisableAngularThreshold(body);
  if (dot(v, v) > slow * slow || dot(w, w) > slow_turn * slow_turn) {
    sleep.idle = {dBodyGetAutoDisableSteps(body), dBodyGetAutoDisableTime(body)};
  } else {
    --sleep.idle.steps;
    sleep.idle.time -= h;
  }
}

void Body::resume_idling(const Idle& countdown) {
  // Waking starts ODE's countdowns at their settings, and there is no other way to them.
  const int steps = dBodyGetAutoDisableSteps(body);
  const double time = dBodyGetAutoDisableTime(body);
  dBodySetAutoDisableSteps(body, countdown.steps);
  dBodySetAutoDisableTime(body, countdown.time);
  dBodyEnable(body);
  dBodySetAutoDisableSteps(body, steps);
  dBodySetAutoDisableTime(body, time);
  sleep.idle = countdown;
}

void Body::set_frame(const PlumbPose& frame) {
  if (body == nullptr) {
    pose = frame;
    for (const auto& geom : geoms) place_geom(geom->placed, frame);
    return;
  }
  const PlumbVec3 at = add(frame.position, rotate(frame.orientation, mass.centre));
  dBodySetPosition(body, at.x, at.y, at.z);
  dBodySetQuaternion(body, OdeQuaternion(frame.orientation).wxyz);
  locks.position = at;
}

void Body::set_velocity(const PlumbVec3& linear, const PlumbVec3& angular) {
  if (body == nullptr) return;
  dBodySetLinearVel(body, linear.x, linear.y, linear.z);
  if (dynamic() && !turns) {
    idle_spin = angular;
  } else {
    dBodySetAngularVel(body, angular.x, angular.y, angular.z);
  }
}

void Body::add_impulse(const PlumbVec3& impulse, const PlumbVec3& angular) {
  set_velocity(add(linear_velocity(), scale(mass.inverse, impulse)),
               add(angular_velocity(), inverse_inertia_times(angular)));
}

PlumbVec3 Body::inverse_inertia_times(const PlumbVec3& v) const {
  if (!turns) return {};
  const PlumbQuat q = orientation();
  return rotate(q, backend::multiply(mass.inverse_inertia, unrotate(q, v)));
}

const GeomTag& tag_of(dGeomID geom) {
  const auto* tag = static_cast<const GeomTag*>(dGeomGetData(geom));
  PLUMB_ASSERT(tag != nullptr && tag->body != nullptr && tag->placed.geom == geom);
  // What was copied from the body is as it is there.
  PLUMB_ASSERT(tag->id == tag->body->body && tag->dynamic == tag->body->dynamic() && tag->sensor == tag->body->sensor);
  PLUMB_ASSERT(tag->choosy == !tag->body->untouchable.empty());
  return *tag;
}

void refresh_tags(Body& body) {
  for (const auto& tag : body.geoms) {
    const PlumbMaterial& material = tag->placed.material == nullptr ? body.surface.material : tag->own_material;
    tag->body = &body;
    tag->id = body.body;
    tag->dynamic = body.dynamic();
    tag->sensor = body.sensor;
    tag->choosy = !body.untouchable.empty();
    tag->friction = material.friction;
    tag->restitution = material.restitution;
    tag->surface_velocity = material.surface_velocity;
    tag->rolling = body.surface.rolling_friction;
    tag->spinning = body.surface.spinning_friction;
  }
}

void keep_apart(Body& a, Body& b) {
  a.untouchable.push_back(&b);
  b.untouchable.push_back(&a);
  refresh_tags(a);
  refresh_tags(b);
}

void let_touch(Body& a, Body& b) {
  const auto forget_one = [](std::vector<const Body*>& list, const Body* other) {
    const auto at = std::find(list.begin(), list.end(), other);
    PLUMB_ASSERT(at != list.end());  // what had kept them apart
    if (at != list.end()) list.erase(at);
  };
  forget_one(a.untouchable, &b);
  forget_one(b.untouchable, &a);
  refresh_tags(a);
  refresh_tags(b);
}

void set_mass(Body& body, const PlumbBodyDesc& desc) {
  PLUMB_ASSERT(body.dynamic() && desc.mass > 0);
  const PlumbVec3& i = desc.inertia;
  body.turns = (desc.flags & PLUMB_BODY_NO_ROTATION) == 0 && !is_zero(i);
  body.mass.centre = desc.centre_of_mass;
  body.mass.inverse = 1 / desc.mass;
  Matrix3 inertia = Matrix3::diagonal(1, 1, 1);
  if (body.turns) {
    inertia = turned(desc.inertia_orientation, Matrix3::diagonal(i.x, i.y, i.z));
    body.mass.inverse_inertia = turned(desc.inertia_orientation, Matrix3::diagonal(1 / i.x, 1 / i.y, 1 / i.z));
  } else {
    // ODE inverts the tensor itself: one this large takes all turning away but for rounding, and no spin is let stand.
    constexpr double immovable = 1e30;
    inertia = Matrix3::diagonal(immovable, immovable, immovable);
    dBodySetMaxAngularSpeed(body.body, 0);
    dBodySetGyroscopicMode(body.body, 0);
  }
  dMass mass;
  dMassSetZero(&mass);
  mass.mass = desc.mass;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      mass.I[row * 4 + column] = inertia[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  dBodySetMass(body.body, &mass);
}

void set_damping(const Body& body, double h) {
  if (body.damping.none()) {
    dBodySetDamping(body.body, 0, 0);
    return;
  }
  PLUMB_ASSERT(h > 0);
  dBodySetLinearDampingThreshold(body.body, 0);
  dBodySetAngularDampingThreshold(body.body, 0);
  dBodySetDamping(body.body, -std::expm1(-body.damping.linear * h), -std::expm1(-body.damping.angular * h));
}

void make_locks(Body& body, dWorldID world) {
  PLUMB_ASSERT(body.dynamic() && body.locks.linear == nullptr && body.locks.angular == nullptr);
  const auto lock = [&](dJointID joint, std::uint32_t bits, void (*set_count)(dJointID, int),
                        void (*set_axis)(dJointID, int, int, dReal, dReal, dReal), void (*set)(dJointID, int, dReal)) {
    dJointAttach(joint, body.body, nullptr);
    int count = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) count += static_cast<int>(bits >> axis & 1u);
    set_count(joint, count);
    int at = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if ((bits >> axis & 1u) == 0) continue;
      set_axis(joint, at, 0, axis == 0, axis == 1, axis == 2);
      set(joint, dParamVel + at * dParamGroup, 0);
      set(joint, dParamFMax + at * dParamGroup, dInfinity);
      ++at;
    }
    return joint;
  };
  if ((body.locks.axes & linear_locks) != 0)
    body.locks.linear = lock(dJointCreateLMotor(world, nullptr), body.locks.axes & linear_locks, dJointSetLMotorNumAxes,
                             dJointSetLMotorAxis, dJointSetLMotorParam);
  if ((body.locks.axes & angular_locks) != 0 && body.turns)
    body.locks.angular = lock(dJointCreateAMotor(world, nullptr), body.locks.axes >> 3, dJointSetAMotorNumAxes,
                              dJointSetAMotorAxis, dJointSetAMotorParam);
  body.locks.position = body.centre();
  project_locks(body);
}

void project_locks(const Body& body) {
  const auto locked = [&](std::uint32_t bit) { return (body.locks.axes & bit) != 0; };
  PlumbVec3 v = body.linear_velocity(), w = vec(dBodyGetAngularVel(body.body)), at = body.centre();
  if (locked(PLUMB_LOCK_LINEAR_X)) v.x = 0, at.x = body.locks.position.x;
  if (locked(PLUMB_LOCK_LINEAR_Y)) v.y = 0, at.y = body.locks.position.y;
  if (locked(PLUMB_LOCK_LINEAR_Z)) v.z = 0, at.z = body.locks.position.z;
  if (locked(PLUMB_LOCK_ANGULAR_X)) w.x = 0;
  if (locked(PLUMB_LOCK_ANGULAR_Y)) w.y = 0;
  if (locked(PLUMB_LOCK_ANGULAR_Z)) w.z = 0;
  dBodySetLinearVel(body.body, v.x, v.y, v.z);
  dBodySetAngularVel(body.body, w.x, w.y, w.z);
  if ((body.locks.axes & linear_locks) != 0) dBodySetPosition(body.body, at.x, at.y, at.z);
}

void head_for_target(Body& body, double dt) {
  PLUMB_ASSERT(body.motion == PLUMB_KINEMATIC && dt > 0);
  const PlumbVec3 way = sub(body.target.pose.position, body.centre());
  const PlumbVec3 turn = rotation_vector(multiply(body.target.pose.orientation, conjugate(body.orientation())));
  body.set_velocity(scale(1 / dt, way), scale(1 / dt, turn));
}

}  // namespace plumb::ode
