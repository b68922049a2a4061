// DART's constraint solver with our contacts and rows in it, and with an answer where its own would end the process.
#pragma once

#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "settings.hpp"

namespace plumb::dart6 {

class StepSolver final : public ::dart::constraint::ConstraintSolver {
 public:
  /// Of all skeletons, those that stand still too.
  void set_skeletons(std::vector<::dart::dynamics::SkeletonPtr> skeletons) { mSkeletons = std::move(skeletons); }

  /// Impulses of contacts, rows, and of the skeletons' limits and motors, put on the skeletons. h: s. Throws Error
  /// (PLUMB_E_WORLD_LOST) for a problem that DART cannot solve.
  void solve(const Settings& settings, double h, const std::vector<::dart::constraint::ConstraintBasePtr>& constraints);

  /// Dantzig's method gave up since the flag was last cleared.
  bool fell_back = false;

 private:
  /// Of one group of skeletons; w = A x - b, x between bounds (friction: relative to another x).
  struct Problem {
    int size = 0, stride = 0;
    std::vector<double> a, x, b, w, lower, upper;
    std::vector<int> of_normal;  ///< row to which bounds are relative; -1: none
  };

  void solveConstrainedGroup(::dart::constraint::ConstrainedGroup& group) override;
  void add_joint_constraints();
  [[nodiscard]] Problem make_problem(::dart::constraint::ConstrainedGroup& group) const;
  void solve_problem(Problem& problem);

  int method_ = kDantzig;
  ::dart::constraint::DantzigBoxedLcpSolver dantzig_;
  ::dart::constraint::PgsBoxedLcpSolver gauss_seidel_;
};

}  // namespace plumb::dart6
