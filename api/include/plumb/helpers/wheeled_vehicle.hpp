// A vehicle whose wheels are bodies: chassis - hub on a sprung slider - wheel on a hinge with a motor. A steered hub
// turns about its slider too, driven by a motor.
#pragma once

#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

struct JointWheel {
  PlumbVec3 centre{};    ///< chassis frame, m: of the wheel when the spring is at rest
  double radius = 0.35;  ///< m
  double width = 0.2;    ///< m
  double mass = 20;      ///< kg; the hub weighs half of it
  double frequency = 2;  ///< Hz of the chassis's share on the spring
  double damping_ratio = 0.7;
  double friction = 1;
  bool steered = false;
  bool driven = false;
};

struct WheeledVehicleSettings {
  std::vector<JointWheel> wheels;
  PlumbVec3 up{0, 1, 0};          ///< chassis frame
  PlumbVec3 forward{0, 0, 1};     ///< chassis frame, square to up
  double max_steering = 0.7;      ///< rad
  double steering_gain = 15;      ///< 1/s
  double steering_torque = 2000;  ///< N m
  std::int32_t group = -2;  ///< of the filters of hubs and wheels; give the chassis the same, so that they do not touch
};

class WheeledVehicle {
 public:
  static constexpr PlumbNeeds needs =
      PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS | PLUMB_NEED_FILTERS;

  /// Makes hubs, wheels and joints around a chassis that lives; they are gone with it, and world and chassis outlive
  /// it. Throws Error where the world lacks joints, or a setting is out of range.
  WheeledVehicle(IPhysicsWorld& world, PlumbBody chassis, const WheeledVehicleSettings& settings);
  WheeledVehicle(const WheeledVehicle&) = delete;
  WheeledVehicle& operator=(const WheeledVehicle&) = delete;
  ~WheeledVehicle();

  /// Before a step: driven wheels turn at wheel_speed (rad/s, forward) with at most torque (N m each); the others roll
  /// free. brake (N m, > 0) holds every wheel instead. steering: rad, to the left.
  void drive(double steering, double wheel_speed, double torque, double brake = 0);

  [[nodiscard]] std::span<const PlumbBody> wheels() const { return wheels_; }
  [[nodiscard]] std::span<const PlumbJoint> axles() const { return axles_; }
  /// m/s of the chassis along its forward axis.
  [[nodiscard]] double speed() const;

 private:
  void create();
  void destroy();
  PlumbBody create_part(PlumbShape shape, const PlumbPose& pose, const PlumbVec3& velocity, const JointWheel& wheel,
                        double mass);

  IPhysicsWorld& world_;
  IJoints& extension_;
  PlumbBody chassis_;
  WheeledVehicleSettings settings_;
  std::vector<PlumbShape> shapes_;
  std::vector<PlumbBody> hubs_, wheels_;
  std::vector<PlumbJoint> struts_, axles_;
};

}  // namespace plumb::helpers
