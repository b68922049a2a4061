// The exact solution of small frictional contact problems (up to some hundred contacts), in float64.
#pragma once

#include "reference/contact_problem.hpp"

namespace plumb::reference {

struct SolverOptions {
  double tolerance = 1e-10;  ///< of Residual::natural_map
  int rounds = 10;           ///< each doubles the sweeps of the one before
};

struct Solution {
  Eigen::VectorXd impulse;   ///< r, three numbers a contact
  Eigen::VectorXd velocity;  ///< u = W r + q
  Residual residual;         ///< of what is returned: the best that was found
  bool converged = false;    ///< residual.natural_map <= tolerance
  int sweeps = 0, newton_iterations = 0;
};

/// In turns: block Gauss-Seidel over the contacts, each solved exactly (Jourdan, Alart & Jean 1998), which comes near;
/// a damped semismooth Newton method on the projections of Alart & Curnier 1991, which ends; and where both stall,
/// proximal points (Rockafellar 1976). Where W is singular (more contacts than the bodies need to be held: the impulses
/// are not unique, what they do to the bodies most often is) Newton's Jacobian is made regular by a proximal term. When
/// it does not reach the tolerance it says so: problems with friction near 1 and many times more contacts than bodies
/// may be such. Throws std::invalid_argument as ContactProblem::check does.
[[nodiscard]] Solution solve(const ContactProblem& problem, const SolverOptions& options = {});

}  // namespace plumb::reference
