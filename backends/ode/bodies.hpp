// Bodies: what ODE does not keep about them, and reading and writing their rows.
//
// An ODE body's origin is its centre of mass; ours is the shape's frame. A static body is geoms without a body.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "shapes.hpp"

namespace plumb::ode {

struct Body;

/// What a geom's data points to. The near callback reads one for each geom of each pair: what it always needs lies
/// together, and is copied from the body whenever that changes (refresh_tags).
struct GeomTag {
  Body* body = nullptr;
  dBodyID id = nullptr;  ///< null: static
  bool dynamic = false, sensor = false;
  bool choosy = false;  ///< the body has untouchables
  double friction = 0, restitution = 0;
  double rolling = 0, spinning = 0;  ///< friction, m
  PlumbVec3 surface_velocity{};      ///< body frame
  PlacedGeom placed{};
  PlumbMaterial own_material{};  ///< a child's; read when placed.material is not null
  struct {
    std::uint32_t body, geom;
  } name{};  ///< by which a snapshot knows it
};

struct Body {
  // Read for every row of a bulk read: kept together.
  dBodyID body = nullptr;  ///< null: static
  PlumbMotion motion = PLUMB_STATIC;
  bool turns = false;  ///< dynamic and not a particle
  bool sensor = false;
  bool shows_contacts = false;  ///< to the host, before they are solved
  PlumbBody handle = 0;
  struct MassProperties {
    PlumbVec3 centre{};  ///< body frame
    double inverse = 0;
    Matrix3 inverse_inertia{};  ///< body frame
  } mass;
  PlumbFilter filter{};

  const Shape* shape = nullptr;
  std::vector<std::unique_ptr<GeomTag>> geoms;
  /// Joined by joints without collide_connected, or excepted by the host; as often as there is a reason.
  std::vector<const Body*> untouchable;
  PlumbPose pose{};       ///< of a static body
  PlumbVec3 idle_spin{};  ///< angular velocity of a body that cannot turn: kept and never used
  struct {
    PlumbMaterial material{};
    double rolling_friction = 0, spinning_friction = 0;  ///< m
  } surface;
  double gravity_scale = 1;
  struct Damping {
    double linear = 0, angular = 0;  ///< 1/s
    [[nodiscard]] bool none() const { return linear == 0 && angular == 0; }
  } damping;
  /// From the host, for the next step.
  struct Push {
    bool any = false;
    PlumbVec3 force{}, torque{};
  } push;
  enum class Moving { as_told, to_target, arrived };
  /// Of a kinematic body.
  struct KinematicTarget {
    PlumbPose pose{};
    Moving moving = Moving::as_told;
  } target;
  /// ODE's countdowns to sleep, which it does not tell: kept alongside for snapshots.
  struct Idle {
    int steps;
    double time;
  };
  struct Sleep {
    bool was_awake = true;  ///< after the last step, for events
    Idle idle{};
  } sleep;
  struct Locks {
    std::uint32_t axes = 0;
    PlumbVec3 position{};  ///< of the centre of mass, along locked axes
    dJointID linear = nullptr, angular = nullptr;
  } locks;

  [[nodiscard]] bool dynamic() const { return motion == PLUMB_DYNAMIC; }
  [[nodiscard]] bool asleep() const { return body != nullptr && dBodyIsEnabled(body) == 0; }
  [[nodiscard]] PlumbQuat orientation() const {
    return body == nullptr ? pose.orientation : quat(dBodyGetQuaternion(body));
  }
  /// Of the body's frame.
  [[nodiscard]] PlumbPose frame() const;
  /// Where the centre of mass is.
  [[nodiscard]] PlumbVec3 centre() const { return body == nullptr ? pose.position : vec(dBodyGetPosition(body)); }
  [[nodiscard]] PlumbVec3 linear_velocity() const {
    return body == nullptr ? PlumbVec3{} : vec(dBodyGetLinearVel(body));
  }
  [[nodiscard]] PlumbVec3 angular_velocity() const {
    return body == nullptr || (dynamic() && !turns) ? idle_spin : vec(dBodyGetAngularVel(body));
  }

  /// Of what ODE moves; others have nothing to wake.
  void wake();
  /// Counts as ODE does at the beginning of a step of h seconds.
  void count_idling(double h);
  void resume_idling(const Idle& countdown);
  void set_frame(const PlumbPose& frame);
  void set_velocity(const PlumbVec3& linear, const PlumbVec3& angular);
  /// World axes; at once.
  void add_impulse(const PlumbVec3& impulse, const PlumbVec3& angular);
  /// I^-1 v for a vector in world axes; 0 for what cannot turn.
  [[nodiscard]] PlumbVec3 inverse_inertia_times(const PlumbVec3& v) const;
};

/// Of a geom in a world's space.
[[nodiscard]] const GeomTag& tag_of(dGeomID geom);

/// After a change of the body's material or untouchables.
void refresh_tags(Body& body);

/// One reason more, or one less, for which two bodies do not touch.
void keep_apart(Body& a, Body& b);
void let_touch(Body& a, Body& b);

/// The mass properties of a dynamic body's descriptor, to ODE and to the record.
void set_mass(Body& body, const PlumbBodyDesc& desc);

/// ODE's damping takes the share scale of the velocity after each step; so exp(-c h) = 1 - scale.
void set_damping(const Body& body, double h);

/// Motors at rest against the world along the locked axes.
void make_locks(Body& body, dWorldID world);
/// Takes what the solver left of motion along locked axes.
void project_locks(const Body& body);

/// Sets the velocity with which a kinematic body reaches its target in dt.
void head_for_target(Body& body, double dt);

}  // namespace plumb::ode
