// Steps of boxes whose outcome is known in closed form.
#include <gtest/gtest.h>

#include "problems.hpp"
#include "reference/solver.hpp"

namespace plumb::reference {
namespace {

using Eigen::VectorXd;

struct Outcome {
  VectorXd velocity, given;  ///< six numbers a body
};

Outcome outcome_of(const StepProblem& step) {
  const Solution solution = solve(step.problem());
  EXPECT_TRUE(solution.converged) << solution.residual.natural_map;
  return {step.velocity_after(solution.impulse), step.impulse_on_bodies(solution.impulse)};
}

TEST(StepProblem, ACubeSlidesSticksAndStops) {
  Tower tower(1, 0.5);
  const double lost = 0.5 * gravity * step_seconds;
  tower.bodies[1].linear = {3, 0, 4};
  Outcome after = outcome_of(tower.problem());
  // It slides on, upright: friction acts at its foot, and the load moves to the leading edge.
  EXPECT_LT((after.velocity.segment<3>(6) - (5 - lost) / 5 * referee::Vec3(3, 0, 4)).norm(), 1e-9);
  EXPECT_LT(after.velocity.segment<3>(9).norm(), 1e-9);
  EXPECT_NEAR(after.given[7], 1000 * gravity * step_seconds, 1e-6);
  tower.bodies[1].linear = {0.6 * lost, 0, 0};
  after = outcome_of(tower.problem());
  EXPECT_LT(after.velocity.norm(), 1e-9);
  EXPECT_NEAR(after.given[6], -1000 * 0.6 * lost, 1e-6);
}

TEST(StepProblem, ATowerRestsWhateverItsMasses) {
  for (const double ratio : {1.0, 100.0, 0.01}) {
    const Tower tower(3, 0.5, ratio);
    const Outcome after = outcome_of(tower.problem());
    EXPECT_LT(after.velocity.norm(), 1e-8) << ratio;
    EXPECT_NEAR(after.given[1] / (1000 * (1 + ratio + ratio * ratio) * gravity * step_seconds), -1, 1e-9) << ratio;
  }
  const Outcome high = outcome_of(Tower(20, 0.5).problem());
  EXPECT_LT(high.velocity.norm(), 1e-9);
}

TEST(StepProblem, GapsCloseAndBoxesBounce) {
  Tower tower(1, 0);
  for (StepContact& contact : tower.contacts) contact.bias = 0.1;  // 1/600 m above the ground
  EXPECT_NEAR(outcome_of(tower.problem()).velocity[7], -0.1, 1e-10);
  tower.bodies[1].linear.y() = -2;
  for (StepContact& contact : tower.contacts) contact.bias = 0.5 * -2;
  EXPECT_NEAR(outcome_of(tower.problem()).velocity[7], 1, 1e-10);
}

TEST(StepProblem, BodiesWithoutMassKeepTheirVelocity) {
  Tower tower(1, 0.5);
  tower.bodies[0].linear = {0.01, 0, 0};  // a slow belt takes it along
  const Outcome after = outcome_of(tower.problem());
  EXPECT_NEAR(after.velocity[0], 0.01, 1e-15);
  EXPECT_NEAR(after.velocity[6], 0.01, 1e-10);
  EXPECT_NEAR(after.given[6], 1000 * 0.01, 1e-6);
}

TEST(StepProblem, GyroscopicTermTurnsTheSpin) {
  referee::BodyState body = cube(6, {0, 0, 0});
  body.mass.inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();
  body.angular = {1, 1, 0};
  const StepProblem step(std::span(&body, 1), {}, {referee::Vec3::Zero(), 0.1, true});
  EXPECT_LT((step.free_velocity().tail<3>() - Eigen::Vector3d(1, 1, -0.1 / 3)).norm(), 1e-15);
}

}  // namespace
}  // namespace plumb::reference
