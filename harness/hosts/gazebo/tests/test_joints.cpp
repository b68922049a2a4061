// Joints: that they hold, turn and slide by mechanics, and do what is set and commanded.
#include <cmath>

#include "hosts/gazebo/tests/worlds.hpp"

namespace plumb::gazebo::tests {
namespace {

class Joints : public OverBackends {};
INSTANTIATE_TEST_SUITE_P(Over, Joints, testing::Values("impulse", "bullet", "ode"), backend_name);

const std::string kBob = inertia(1, 0.004, 0.004, 0.004) + collision("bob", sphere(0.1));

std::string joint(const std::string& type, const std::string& parent, const std::string& child, const std::string& axis,
                  const std::string& pose = "0 0 0 0 0 0", const std::string& name = "j") {
  return "<joint name='" + name + "' type='" + type + "'><pose>" + pose + "</pose><parent>" + parent +
         "</parent><child>" + child + "</child>" + (axis.empty() ? "" : "<axis>" + axis + "</axis>") + "</joint>";
}

/// A bob of 1 kg, 1 m below a hinge along y at the height 2 m.
std::string pendulum(const std::string& axis = "<xyz>0 1 0</xyz>") {
  return model("p", "0 0 1 0 0 0", link(kBob, "bob") + joint("revolute", "world", "bob", axis, "0 0 1 0 0 0"));
}

/// A bob of 1 kg on a rail along z, 1 m above the ground.
std::string slider(const std::string& axis) {
  return model("s", "0 0 1 0 0 0", link(kBob, "bob") + joint("prismatic", "world", "bob", "<xyz>0 0 1</xyz>" + axis));
}

double energy(const Host& host) {
  const double height = host.pose("p::bob").Pos().Z(), spin = host.spin("p::bob").Length();
  return kG * height + host.velocity("p::bob").SquaredLength() / 2 + 0.004 * spin * spin / 2;
}

TEST_P(Joints, SwingAtTheirPeriod) {
  ASSERT_TRUE(host->load(world(pendulum())));
  const double amplitude = 0.05, period = 2 * M_PI * std::sqrt((1 + 0.004) / kG) * (1 + amplitude * amplitude / 16);
  host->set_position("p::j", amplitude);
  double first = 0, last = 0;
  int turns = 0;
  double before = host->position("p::j");
  for (int i = 1; i <= 12000; ++i) {
    host->step(kDt);
    const double now = host->position("p::j");
    if (before > 0 && now <= 0) {
      last = kDt * (i - 1 + before / (before - now));
      if (turns++ == 0) first = last;
    }
    before = now;
  }
  ASSERT_GE(turns, 5);
  EXPECT_NEAR((last - first) / (turns - 1), period, 0.002 * period);
}

TEST_P(Joints, KeepTheEnergyOfASwing) {
  ASSERT_TRUE(host->load(world(pendulum())));
  host->set_position("p::j", 1);
  host->step(kDt);
  const double start = energy(*host), range = kG * (1 - std::cos(1.0));
  host->step(kDt, 10000);
  EXPECT_NEAR(energy(*host), start, 0.01 * range);
  expect_near(host->pose("p::bob").CoordPositionAdd(Vector(0, 0, 1)), {0, 0, 2}, 0.002);
}

TEST_P(Joints, HoldTheirWeight) {
  ASSERT_TRUE(host->load(world(pendulum())));
  host->step(kDt, 200);
  expect_near(host->transmitted_force("p::j"), {0, 0, kG}, 0.01 * kG);
}

TEST_P(Joints, StopAtTheirLimits) {
  ASSERT_TRUE(host->load(world(slider("<limit><lower>-0.3</lower><upper>0.2</upper></limit>"))));
  host->step(kDt, 1500);
  EXPECT_NEAR(host->position("s::j"), -0.3, 0.003);
  EXPECT_NEAR(host->pose("s::bob").Pos().Z(), 0.7, 0.003);
  EXPECT_NEAR(host->rate("s::j"), 0, 0.01);
  host->limit("s::j", -0.5, 0.2);
  host->step(kDt, 1500);
  EXPECT_NEAR(host->position("s::j"), -0.5, 0.003);
}

TEST_P(Joints, GoAtTheSpeedThatIsCommanded) {
  ASSERT_TRUE(host->load(world(pendulum())));
  host->command("p::j", 2);
  host->step(kDt, 5000);
  // ODE's motors are soft: under the bob's weight they are off by up to .04 rad/s.
  const double slip = over("ode", 0.05, 0.01), drift = over("ode", 0.1, 0.05);
  EXPECT_NEAR(host->rate("p::j"), 2, slip);
  EXPECT_NEAR(host->position("p::j"), 10, drift);  // more than a turn
  host->command("p::j", -1);
  host->step(kDt, 1000);
  EXPECT_NEAR(host->rate("p::j"), -1, slip);
  EXPECT_NEAR(host->position("p::j"), 9, drift);
}

TEST_P(Joints, AreNoStrongerThanTheirEffort) {
  ASSERT_TRUE(host->load(world(slider("<limit><effort>5</effort></limit>"))));
  host->command("s::j", 1);
  host->step(kDt, 100);
  EXPECT_NEAR(host->rate("s::j"), -(kG - 5) * 0.1, 0.01);
}

TEST_P(Joints, AreTurnedByForces) {
  ASSERT_TRUE(host->load(world(pendulum(), "0 0 0")));
  for (int i = 0; i < 100; ++i) {
    host->set_force("p::j", 2);
    host->step(kDt);
  }
  EXPECT_NEAR(host->rate("p::j"), 2.0 / (1 + 0.004) * 0.1, 0.002);
  host->step(kDt, 100);  // a force lasts for one step
  EXPECT_NEAR(host->rate("p::j"), 2.0 / (1 + 0.004) * 0.1, 0.002);
}

TEST_P(Joints, PushBothOfTheirLinks) {
  const std::string two = link(kBob, "a") + link(inertia(3, 0.1, 0.1, 0.1), "b", "0.5 0 0 0 0 0") +
                          joint("prismatic", "a", "b", "<xyz>1 0 0</xyz>");
  ASSERT_TRUE(host->load(world(model("m", "0 0 0 0 0 0", two), "0 0 0")));
  for (int i = 0; i < 100; ++i) {
    host->set_force("m::j", 6);
    host->step(kDt);
  }
  expect_near(host->velocity("m::a"), {-0.6, 0, 0}, 0.002);
  expect_near(host->velocity("m::b"), {0.2, 0, 0}, 0.002);
  EXPECT_NEAR(host->rate("m::j"), 0.8, 0.003);
}

TEST_P(Joints, SpringAndDampAsTheirFileSays) {
  const double k = 100, c = 2;
  ASSERT_TRUE(host->load(world(slider("<dynamics><spring_stiffness>100</spring_stiffness><damping>2</damping>"
                                      "<spring_reference>0</spring_reference></dynamics>"),
                               "0 0 0")));
  host->set_position("s::j", 0.1);
  host->step(kDt, 1000);
  const double decay = c / 2, frequency = std::sqrt(k - decay * decay), t = 1;
  const double truth =
      0.1 * std::exp(-decay * t) * (std::cos(frequency * t) + decay / frequency * std::sin(frequency * t));
  EXPECT_NEAR(host->position("s::j"), truth, 0.002);
}

TEST_P(Joints, RubAsTheirFileSays) {
  ASSERT_TRUE(host->load(world(slider("<dynamics><friction>0.5</friction></dynamics>"), "0 0 0")));
  host->set_rate("s::j", 1);
  host->step(kDt, 1000);
  EXPECT_NEAR(host->rate("s::j"), 0.5, 0.01);
  host->step(kDt, 1500);
  EXPECT_NEAR(host->rate("s::j"), 0, 0.001);
  EXPECT_NEAR(host->position("s::j"), 1, 0.01);
}

TEST_P(Joints, ThatAreFixedHold) {
  const std::string two = link(kBob, "a") + link(kBob, "b", "0.5 0 0.3 0 0.4 0") + joint("fixed", "a", "b", "");
  ASSERT_TRUE(host->load(world(ground() + model("m", "0 0 1 0.3 0 0", two))));
  const Pose between = host->pose("m::a").Inverse() * host->pose("m::b");
  host->step(kDt, 2000);
  const Pose now = host->pose("m::a").Inverse() * host->pose("m::b");
  expect_near(now.Pos(), between.Pos(), 0.005);
  EXPECT_LT((now.Rot() * between.Rot().Inverse()).Euler().Length(), 0.01);
}

TEST_P(Joints, OfTwoAxesTellBoth) {
  const std::string content = link(kBob, "bob") +
                              "<joint name='j' type='universal'><parent>world</parent><child>bob</child>"
                              "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>";
  ASSERT_TRUE(host->load(world(model("m", "0 0 0 0 0 0", content), "0 0 0")));
  host->step(kDt);
  host->set_position("m::j", 0.5, 0);
  host->set_position("m::j", 0.3, 1);
  host->step(kDt, 2);
  EXPECT_NEAR(host->position("m::j", 0), 0.5, 1e-3);
  EXPECT_NEAR(host->position("m::j", 1), 0.3, 1e-3);
  expect_near(host->pose("m::bob").Rot().Euler(), {0, 0.3, 0.5}, 1e-3);  // about z, then about the new y
  host->set_rate("m::j", 1, 0);
  host->set_rate("m::j", -2, 1);
  EXPECT_NEAR(host->rate("m::j", 0), 1, 1e-6);
  EXPECT_NEAR(host->rate("m::j", 1), -2, 1e-6);
  host->step(kDt, 2);
  EXPECT_NEAR(host->rate("m::j", 0), 1, 0.02);
  EXPECT_NEAR(host->rate("m::j", 1), -2, 0.02);
}

TEST_P(Joints, OfBallsTurnAboutAnyAxis) {
  const std::string content = link(kBob, "bob") + joint("ball", "world", "bob", "", "0 0 1 0 0 0");
  ASSERT_TRUE(host->load(world(model("m", "0 0 0 0 0 0", content), "0 0 0")));
  host->step(kDt);
  host->set_position("m::j", 0.4, 1);
  host->step(kDt);
  expect_near(host->pose("m::bob").CoordPositionAdd(Vector(0, 0, 1)), {0, 0, 1}, 1e-3);
  EXPECT_NEAR(host->position("m::j", 0), 0, 1e-3);
  EXPECT_NEAR(host->position("m::j", 1), 0.4, 1e-3);
  host->set_rate("m::j", 2, 2);
  host->step(kDt, 100);
  expect_near(host->pose("m::bob").CoordPositionAdd(Vector(0, 0, 1)), {0, 0, 1}, 3e-3);
}

TEST_P(Joints, KeepOthersWhereTheyAreWhenSet) {
  const std::string chain = link(kBob, "upper") + link(kBob, "lower", "0 0 -1 0 0 0") +
                            joint("revolute", "world", "upper", "<xyz>0 1 0</xyz>", "0 0 1 0 0 0", "shoulder") +
                            joint("revolute", "upper", "lower", "<xyz>0 1 0</xyz>", "0 0 1 0 0 0", "elbow");
  ASSERT_TRUE(host->load(world(model("m", "0 0 0 0 0 0", chain), "0 0 0")));
  host->set_position("m::elbow", 0.5);
  host->set_rate("m::elbow", 1);
  host->set_position("m::shoulder", -0.7);
  host->set_rate("m::shoulder", 2);
  EXPECT_NEAR(host->position("m::elbow"), 0.5, 1e-9);
  EXPECT_NEAR(host->rate("m::elbow"), 1, 1e-9);
  host->step(kDt);
  EXPECT_NEAR(host->position("m::elbow"), 0.501, 0.002);
  EXPECT_NEAR(host->position("m::shoulder"), -0.698, 0.002);
  EXPECT_FALSE(host->is_free("m"));
}

TEST_P(Joints, LetGoWhenDetached) {
  ASSERT_TRUE(host->load(world(pendulum())));
  host->step(kDt, 100);
  EXPECT_FALSE(host->is_free("p"));
  host->detach("p::j");
  EXPECT_TRUE(host->is_free("p"));
  host->step(kDt, 100);
  expect_near(host->velocity("p::bob"), {0, 0, -kG * 0.1}, 0.01);
}

/// As gz-sim's detachable joint.
TEST_P(Joints, WeldModelsAndPartThem) {
  ASSERT_TRUE(host->load(world(cube("a", "0 0 0 0 0 0") + cube("b", "0.3 0 0 0 0 0.2"), "0 0 0")));
  host->step(kDt);
  ASSERT_TRUE(host->weld("b::link", "a::link"));
  host->move("a", {1, 0, 0}, {0, 0, 0});
  host->step(kDt, 100);
  expect_near(host->velocity("b::link"), {1, 0, 0}, 0.01);
  expect_near(host->pose("b::link").Pos() - host->pose("a::link").Pos(), {0.3, 0, 0}, 0.002);
  host->detach_weld();
  host->push("b::link", {2000, 0, 0}, host->pose("b::link").Pos());
  host->step(kDt);
  expect_near(host->velocity("b::link"), {2, 0, 0}, 0.01);
  expect_near(host->velocity("a::link"), {1, 0, 0}, 0.01);
  ASSERT_TRUE(host->weld("b::link", "a::link"));
  EXPECT_TRUE(host->remove("a"));
  host->step(kDt, 10);
  expect_near(host->velocity("b::link"), {2, 0, 0}, 0.01);
}

}  // namespace
}  // namespace plumb::gazebo::tests
