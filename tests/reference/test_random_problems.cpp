// Steps of bodies that chance brought into contact, solved by us and by Siconos: the velocities of the bodies.
#include <gtest/gtest.h>

#include "problems.hpp"
#include "reference/solver.hpp"
#include "siconos_solver.hpp"

namespace plumb::reference::testing {
namespace {

/// Without friction velocities are unique. With friction they need not be: where the two differ, each must be an
/// answer.
TEST(RandomProblems, LeaveTheBodiesTheVelocitiesThatSiconosFinds) {
  constexpr double tolerance = 1e-8;  // of the bodies' velocities before
  std::mt19937 random(11);
  int compared = 0, with_several_answers = 0;
  for (std::size_t i = 0; i < 120; ++i) {
    const double friction = 0.2 * static_cast<double>(i % 4);
    const StepProblem step = random_problem(random, 1 + i % 8, 1 + i * 7 % 24, friction);
    const Solution ours = solve(step.problem());
    ASSERT_TRUE(ours.converged) << i;
    const Eigen::VectorXd velocity = step.velocity_after(ours.impulse);
    for (const Method method : {Method::gauss_seidel, Method::proximal_newton}) {
      const SecondOpinion theirs = solve_by_siconos(step.problem(), method);
      if (!theirs.converged) continue;
      ++compared;
      EXPECT_LT(residual(step.problem(), theirs.impulse).natural_map, 1e-10) << i;
      const double difference = (step.velocity_after(theirs.impulse) - velocity).norm() / step.free_velocity().norm();
      if (difference < tolerance) continue;
      EXPECT_GE(friction, 0.6) << i << ": " << difference;
      ++with_several_answers;
    }
  }
  EXPECT_GE(compared, 220);
  EXPECT_LE(with_several_answers, 1);
}

}  // namespace
}  // namespace plumb::reference::testing
