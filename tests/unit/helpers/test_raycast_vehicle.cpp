#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/helpers/raycast_vehicle.hpp"

namespace plumb::helpers::test {
namespace {

constexpr double dt = 1.0 / 60;
constexpr double mass = 1200;

struct Car {
  explicit Car(PlumbVec3 gravity = {0, -9.81, 0}) : t(gravity) {
    settings.gravity = gravity;
    t.box(PLUMB_STATIC, {200, 1, 200}, {0, -1, 0});
    PlumbShapeDesc shape = shape_desc(PLUMB_BOX);
    shape.half_extents = {0.9, 0.3, 2};
    PlumbBodyDesc desc = body_desc();
    desc.shape = t.shape(shape);
    desc.pose.position = {0, 0.85, 0};
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = mass;
    desc.flags = PLUMB_BODY_NEVER_SLEEPS;
    desc.filter = {2, 0xffffffffu, 0, 0};
    chassis = t.add(desc);
    for (const double z : {1.4, -1.4})
      for (const double x : {0.8, -0.8}) {
        RayWheel wheel;
        wheel.mount = {x, -0.1, z};
        wheel.steered = z > 0;
        wheel.driven = z < 0;
        settings.wheels.push_back(wheel);
      }
    settings.axles = {{0, 1, 5000}, {2, 3, 5000}};
    settings.filter = {1, 1, 0, 0};  // sees the ground and not the car
    vehicle = std::make_unique<RaycastVehicle>(*t.world, chassis, settings);
  }
  void run(double seconds, const DriverInput& input, double step = dt) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / step)); ++i) {
      vehicle->drive(input, step);
      t.step(step);
    }
  }
  TestWorld t;
  PlumbBody chassis = 0;
  RayVehicleSettings settings;
  std::unique_ptr<RaycastVehicle> vehicle;
};

TEST(RaycastVehicle, RestsAtTheStaticDeflection) {
  for (const double step : {1.0 / 30, 1.0 / 240}) {
    Car car;
    car.run(4, {}, step);
    for (const RayWheelState& wheel : car.vehicle->wheels()) {
      EXPECT_TRUE(wheel.on_ground);
      EXPECT_NEAR(wheel.compression, mass * 9.81 / (4 * 40000), 1e-4) << step;
      EXPECT_NEAR(wheel.load, mass * 9.81 / 4, 5) << step;
    }
    EXPECT_NEAR(car.t.pose(car.chassis).orientation.w, 1, 1e-6);
  }
}

TEST(RaycastVehicle, StopsInTheDistanceThatGripAllows) {
  Car car;
  car.run(2, {});
  car.t.set_velocity(car.chassis, {{0, 0, 20}, {0, 0, 0}});
  const double start = car.t.pose(car.chassis).position.z;
  car.run(4, {0, 0, 1e5});
  const PlumbPose end = car.t.pose(car.chassis);
  EXPECT_NEAR(car.t.velocity(car.chassis).linear.z, 0, 0.01);
  EXPECT_NEAR(end.position.z - start, 20 * 20 / (2 * 9.81), 1.0);
  EXPECT_NEAR(end.position.x, 0, 0.01);
}

TEST(RaycastVehicle, RollsStraightAndDrivesByItsEngine) {
  Car car;
  car.run(2, {});
  car.run(2, {0, 700, 0});
  EXPECT_NEAR(car.vehicle->speed(), 2 * 700 / 0.35 / mass, 0.1);
  const double speed = car.vehicle->speed();
  car.run(4, {});
  EXPECT_NEAR(car.vehicle->speed(), speed, 0.01 * speed);
  EXPECT_NEAR(car.t.pose(car.chassis).position.x, 0, 1e-2);
}

TEST(RaycastVehicle, TurnsLikeABicycle) {
  Car car;
  car.run(2, {});
  car.t.set_velocity(car.chassis, {{0, 0, 5}, {0, 0, 0}});
  const double steering = 0.2;
  car.run(2, {steering, 0, 0});
  const TestWorld::Velocity v = car.t.velocity(car.chassis);
  const double rear = 2.8 / std::tan(steering);  // of the middle of the rear axle; the centre is 1.4 m before it
  const double radius = std::hypot(rear, 1.4);
  EXPECT_NEAR(std::hypot(v.linear.x, v.linear.z) / v.angular.y, radius, 0.03 * radius);
}

TEST(RaycastVehicle, StandsOnASlopeByItsBrakes) {
  for (const PlumbVec3 gravity : {PlumbVec3{2, -9.6, 0}, PlumbVec3{0, -9.6, 2}}) {
    Car car(gravity);
    car.run(3, {0, 0, 5000});
    const PlumbPose start = car.t.pose(car.chassis);
    car.run(3, {0, 0, 5000});
    EXPECT_NEAR(car.t.pose(car.chassis).position.x, start.position.x, 1e-3);
    EXPECT_NEAR(car.t.pose(car.chassis).position.z, start.position.z, 1e-3);
  }
}

TEST(RaycastVehicle, RefusesAWorldWithoutRays) {
  TestWorld t({0, 0, 0}, PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_FORCES);
  const PlumbBody body = t.sphere(0.5, {0, 0, 0}, 1);
  EXPECT_THROW(RaycastVehicle(*t.world, body, {}), Error);
}

}  // namespace
}  // namespace plumb::helpers::test
