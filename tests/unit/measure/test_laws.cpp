// Metrics that need no closed form, on hand-made states and series whose residuals are known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "measure/instruments/contact_laws.hpp"
#include "measure/instruments/drift.hpp"
#include "measure/instruments/statistics.hpp"

namespace plumb::harness {
namespace {

using referee::BodyState;
using referee::ContactSample;
using referee::Vec3;

constexpr double dt = 0.02;
const Vec3 gravity(0, -10, 0);

/// A cube of 10 kg and 1 m on the ground, in one step that one contact under its middle explains.
class OneStep : public testing::Test {
 protected:
  OneStep() {
    for (auto* states : {&before, &after}) {
      (*states)[1].mass.mass = 10;
      (*states)[1].mass.inertia = 10.0 / 6 * referee::Mat3::Identity();
      (*states)[1].pose.position = {0, 0.5, 0};
    }
    contact.normal = {0, 1, 0};
    contact.normal_impulse = 10 * 10 * dt;  // carries the weight
  }
  LawResiduals residuals() {
    const ContactSample sample{&contact, &after[0], &after[1], 0.5};
    return law_residuals(before, after, {&sample, 1}, gravity, dt, true);
  }

  std::array<BodyState, 2> before, after;  ///< the ground, the cube
  PlumbContact contact{};
};

TEST_F(OneStep, RestKeepsAllLaws) {
  const LawResiduals r = residuals();
  EXPECT_NEAR(r.natural_map, 0, 1e-15);
  EXPECT_NEAR(r.body_balance, 0, 1e-15);
  EXPECT_NEAR(r.world_balance, 0, 1e-15);
  EXPECT_NEAR(r.ground_balance, 0, 1e-15);
}

TEST_F(OneStep, SlidingUnderFullFrictionSolvesTheContactProblem) {
  before[1].linear = {3, 0, 0};
  after[1].linear = {2.9, 0, 0};
  contact.tangent_impulse = {-1, 0, 0};  // mu times 2 N s
  // The lever turns the cube: 1 N s half a metre below its centre.
  after[1].angular = {0, 0, -0.5 / (10.0 / 6)};
  contact.position = {0, 0, 0};
  // Its point of contact still slides along x without rising.
  const LawResiduals r = residuals();
  EXPECT_NEAR(r.body_balance, 0, 1e-12);
  EXPECT_NEAR(r.world_balance, 0, 1e-12);
  EXPECT_NEAR(r.natural_map, 0, 1e-12);
  contact.tangent_impulse = {-0.9, 0, 0};  // too little friction for what slides
  EXPECT_GT(residuals().natural_map, 0.04);
  EXPECT_NEAR(residuals().body_balance, 0.1 / 2, 1e-12);
}

TEST_F(OneStep, NaturalMapSeesWhatIsWrongWithAnImpulse) {
  after[1].linear = {0, 0.1, 0};  // parts while it is pressed: P_K(lambda - rho u^) lies rho u_n below lambda
  // rho = 3 / trace: 3/m + arm^2 (1/I + 1/I) = .3 + .25 * 1.2
  EXPECT_NEAR(residuals().natural_map, 3 / 0.6 * 0.1 / 2, 1e-12);
  contact.normal_impulse = -1;  // pulls
  after[1].linear = Vec3::Zero();
  EXPECT_NEAR(residuals().natural_map, 0.5, 1e-12);
}

TEST_F(OneStep, BalancesSeeAnImpulseThatIsMissing) {
  contact.normal_impulse = 1;  // half the weight; the cube stands all the same
  EXPECT_NEAR(residuals().body_balance, 0.5, 1e-12);
  EXPECT_NEAR(residuals().world_balance, 0.5, 1e-12);
  EXPECT_NEAR(residuals().ground_balance, 0.5, 1e-12);
  contact.normal_impulse = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(residuals().body_balance));
}

TEST(JointDrift, TellsDriftFromTrembling) {
  JointDrift drift;
  for (int i = 0; i <= 100; ++i) {
    referee::JointError grows, trembles;
    grows.position = 1e-3 * i;
    trembles.position = i % 2 == 0 ? 0.02 : 0;
    trembles.angle = 0.3;
    trembles.limit_angle = 0.1;
    const std::array errors{grows, trembles};
    drift.add(errors, 0.1 * i);
  }
  EXPECT_DOUBLE_EQ(drift.gap_max(), 0.1);
  EXPECT_DOUBLE_EQ(drift.angle_max(), 0.3);
  EXPECT_DOUBLE_EQ(drift.limit_max(), 0.1);
  EXPECT_NEAR(drift.gap_rms(), std::sqrt((1e-6 * 338350 + 51 * 4e-4) / 202), 1e-12);
  EXPECT_NEAR(drift.gap_slope(), 0.0095, 1e-3);
  const std::array line{SeriesPoint{0, 1}, SeriesPoint{1, 3}, SeriesPoint{2, 5}};
  EXPECT_DOUBLE_EQ(slope_of(line), 2);
  const std::array level{SeriesPoint{0, 1}, SeriesPoint{1, -1}, SeriesPoint{2, 1}};
  EXPECT_DOUBLE_EQ(slope_of(level), 0);
}

TEST(RestWatch, CountsTheLastSecondsOnly) {
  RestWatch rest(10, 2);
  rest.add(5, std::array{100.0});
  rest.add(9, std::array{3.0, 4.0});
  rest.add(10, std::array{0.0, 1.0});
  EXPECT_DOUBLE_EQ(rest.last_speed(), 1);
  EXPECT_DOUBLE_EQ(rest.jitter(), std::sqrt(26.0 / 4));
  rest.add(10, std::array{std::numeric_limits<double>::quiet_NaN()});
  EXPECT_TRUE(std::isnan(rest.jitter()));
}

TEST(Statistics, OrderAndErrorOfWhatConverges) {
  // x(h) = 1 + 3 h^2: D(h) = 3 (h^2 - h^2 / 4), so p = 2 and the error at h / 4 is 3 h^2 / 16.
  const auto x = [](double h) { return 1 + 3 * h * h; };
  const Convergence second = convergence(std::abs(x(.1) - x(.05)), std::abs(x(.05) - x(.025)));
  EXPECT_NEAR(second.order, 2, 1e-12);
  EXPECT_NEAR(second.error, x(.025) - 1, 1e-15);
  EXPECT_NEAR(convergence(0.2, 0.1).order, 1, 1e-15);
  EXPECT_NEAR(convergence(0.2, 0.1).error, 0.1, 1e-15);
  EXPECT_LT(convergence(0.1, 0.2).order, 0);
  EXPECT_TRUE(std::isnan(convergence(0.1, 0.2).error));
  EXPECT_EQ(convergence(0, 0).error, 0);
}

TEST(Statistics, SpreadAndGrowth) {
  const std::array values{1.0, 2.0, 3.0, 4.0};
  EXPECT_DOUBLE_EQ(spread_of(values).mean, 2.5);
  EXPECT_DOUBLE_EQ(spread_of(values).deviation, std::sqrt(5.0 / 3));
  EXPECT_EQ(spread_of(std::span(values).first(1)).deviation, 0);
  EXPECT_NEAR(growth_rate(1e-6, 1e-6 * std::exp(8.0), 2), 4, 1e-12);
}

}  // namespace
}  // namespace plumb::harness
