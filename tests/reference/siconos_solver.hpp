// Siconos Numerics (https://nonsmooth.gricad-pages.univ-grenoble-alpes.fr/siconos) on our contact problems.
#pragma once

#include "reference/contact_problem.hpp"

namespace plumb::reference::testing {

enum class Method {
  gauss_seidel,    ///< NSGS: block Gauss-Seidel with a Newton method for each contact
  proximal_newton  ///< PROX: proximal points, each by the nonsmooth Newton method of Alart & Curnier (NSN_AC)
};

struct SecondOpinion {
  bool converged = false;   ///< as Siconos says
  Eigen::VectorXd impulse;  ///< three numbers a contact
};

/// Solved to 1e-12 of the natural map as Siconos measures it, from zero impulses.
[[nodiscard]] SecondOpinion solve_by_siconos(const ContactProblem& problem, Method method);

}  // namespace plumb::reference::testing
