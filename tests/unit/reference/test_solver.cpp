// The solver against brute force, and what must not change an answer.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <random>

#include "problems.hpp"
#include "reference/solver.hpp"

namespace plumb::reference {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A plane problem, in which the second tangents touch nothing: all ways in which contacts may be open, stick, or slide
/// either way, each a linear system; the relative velocities of the first that breaks no law.
VectorXd brute_force(const ContactProblem& problem) {
  const Index count = problem.contacts();
  const auto ways = static_cast<int>(std::pow(4, count));
  for (int way = 0; way < ways; ++way) {
    MatrixXd a = MatrixXd::Identity(3 * count, 3 * count);
    VectorXd b = VectorXd::Zero(3 * count);
    for (Index c = 0, rest = way; c < count; ++c, rest /= 4) {
      const Index n = 3 * c, t = n + 1;
      if (rest % 4 == 0) continue;  // open: r = 0
      a.row(n) = problem.w.row(n);
      b[n] = -problem.q[n];
      if (rest % 4 == 1) {
        a.row(t) = problem.w.row(t);
        b[t] = -problem.q[t];
      } else {
        a(t, n) = rest % 4 == 2 ? -problem.mu[c] : problem.mu[c];
      }
    }
    const VectorXd r = a.partialPivLu().solve(b), u = problem.velocity(r);
    bool lawful = r.allFinite();
    for (Index c = 0, rest = way; c < count && lawful; ++c, rest /= 4) {
      const double slack = 1e-12, n = r[3 * c], t = r[3 * c + 1];
      lawful = n >= -slack && u[3 * c] >= -slack && std::abs(t) <= problem.mu[c] * n + slack;
      if (rest % 4 >= 2) lawful = lawful && (rest % 4 == 2 ? u[3 * c + 1] <= slack : u[3 * c + 1] >= -slack);
    }
    if (lawful) return u;
  }
  return {};
}

TEST(Solver, AgreesWithBruteForceOnPlaneProblems) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Index count = 1 + i % 4;
    ContactProblem problem{MatrixXd::Zero(3 * count, 3 * count), VectorXd::Zero(3 * count),
                           VectorXd::Constant(count, 0.1 + 0.1 * (i % 6))};
    const MatrixXd root = MatrixXd::NullaryExpr(2 * count, 2 * count, [&] { return unit(random); });
    const MatrixXd plane = root * root.transpose() / 4 + MatrixXd::Identity(2 * count, 2 * count);
    for (Index a = 0; a < count; ++a) {
      for (Index b = 0; b < count; ++b) problem.w.block<2, 2>(3 * a, 3 * b) = plane.block<2, 2>(2 * a, 2 * b);
      problem.w(3 * a + 2, 3 * a + 2) = 1;
      problem.q.segment<2>(3 * a) << unit(random) - 0.5, unit(random);
    }
    const VectorXd expected = brute_force(problem);
    if (expected.size() == 0) continue;
    const Solution found = solve(problem);
    ASSERT_TRUE(found.converged) << i;
    EXPECT_LT((found.velocity - expected).norm(), 1e-9) << i;
    ++compared;
  }
  EXPECT_GT(compared, 190);
}

TEST(Solver, RandomProblemsOfManyContacts) {
  std::mt19937 random(5);
  for (std::size_t i = 0; i < 150; ++i) {
    const StepProblem step = random_problem(random, 1 + i % 8, 1 + i * 7 % 30, 0.3 * static_cast<double>(i % 5));
    const Solution found = solve(step.problem());
    EXPECT_TRUE(found.converged) << i << ": " << found.residual.natural_map;
    EXPECT_LT(found.residual.primal + found.residual.dual + found.residual.complementarity, 1e-9) << i;
  }
}

TEST(Solver, UnitsAndSizesMoveNothing) {
  std::mt19937 random(8);
  const ContactProblem problem = random_problem(random, 4, 9, 0.4).problem();
  ContactProblem other = problem;
  other.w *= 1e9;  // thousandths of a gram
  other.q *= 1e3;  // in mm
  const Solution one = solve(problem), two = solve(other);
  ASSERT_TRUE(one.converged && two.converged);
  EXPECT_LT((two.velocity / 1e3 - one.velocity).norm(), 1e-9);
  const VectorXd wrong = one.impulse * 1.01;
  EXPECT_NEAR(residual(problem, wrong).natural_map / residual(other, wrong * 1e-6).natural_map, 1, 1e-9);
}

