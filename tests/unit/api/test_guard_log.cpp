// What the guard tells the host's log: remarks of steps once a world, and why a world was lost.
#include <gtest/gtest.h>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

std::vector<std::pair<PlumbLogLevel, std::string>> lines;

const PlumbHost* host_that_listens() {
  static const PlumbHost host = [] {
    PlumbHost made{};
    made.struct_size = sizeof made;
    made.log = [](void*, PlumbLogLevel level, const char* line) { lines.emplace_back(level, line); };
    return made;
  }();
  return &host;
}

class GuardLog : public ::testing::Test {
 protected:
  GuardLog() { lines.clear(); }
  static void step(IPhysicsWorld& world, std::uint32_t remarks) {
    FakeWorld::last->remarks = remarks;
    PlumbStepReport report{};
    ASSERT_EQ(world.step(0.1), PLUMB_OK);
    ASSERT_EQ(world.wait(report), PLUMB_OK);
    EXPECT_EQ(report.remarks, remarks);
  }
  Backend backend{negotiate(&backend::open<FakeWorld>, "fake", host_that_listens())};
};

TEST_F(GuardLog, ToldOfEachKindOfRemarkOnceAWorld) {
  const auto world = backend.create_world(world_desc(0));
  step(*world, 0);
  EXPECT_TRUE(lines.empty());
  step(*world, PLUMB_REMARK_ENERGY_BOUNDED);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].first, PLUMB_LOG_WARNING);
  EXPECT_EQ(lines[0].second.find("step 2: it would have made energy"), 0u) << lines[0].second;
  step(*world, PLUMB_REMARK_ENERGY_BOUNDED);
  EXPECT_EQ(lines.size(), 1u);
  step(*world, PLUMB_REMARK_ENERGY_BOUNDED | PLUMB_REMARK_CAPACITY_GREW | PLUMB_REMARK_SOLVER_FELL_BACK);
  EXPECT_EQ(lines.size(), 3u);
  const auto other = backend.create_world(world_desc(0));
  step(*other, PLUMB_REMARK_ENERGY_BOUNDED);
  EXPECT_EQ(lines.size(), 4u) << "another world tells its own";
}

TEST_F(GuardLog, ToldWhyAWorldIsLost) {
  const auto world = backend.create_world(world_desc(0));
  FakeWorld::last->on_step = [] { throw std::runtime_error("a step that fails is no world lost"); };
  EXPECT_EQ(world->step(0.1), PLUMB_E_INTERNAL);
  EXPECT_TRUE(lines.empty());
  FakeWorld::last->on_step = [] { throw Error(PLUMB_E_WORLD_LOST, "the device burst"); };
  EXPECT_EQ(world->step(0.1), PLUMB_E_WORLD_LOST);
  EXPECT_EQ(world->step(0.1), PLUMB_E_WORLD_LOST);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], (std::pair<PlumbLogLevel, std::string>(PLUMB_LOG_ERROR, "a world is lost: the device burst")));
}

}  // namespace
}  // namespace plumb::test
