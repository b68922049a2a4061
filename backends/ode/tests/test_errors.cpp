// ODE ends the process on errors; a plumb world must answer instead.
#include <gtest/gtest.h>

#include <ode/ode.h>

#include <limits>

#include "errors.hpp"
#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

std::vector<std::string> lines;

/// Provoked below the interface, where an error can be had at will: dError exits when its handler returns.
TEST(Errors, OfOdeBecomeExceptionsInsideAScope) {
  PlumbHost host{};
  host.log = [](void*, PlumbLogLevel, const char* line) { lines.emplace_back(line); };
  WorldInit init{};
  init.host = &host;
  const ode::ErrorScope scope(init);
  try {
    dError(d_ERR_LCP, "provoked %d", 7);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_WORLD_LOST);
    EXPECT_NE(std::string(error.what()).find("provoked 7"), std::string::npos);
  }
  EXPECT_THROW(dDebug(0, "failed"), Error);
  dMessage(0, "told %s", "so");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("told so"), std::string::npos);
}

/// A box so far away that the hash space's integers cannot hold it: an assertion inside ODE, which is built with them.
TEST(Errors, OfTheEngineAreResults) {
  const TestWorld world(usual_needs);
  const PlumbShape box = world.box(.01, .01, .01);
  world.dynamic(box, {0, 0, 0});
  world.dynamic(box, {1e12, 0, 0});
  EXPECT_EQ(world->step(dt), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("ODE"), std::string::npos) << world->error_text();
  EXPECT_EQ(world->step(dt), PLUMB_E_WORLD_LOST);
  EXPECT_EQ(world->set_gravity({0, 0, 0}), PLUMB_E_WORLD_LOST);
}  // and the world can be destroyed, and another be made

TEST(Errors, NonFiniteBodiesAreCountedThenRefused) {
  const TestWorld world(usual_needs | PLUMB_NEED_FORCES);
  const PlumbBody body = world.dynamic(world.sphere(.5), {0, 0, 0});
  for (int i = 0; i < 2; ++i) world.write(body, PLUMB_FIELD_FORCE, {1.7e308, 0, 0});
  EXPECT_EQ(world.step().nonfinite, 1u);
  EXPECT_EQ(world->step(dt), PLUMB_E_WORLD_LOST);
  EXPECT_NE(world->error_text().find("NaN or infinite"), std::string::npos);
}

}  // namespace
}  // namespace plumb::ode_test
