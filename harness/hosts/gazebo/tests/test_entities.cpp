// Who is there, who comes and goes, and where the host puts them.
#include <cmath>

#include "hosts/gazebo/tests/worlds.hpp"

namespace plumb::gazebo::tests {
namespace {

class Entities : public OverBackends {};
INSTANTIATE_TEST_SUITE_P(Over, Entities, testing::Values("impulse", "bullet", "ode"), backend_name);

TEST_P(Entities, GoAndAreGone) {
  ASSERT_TRUE(host->load(world(ground() + cube("below", "0 0 0.1 0 0 0") + ball("above", "0 0 0.3 0 0 0"))));
  host->step(kDt, 200);
  EXPECT_NEAR(host->pose("above::link").Pos().Z(), 0.3, 0.01);
  EXPECT_TRUE(host->remove("below"));
  EXPECT_FALSE(host->has_model("below"));
  for (const ContactSeen& contact : host->contacts()) {
    EXPECT_NE(contact.first, "below");
    EXPECT_NE(contact.second, "below");
  }
  host->step(kDt, 1000);
  EXPECT_NEAR(host->pose("above::link").Pos().Z(), 0.1, 0.01);
}

TEST_P(Entities, ArePlacedAndMovedAsOne) {
  const std::string two = link(inertia(1, 0.01, 0.01, 0.01) + collision("c", sphere(0.1)), "first") +
                          link(inertia(1, 0.01, 0.01, 0.01) + collision("c", sphere(0.1)), "second", "1 0 0 0 0 0") +
                          "<joint name='j' type='fixed'><parent>first</parent><child>second</child></joint>";
  ASSERT_TRUE(host->load(world(model("pair", "0 0 0 0 0 0", two), "0 0 0")));
  host->step(kDt);
  ASSERT_TRUE(host->is_free("pair"));
  host->place("pair", Pose(5, 0, 2, 0, 0, M_PI / 2));
  expect_near(host->pose("pair::second").Pos(), {5, 1, 2}, 1e-5);
  expect_near(host->model_pose("pair").Pos(), {5, 0, 2}, 1e-5);
  host->move("pair", {0, 0, 0}, {0, 0, 1});
  expect_near(host->velocity("pair::second"), {-1, 0, 0}, 1e-5);
  host->step(kDt, 100);
  const Vector between = host->pose("pair::second").Pos() - host->pose("pair::first").Pos();
  expect_near(between, {-std::sin(0.1), std::cos(0.1), 0}, 2e-3);
  expect_near(host->spin("pair::first"), {0, 0, 1}, 2e-3);
}

TEST_P(Entities, ThatStandArePlacedToo) {
  ASSERT_TRUE(host->load(world(ground() + ball("ball", "0 0 0.1 0 0 0"))));
  host->step(kDt, 100);
  host->place("ground", Pose(0, 0, -1, 0, 0, 0));
  host->step(kDt, 1000);
  EXPECT_NEAR(host->pose("ball::link").Pos().Z(), -0.9, 0.01);
}

TEST_P(Entities, AreToldWhenTheyMove) {
  ASSERT_TRUE(host->load(world(ground() + ball("ball", "0 0 10 0 0 0"))));
  host->step(kDt);
  EXPECT_EQ(host->changed(), 2U);  // all is new
  host->step(kDt, 500);
  EXPECT_EQ(host->changed(), 1U);
  host->place("ground", Pose(0, 0, -1, 0, 0, 0));
  host->step(kDt);
  EXPECT_EQ(host->changed(), 2U);
}

TEST_P(Entities, OfNestedModelsAreThere) {
  const std::string part = link(inertia(1, 0.01, 0.01, 0.01) + collision("c", sphere(0.1)), "hand");
  const std::string text = model("arm", "1 0 0 0 0 0",
                                 link(inertia(1, 0.01, 0.01, 0.01), "base") + model("tool", "0 2 0 0 0 0", part) +
                                     "<joint name='j' type='revolute'><parent>base</parent><child>tool::hand</child>"
                                     "<axis><xyz>0 0 1</xyz></axis></joint>");
  ASSERT_TRUE(host->load(world(text, "0 0 0")));
  EXPECT_EQ(host->links("arm"), 1U);
  EXPECT_TRUE(host->has_joint("arm::j"));
  host->set_rate("arm::j", 1);
  host->step(kDt, 10);
  EXPECT_NEAR(host->rate("arm::j"), 1, 0.01);
}

/// As gz-sim makes worlds: piece by piece, after the frames of the file are gone.
TEST_P(Entities, AreTheSameInPieces) {
  const std::string pole = link(inertia(1, 0.01, 0.01, 0.01) + collision("c", sphere(0.1)), "bob", "1 0 2 0 0 0.3") +
                           "<joint name='j' type='revolute'><pose>-1 0 0 0 0 0</pose><parent>world</parent>"
                           "<child>bob</child><axis><xyz>0 1 0</xyz></axis></joint>";
  const std::string text = world(ground() + model("pole", "0 0 1 0 0 0", pole) + cube("a", "3 0 0.2 0.1 0 0"));
  Host pieces(GetParam());
  ASSERT_TRUE(host->load(text));
  ASSERT_TRUE(pieces.load_in_pieces(text));
  host->step(kDt, 500);
  pieces.step(kDt, 500);
  for (const char* name : {"pole::bob", "a::link"}) expect_near(host->pose(name).Pos(), pieces.pose(name).Pos(), 1e-9);
  EXPECT_NEAR(host->position("pole::j"), pieces.position("pole::j"), 1e-9);
  EXPECT_GT(std::abs(host->position("pole::j")), 0.1);
}

TEST_P(Entities, GoOnInAnotherEngine) {
  ASSERT_TRUE(host->load(world(ball("ball", "0 0 10 0 0 0"))));
  EXPECT_EQ(host->solver(), GetParam());
  host->step(kDt, 250);
  for (const std::string other : {"ode", "bullet", "impulse"}) {
    if (std::string(PLUMB_TESTED_BACKENDS).find(other) == std::string::npos) continue;
    host->set_solver(other);
    EXPECT_EQ(host->solver(), other);
    host->step(kDt, 50);
  }
  host->step(kDt, 100);
  EXPECT_NEAR(host->pose("ball::link").Pos().Z(), 10 - kG * 0.5 * 0.5 / 2, kG * 0.5 * kDt / 2 + 1e-4);
  host->set_solver("no-such-engine");
  EXPECT_NE(host->solver(), "no-such-engine");
}

}  // namespace
}  // namespace plumb::gazebo::tests
