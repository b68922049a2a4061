// What DART would answer by an assertion, and so by the end of the process, is a world that is lost, in words.
#include <gtest/gtest.h>

#include "plumb_scene.hpp"

namespace {

using namespace scenes;

PlumbResult result_of_step(plumb::IPhysicsWorld& world) {
  const PlumbResult begun = world.step(1.0 / 60);
  if (begun < 0) return begun;
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  return world.wait(report);
}

TEST(DartErrors, ForcesBeyondAllMeasureLoseTheWorld) {
  const auto world = make_world(kNeeds | PLUMB_NEED_FORCES);
  const PlumbBody body = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0}));
  write_row<3>(*world, PLUMB_FIELD_FORCE, body, {1e308, 1e308, 0});
  EXPECT_EQ(result_of_step(*world), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("is pushed by more"), std::string::npos) << world->error_text();
}

TEST(DartErrors, SpeedsBeyondAllMeasureLoseTheWorld) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0});
  desc.linear_velocity = {1e200, 0, 0};
  desc.angular_velocity = {0, 1e200, 0};
  add_body(*world, desc);
  EXPECT_EQ(result_of_step(*world), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("is faster"), std::string::npos) << world->error_text();
}

/// ODE counts cells of a quarter of a metre by an int.
TEST(DartErrors, BodiesBeyondAllMeasureLoseTheWorld) {
  const auto world = make_world(kNeeds);
  add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {1e9, 0, 0}));
  EXPECT_EQ(result_of_step(*world), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("m away"), std::string::npos) << world->error_text();
}

TEST(DartErrors, BodiesThatWeighNearlyNothingAreRefused) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0});
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 1e-200;
  desc.inertia = {1e-200, 1e-200, 1e-200};
  PlumbBody body = 0;
  EXPECT_EQ(world->create_bodies({&desc, 1}, {&body, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("mass is 1e-200"), std::string::npos) << world->error_text();
}

TEST(DartErrors, ASubStepThatIsNothingIsRefused) {
  const auto world = make_world(kNeeds);
  EXPECT_EQ(world->step(5e-324), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("fewer substeps"), std::string::npos) << world->error_text();
  EXPECT_EQ(result_of_step(*world), PLUMB_OK) << "it has changed nothing";
}

TEST(DartErrors, RaysWithoutEndAreRefused) {
  const auto world = make_world(kNeeds | PLUMB_NEED_QUERIES);
  const PlumbRay ray{{0, 0, 0}, {1e308, 1e308, 0}, {1, ~0u, 0, 0}};
  EXPECT_EQ(world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).result, PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("rays[0].translation"), std::string::npos) << world->error_text();
}

TEST(DartErrors, ARodGetsNoMotor) {
  const auto world = make_world(kNeeds);
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_DISTANCE);
  desc.body_b = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {1, 0, 0}));
  desc.rest_length = 1;
  PlumbJoint rod = 0;
  plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&rod, 1}));
  const std::array<double, 12> motor{1, 1};
  const auto rows = plumb::const_rows_over(std::span<const std::array<double, 12>>(&motor, 1));
  EXPECT_EQ(world->joints()->write_joints(PLUMB_JOINT_MOTOR, {&rod, 1}, rows), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("take a slider"), std::string::npos) << world->error_text();
}

}  // namespace
