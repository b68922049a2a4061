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
  write_row<3>(*world, PLUMB_FIELD_FORCE, body, {1e200, 0, 0});
  EXPECT_EQ(result_of_step(*world), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("smaller forces"), std::string::npos) << world->error_text();
}

TEST(DartErrors, SpeedsBeyondAllMeasureLoseTheWorld) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0});
  desc.linear_velocity = {1e150, 0, 0};
  desc.angular_velocity = {0, 1e150, 0};
  add_body(*world, desc);
  EXPECT_EQ(result_of_step(*world), PLUMB_E_WORLD_LOST);
}

TEST(DartErrors, ARodHasNoMotor) {
  const auto world = make_world(kNeeds);
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_DISTANCE);
  desc.body_b = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {1, 0, 0}));
  desc.rest_length = 1;
  desc.motors[0] = {1, 1, 1, 0};
  PlumbJoint id = 0;
  EXPECT_EQ(world->joints()->create_joints({&desc, 1}, {&id, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("motor"), std::string::npos) << world->error_text();
}

}  // namespace