TEST(Solver, OrderAndFramesOfContactsMoveNothing) {
  std::mt19937 random(9);
  const ContactProblem problem = random_problem(random, 3, 8, 0.5).problem();
  const Index count = problem.contacts();
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  MatrixXd turn = MatrixXd::Zero(3 * count, 3 * count);  // row blocks: contact order[c], its tangents turned
  VectorXd mu(count);
  for (Index c = 0; c < count; ++c) {
    const Index from = order[static_cast<std::size_t>(c)];
    turn(3 * c, 3 * from) = 1;
    turn.block<2, 2>(3 * c + 1, 3 * from + 1) = Eigen::Rotation2Dd(0.7 * static_cast<double>(c)).toRotationMatrix();
    mu[c] = problem.mu[from];
  }
  const Solution one = solve(problem), two = solve({turn * problem.w * turn.transpose(), turn * problem.q, mu});
  ASSERT_TRUE(one.converged && two.converged);
  EXPECT_LT((turn.transpose() * two.velocity - one.velocity).norm(), 1e-8);
}

TEST(Solver, ResidualSeesEveryLawBroken) {
  const Tower tower(1, 0.5);
  std::vector<referee::BodyState> bodies = tower.bodies;
  bodies[1].linear.x() = 3;
  const StepProblem step(bodies, tower.contacts, weight());
  const Solution found = solve(step.problem());
  ASSERT_TRUE(found.converged);
  const auto with = [&](double normal, double tangent) {
    VectorXd other = found.impulse;
    for (Index c = 0; c < 4; ++c) {
      other[3 * c] *= normal;
      other.segment<2>(3 * c + 1) *= tangent;
    }
    return residual(step.problem(), other);
  };
  EXPECT_GT(with(1, 1.1).primal, 1e-3);             // beyond the cone
  EXPECT_GT(with(0.9, 0.9).dual, 1e-3);             // sinks
  EXPECT_GT(with(1.1, 1.1).complementarity, 1e-4);  // lifts, and presses
  EXPECT_GT(with(1, 0.9).complementarity, 1e-3);    // too little friction
  EXPECT_GT(with(1, -1).complementarity, 1e-3);     // pushes along
  for (const auto& [n, t] : {std::pair{1.0, 1.1}, {0.9, 0.9}, {1.1, 1.1}, {1.0, 0.9}, {1.0, -1.0}})
    EXPECT_GT(with(n, t).natural_map, 1e-3);
}

TEST(Solver, SaysWhenItDidNotGetThere) {
  SolverOptions options;
  options.rounds = 0;
  const Solution none = solve(Tower(2, 0.5).problem().problem(), options);
  EXPECT_FALSE(none.converged);
  EXPECT_GT(none.residual.natural_map, 0.1);
}

TEST(Solver, SaysWhatDoesNotFit) {
  const auto text_of = [](const ContactProblem& problem) -> std::string {
    try {
      static_cast<void>(solve(problem));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const ContactProblem good = Tower(1, 0.5).problem().problem();
  ContactProblem bad = good;
  bad.q.conservativeResize(11);
  EXPECT_EQ(text_of(bad), "q has 11 numbers, but W has 12 rows");
  bad = good;
  bad.mu.conservativeResize(3);
  EXPECT_EQ(text_of(bad), "W has 12 rows and 12 columns, but 3 contacts need 9 of each");
  bad = good;
  bad.mu[2] = -1;
  EXPECT_NE(text_of(bad).find("below 0"), std::string::npos);
  bad = good;
  bad.w(0, 5) += 1;
  EXPECT_EQ(text_of(bad), "W is not symmetric");
  bad = good;
  bad.q[4] = NAN;
  EXPECT_NE(text_of(bad).find("not finite"), std::string::npos);
  EXPECT_TRUE(solve({MatrixXd(0, 0), VectorXd(0), VectorXd(0)}).converged);
}

}  // namespace
}  // namespace plumb::reference
