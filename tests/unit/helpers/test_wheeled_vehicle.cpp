#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/helpers/wheeled_vehicle.hpp"

namespace plumb::helpers::test {
namespace {

constexpr double dt = 1.0 / 120;

struct Cart {
  explicit Cart(PlumbVec3 gravity = {0, -9.81, 0}) : t(gravity) {
    t.box(PLUMB_STATIC, {100, 1, 100}, {0, -1, 0});
    PlumbShapeDesc shape = shape_desc(PLUMB_BOX);
    shape.half_extents = {0.6, 0.2, 1.5};
    PlumbBodyDesc desc = body_desc();
    desc.shape = t.shape(shape);
    desc.pose.position = {0, 0.7, 0};
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = 200;
    desc.flags = PLUMB_BODY_NEVER_SLEEPS;
    desc.filter.group = -2;
    chassis = t.add(desc);
    WheeledVehicleSettings settings;
    for (const double z : {1.1, -1.1})
      for (const double x : {0.7, -0.7}) {
        JointWheel wheel;
        wheel.centre = {x, -0.3, z};
        wheel.steered = z > 0;
        wheel.driven = true;
        wheel.frequency = 4;
        settings.wheels.push_back(wheel);
      }
    vehicle = std::make_unique<WheeledVehicle>(*t.world, chassis, settings);
  }
  void run(double seconds, double steering, double speed, double torque, double brake = 0) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) {
      vehicle->drive(steering, speed, torque, brake);
      t.step(dt);
    }
  }
  TestWorld t;
  PlumbBody chassis = 0;
  std::unique_ptr<WheeledVehicle> vehicle;
};

TEST(WheeledVehicle, StandsUpright) {
  Cart cart;
  cart.run(3, 0, 0, 0, 200);
  const PlumbPose pose = cart.t.pose(cart.chassis);
  EXPECT_GT(1 - 2 * (pose.orientation.x * pose.orientation.x + pose.orientation.z * pose.orientation.z), 0.999);
  EXPECT_GT(pose.position.y, 0.4);
  EXPECT_LT(std::abs(cart.vehicle->speed()), 0.05);
}

TEST(WheeledVehicle, GoesAsFastAsItsMotorsTurn) {
  Cart cart;
  cart.run(1, 0, 0, 0, 200);
  cart.run(4, 0, 10, 100);
  EXPECT_NEAR(cart.vehicle->speed(), 3.5, 0.15);
  EXPECT_LT(std::abs(cart.t.pose(cart.chassis).position.x), 0.3);
  cart.run(2, 0, 0, 0, 300);
  EXPECT_NEAR(cart.vehicle->speed(), 0, 0.1);
}

TEST(WheeledVehicle, TurnsToTheSideThatItSteersTo) {
  Cart cart;
  cart.run(1, 0, 0, 0, 200);
  cart.run(2, 0.3, 6, 100);
  const double bicycle = cart.vehicle->speed() * std::tan(0.3) / 2.2;
  // Four wheels driven at one speed and two steered by one angle drag each other, so that it turns wider.
  EXPECT_NEAR(cart.t.velocity(cart.chassis).angular.y, bicycle, 0.3 * bicycle);
}

TEST(WheeledVehicle, ClimbsASlope) {
  const double angle = 0.25;
  Cart cart({0, -9.81 * std::cos(angle), -9.81 * std::sin(angle)});
  cart.run(1, 0, 0, 0, 300);
  cart.run(3, 0, 8, 150);
  EXPECT_NEAR(cart.vehicle->speed(), 2.8, 0.4);
}

}  // namespace
}  // namespace plumb::helpers::test
