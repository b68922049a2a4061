// A chassis on wheels that are rays: springs along them, and tyres that hold within a friction ellipse.
//
// Springs are implicit (force at the step's end), so that they are stable at any stiffness and dt and at rest hold
// exactly m g. Tyres are Coulomb: an ellipse of the most along and across the wheel, times the load. Within it a wheel
// rolls without slip sideways; what that takes of all wheels together is found by projected Gauss-Seidel on the
// chassis's own velocity. So turns are those of the bicycle model until a tyre slides.
#pragma once

#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

struct RigidMotion;

struct RayWheel {
  PlumbVec3 mount{};         ///< chassis frame, m: where the spring is fixed
  double radius = 0.35;      ///< m
  double rest_length = 0.3;  ///< m, of the unloaded spring, from the mount to the axle
  double stiffness = 40000;  ///< N/m
  double damping = 4000;     ///< N s/m
  double grip_along = 1;     ///< friction coefficient along the wheel, >= 0
  double grip_across = 1;    ///< across
  bool steered = false;
  bool driven = false;
};

struct RayAxle {
  std::size_t left, right;  ///< wheels
  double anti_roll = 0;     ///< N/m of the difference of their springs
};

struct RayVehicleSettings {
  std::vector<RayWheel> wheels;
  std::vector<RayAxle> axles;                ///< those with an anti-roll bar
  PlumbVec3 up{0, 1, 0};                     ///< chassis frame; wheels hang against it
  PlumbVec3 forward{0, 0, 1};                ///< chassis frame, square to up
  PlumbVec3 gravity{0, -9.81, 0};            ///< m/s2, as the world has it
  PlumbFilter filter{1, 0xffffffffu, 0, 0};  ///< of the rays: must not see the chassis
};

struct DriverInput {
  double steering = 0;  ///< rad, to the left, of a wheel in the middle; left and right differ as Ackermann's
  double drive = 0;     ///< N m, shared by the driven wheels
  double brake = 0;     ///< N m on each wheel, >= 0
};

struct RayWheelState {
  bool on_ground = false;
  bool slides = false;
  double compression = 0;  ///< m
  double load = 0;         ///< N
  double rotation = 0;     ///< rad, rolled
  PlumbBody ground = 0;
  PlumbVec3 contact{}, normal{};
  PlumbVec3 axle{};  ///< world, m
};

class RaycastVehicle {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_FORCES | PLUMB_NEED_QUERIES | PLUMB_NEED_ROTATION;

  /// world outlives this. Throws Error when the world lacks rays or forces, or a setting is out of range.
  RaycastVehicle(IPhysicsWorld& world, PlumbBody chassis, const RayVehicleSettings& settings);

  /// Before each step of the world of the same dt. One batch of rays, one of forces. Dynamic ground feels the opposite.
  void drive(const DriverInput& input, double dt);

  [[nodiscard]] std::span<const RayWheelState> wheels() const { return states_; }
  /// m/s along forward, at the last drive().
  [[nodiscard]] double speed() const { return speed_; }

 private:
  void cast(const RigidMotion& chassis);
  void suspend(RigidMotion& chassis, double dt);
  void roll(RigidMotion& chassis, const DriverInput& input, double dt);
  void push(double dt);

  IPhysicsWorld& world_;
  PlumbBody chassis_;
  RayVehicleSettings settings_;
  std::vector<RayWheelState> states_;
  std::vector<PlumbVec3> impulses_;  // of each wheel on the chassis, N s
  std::vector<PlumbRay> rays_;
  std::vector<PlumbBody> pushed_;
  double speed_ = 0;
};

}  // namespace plumb::helpers
