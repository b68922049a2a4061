// A body: Bullet's rigid body, and beside it what the interface knows and Bullet does not.
#pragma once

#include <memory>

#include "shapes.hpp"

namespace plumb::bullet {

/// Marks our bodies among all that live in the process: the callbacks of materials.hpp are Bullet's globals.
inline constexpr int kOurMark = 0x506c6d62;

/// What a body weighs and where it is hit: what of its descriptor is worked out before there is a body.
struct MadeOf {
  std::shared_ptr<const Shape> shape;           ///< null: none
  std::unique_ptr<btCollisionShape> own_shape;  ///< of this body alone; null where the shared one will do
  btScalar mass = 0;
  btVector3 inertia = btVector3(0, 0, 0);
  btTransform body_to_mass = btTransform::getIdentity();
  bool offset_frame = false;
};

class Body final : public btRigidBody {
 public:
  Body(const btRigidBodyConstructionInfo& info, PlumbBody id, const PlumbBodyDesc& desc)
      : btRigidBody(info),
        handle(id),
        motion(desc.motion),
        flags(desc.flags),
        locks(desc.locks),
        surface_velocity(desc.material.surface_velocity),
        gravity_scale(desc.gravity_scale),
        linear_damping(desc.linear_damping),
        angular_damping(desc.angular_damping),
        filter(desc.filter) {
    setUserIndex3(kOurMark);
  }

  void take(MadeOf made);

  /// As if it were made of that: at rest, awake, out of Bullet's world. Whoever points to it need not notice.
  void remake(const btRigidBodyConstructionInfo& info) {
    setCollisionFlags(0);
    setCcdMotionThreshold(0);
    setupRigidBody(info);
    forceActivationState(ACTIVE_TAG);
    setDeactivationTime(0);
  }

  [[nodiscard]] bool is(PlumbMotion which) const { return motion == which; }
  [[nodiscard]] bool is_sensor() const { return (flags & PLUMB_BODY_SENSOR) != 0; }
  [[nodiscard]] bool is_asleep() const { return getActivationState() == ISLAND_SLEEPING; }

  /// Pose of the body's frame; Bullet's transform is that of the centre of mass and the principal axes.
  [[nodiscard]] btTransform frame_pose() const {
    return offset_frame ? getWorldTransform() * mass_to_body : getWorldTransform();
  }
  /// From a pose of the body's frame to Bullet's transform.
  [[nodiscard]] btTransform mass_pose(const btTransform& pose) const {
    return offset_frame ? pose * body_to_mass : pose;
  }

  void coast(const btVector3& linear, const btVector3& angular) {
    coasting = {linear, angular, !linear.isZero() || !angular.isZero()};
  }

  bool offset_frame = false;  ///< whether body_to_mass differs from identity; first, because every read asks it
  PlumbBody handle;
  PlumbMotion motion;
  std::uint32_t flags;
  std::uint32_t locks;
  PlumbVec3 surface_velocity;  ///< m/s, body frame
  double gravity_scale;
  double linear_damping, angular_damping;  ///< 1/s
  PlumbFilter filter;
  std::shared_ptr<const Shape> shape;                     ///< null: none
  std::unique_ptr<btCollisionShape> own_shape;            ///< of this body alone; null where the shared one will do
  btTransform body_to_mass = btTransform::getIdentity();  ///< mass frame seen from the body's frame
  btTransform mass_to_body = btTransform::getIdentity();
  bool was_asleep = false;  ///< after the step before
  bool conveys = false;     ///< has ever had a surface velocity
  /// Kinematic: moves with these velocities until told otherwise.
  struct Coasting {
    btVector3 linear = btVector3(0, 0, 0), angular = btVector3(0, 0, 0);
    bool on = false;
  } coasting;
  bool has_target = false;  ///< kinematic: must be at `target` after the next step
  btTransform target = btTransform::getIdentity();
};

inline Body* our_body(const btCollisionObject* object) {
  return static_cast<Body*>(const_cast<btRigidBody*>(static_cast<const btRigidBody*>(object)));
}

}  // namespace plumb::bullet
