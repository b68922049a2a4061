// What the engine shows of its islands and of how it solved what binds the bodies.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bodies/step_counters.hpp"
#include "joints/joint_store.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kDebugNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SLEEPING | PLUMB_NEED_JOINTS;

std::vector<PlumbDebugConstraint> constraints_of(Scene& scene) {
  std::span<const PlumbDebugConstraint> rows;
  check(scene.world(), scene.world().debug()->solved_constraints(rows));
  return {rows.begin(), rows.end()};
}
std::map<PlumbBody, PlumbDebugBody> bodies_of(Scene& scene) {
  std::span<const PlumbDebugBody> rows;
  check(scene.world(), scene.world().debug()->body_states(rows));
  std::map<PlumbBody, PlumbDebugBody> by_body;
  for (const PlumbDebugBody& row : rows) by_body[row.body] = row;
  return by_body;
}

/// A tray with balls on it in a square, and arms that hang from it in a row.
struct Tray {
  explicit Tray(Scene& scene, int side, int joined) {
    const double half = 0.6 * side;
    scene.ground();
    scene.body.mass_mode = PLUMB_MASS_FROM_DENSITY;
    scene.body.density = 1000;
    tray = scene.add(scene.box({half, 0.5, half}), {0, 0.5, 0});
    const PlumbShape ball = scene.sphere(0.4);
    const auto place = [&](int i) { return 1.2 * (i + 0.5) - half; };
    for (int i = 0; i < side * side; ++i) balls.push_back(scene.add(ball, {place(i % side), 1.4, place(i / side)}));
    for (int i = 0; i < joined; ++i) {
      const PlumbVec3 on_tray = {half, 0, place(i)};
      const PlumbBody arm = scene.add(scene.box({0.4, 0.1, 0.1}), {half + 0.5, 0.5, place(i)});
      scene.ball_joint(tray, on_tray, arm, {-0.5, 0, 0});
    }
  }
  PlumbBody tray;
  std::vector<PlumbBody> balls;
};

TEST(DebugConstraints, ThatFindNoColourGoOneByOne) {
  Scene scene{engine(), kDebugNeeds, kDown, 1};
  const int side = 9, joints = static_cast<int>(kJointColours) + 8;  // more balls than colours, too
  const Tray tray(scene, side, joints);
  scene.run(2);
  auto bodies = bodies_of(scene);
  std::set<std::pair<std::int32_t, PlumbBody>> pushed;
  std::map<bool, std::set<std::int32_t>> colours;  // of joints, and of contacts
  std::map<bool, int> counts;
  for (const PlumbDebugConstraint& row : constraints_of(scene)) {
    ++counts[row.joint != 0];
    colours[row.joint != 0].insert(row.colour);
    for (const PlumbBody body : {row.body_a, row.body_b})
      if (row.colour >= 0 && body != 0 && bodies[body].island >= 0) {
        EXPECT_TRUE(pushed.emplace(row.colour, body).second);
      }
  }
  EXPECT_EQ(counts[true], joints);
  EXPECT_GE(counts[false], side * side);
  EXPECT_TRUE(colours[true].contains(-1)) << "a body has more joints than there are colours";
  EXPECT_TRUE(colours[false].contains(-1)) << "a body has more contacts than there are colours";
  EXPECT_EQ(colours[true].size(), kJointColours) << "all but the last, and those that have none";
  EXPECT_EQ(colours[false].size(), kColours + 1);
}

TEST(DebugConstraints, OfASolverWithoutColoursAreNotShown) {
  Scene scene{engine(), kDebugNeeds, kDown, 1, {"solver", "jacobi"}};
  const Tray tray(scene, 2, 0);
  scene.run(2);
  std::span<const PlumbDebugConstraint> rows;
  EXPECT_EQ(scene.world().debug()->solved_constraints(rows), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(scene.world().error_text().find("jacobi"), std::string::npos);
}

TEST(DebugConstraints, OfTheDeadAreLeftOut) {
  Scene scene{engine(), kDebugNeeds, kDown, 1};
  const Tray tray(scene, 2, 0);
  scene.run(2);
  EXPECT_EQ(constraints_of(scene).size(), 5U);
  scene.remove(tray.balls[0]);
  scene.add(scene.sphere(0.4), {50, 50, 50});  // takes the slot
  EXPECT_EQ(constraints_of(scene).size(), 4U);
}

TEST(DebugBodies, IslandsOutlastSleep) {
  Scene scene{engine(), kDebugNeeds, kDown, 1};
  const Tray tray(scene, 3, 0);
  const PlumbBody alone = scene.add(scene.box({0.5, 0.5, 0.5}), {20, 0.5, 0});
  scene.run(20);
  for (const bool asleep : {false, true}) {
    auto bodies = bodies_of(scene);
    EXPECT_EQ(bodies[tray.tray].asleep, asleep ? 1U : 0U);
    for (const PlumbBody ball : tray.balls) {
      EXPECT_EQ(bodies[ball].island, bodies[tray.tray].island);
      EXPECT_EQ(bodies[ball].asleep, asleep ? 1U : 0U);
    }
    EXPECT_NE(bodies[alone].island, bodies[tray.tray].island);
    EXPECT_GE(bodies[alone].island, 0);
    scene.run(asleep ? 0 : 400);
  }
}

TEST(DebugStep, AskingChangesNothing) {
  Scene asked{engine(), kDebugNeeds, kDown, 1}, left{engine(), kDebugNeeds, kDown, 1};
  const Tray one(asked, 4, 3), other(left, 4, 3);
  for (int step = 0; step < 60; ++step) {
    asked.run(1);
    left.run(1);
    (void)constraints_of(asked);
    (void)bodies_of(asked);
    ASSERT_EQ(asked.hash(), left.hash()) << "step " << step;
  }
}

}  // namespace
}  // namespace plumb::impulse::test
