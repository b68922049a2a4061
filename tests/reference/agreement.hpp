// Whether two solvers agree: by what is unique, for impulses need not be where contacts outnumber what they hold.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "reference/contact_problem.hpp"

namespace plumb::reference::testing {

/// As W = H M^-1 H', the norm sqrt(d' W d) of a difference of impulses is that of the difference it makes to the
/// velocities of all bodies, weighted by their masses and inertias: the root of twice its kinetic energy. Relative to
/// the change that the larger impulses make. What W has below 1e-13 of its largest eigenvalue is rounding.
inline double difference_of_velocities(const ContactProblem& problem, const Eigen::VectorXd& one,
                                       const Eigen::VectorXd& other) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(problem.w);
  const Eigen::VectorXd& values = spectrum.eigenvalues();
  const Eigen::VectorXd roots = (values.array() > 1e-13 * values.maxCoeff()).select(values.cwiseMax(0).cwiseSqrt(), 0);
  const auto norm = [&](const Eigen::VectorXd& impulse) {
    return roots.cwiseProduct(spectrum.eigenvectors().transpose() * impulse).norm();
  };
  const double size = std::max(norm(one), norm(other));
  return size > 0 ? norm(one - other) / size : 0;
}

}  // namespace plumb::reference::testing
