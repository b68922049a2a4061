#include "solver/step_solver.hpp"

#include <dart/constraint/ConstrainedGroup.hpp>
#include <dart/constraint/JointConstraint.hpp>

#include "plumb/physics_world.hpp"

namespace plumb::dart6 {

using ::dart::constraint::ConstrainedGroup;
using ::dart::constraint::ConstraintBasePtr;

namespace {

/// DART's solvers walk in rows of a multiple of four.
int padded(int n) { return n > 1 ? ((n - 1) | 3) + 1 : n; }

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

constexpr int kMostRows = 12000;  ///< the matrix has as many columns, and is kept twice: 2.3 GB

}  // namespace

void StepSolver::solve(const Settings& settings, double h, const std::vector<ConstraintBasePtr>& constraints) {
  mTimeStep = h;
  method_ = settings.solver;
  auto option = gauss_seidel_.getOption();
  option.mMaxIteration = settings.iterations;
  gauss_seidel_.setOption(option);
  mActiveConstraints.clear();
  for (const auto& skeleton : mSkeletons) skeleton->clearConstraintImpulses();
  for (const ConstraintBasePtr& constraint : constraints) {
    constraint->update();
    if (constraint->isActive()) mActiveConstraints.push_back(constraint);
  }
  add_joint_constraints();
  buildConstrainedGroups();
  solveConstrainedGroups();
  mConstrainedGroups.clear();
  mActiveConstraints.clear();
}

/// Limits and motors, as DART makes them anew in each step.
void StepSolver::add_joint_constraints() {
  for (const auto& skeleton : mSkeletons) {
    for (std::size_t i = 0; i < skeleton->getNumJoints(); ++i) {
      ::dart::dynamics::Joint* joint = skeleton->getJoint(i);
      if (joint->isKinematic()) continue;
      if (!joint->areLimitsEnforced() && joint->getActuatorType() != ::dart::dynamics::Joint::SERVO) continue;
      const ConstraintBasePtr constraint = std::make_shared<::dart::constraint::JointConstraint>(joint);
      constraint->update();
      if (constraint->isActive()) mActiveConstraints.push_back(constraint);
    }
  }
}

/// A's columns are what a unit impulse of each row changes of the speeds along all rows.
StepSolver::Problem StepSolver::make_problem(ConstrainedGroup& group) const {
  Problem p;
  p.size = static_cast<int>(group.getTotalDimension());
  p.stride = padded(p.size);
  const auto n = static_cast<std::size_t>(p.size), stride = static_cast<std::size_t>(p.stride);
  if (p.size > kMostRows)
    throw Error(PLUMB_E_WORLD_LOST, "DART has " + std::to_string(p.size) +
                                        " rows to solve at once, of which it can have " + std::to_string(kMostRows) +
                                        "; destroy the world and make it smaller");
  p.a.assign(n * stride, 0.0);
  for (auto* row : {&p.x, &p.b, &p.w, &p.lower, &p.upper}) row->assign(n, 0.0);
  p.of_normal.assign(n, -1);
  std::vector<std::size_t> first;
  for (std::size_t i = 0, next = 0; i < group.getNumConstraints(); ++i) {
    first.push_back(next);
    next += group.getConstraint(i)->getDimension();
  }
  ::dart::constraint::ConstraintInfo info{};
  info.invTimeStep = 1 / mTimeStep;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const ConstraintBasePtr constraint = group.getConstraint(i);
    const std::size_t at = first[i];
    info.x = &p.x[at], info.lo = &p.lower[at], info.hi = &p.upper[at];
    info.b = &p.b[at], info.w = &p.w[at], info.findex = &p.of_normal[at];
    constraint->getInformation(&info);
    constraint->excite();
    for (std::size_t j = 0; j < constraint->getDimension(); ++j) {
      if (p.of_normal[at + j] >= 0) p.of_normal[at + j] += static_cast<int>(at);
      constraint->applyUnitImpulse(j);
      double* column = &p.a[stride * (at + j)];
      constraint->getVelocityChange(column + at, true);
      for (std::size_t k = i + 1; k < first.size(); ++k)
        group.getConstraint(k)->getVelocityChange(column + first[k], false);
      for (std::size_t k = 0; k < at; ++k) column[k] = p.a[stride * k + at + j];
    }
    constraint->unexcite();
  }
  return p;
}

/// Dantzig's method changes what it is given, so the other gets a copy of its own.
void StepSolver::solve_problem(Problem& p) {
  if (!all_finite(p.a) || !all_finite(p.b))
    throw Error(PLUMB_E_WORLD_LOST,
                "the equations of DART's constraints are not finite: bodies are too fast, too far "
                "away or too light; destroy the world and take a smaller dt or more substeps");
  const auto run = [](auto& solver, Problem& of, bool may_give_up) {
    return solver.solve(of.size, of.a.data(), of.x.data(), of.b.data(), 0, of.lower.data(), of.upper.data(),
                        of.of_normal.data(), may_give_up);
  };
  if (method_ == kDantzig) {
    Problem tried = p;
    if (run(dantzig_, tried, true) && all_finite(tried.x)) {
      p.x = std::move(tried.x);
      return;
    }
    fell_back = true;
  }
  run(gauss_seidel_, p, false);
  if (!all_finite(p.x))
    throw Error(PLUMB_E_WORLD_LOST,
                "DART's solver found impulses that are not finite; destroy the world and take a "
                "smaller dt or more substeps");
}

void StepSolver::solveConstrainedGroup(ConstrainedGroup& group) {
  if (group.getTotalDimension() == 0) return;
  Problem problem = make_problem(group);
  solve_problem(problem);
  std::size_t at = 0;
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
    const ConstraintBasePtr constraint = group.getConstraint(i);
    constraint->applyImpulse(&problem.x[at]);
    constraint->excite();
    at += constraint->getDimension();
  }
}

}  // namespace plumb::dart6
