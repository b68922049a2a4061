#include "reference/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumb::reference {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

void ContactProblem::check() const {
  const auto count = [](Index n) { return std::to_string(n); };
  if (w.rows() != w.cols() || w.rows() != 3 * contacts())
    throw std::invalid_argument("W has " + count(w.rows()) + " rows and " + count(w.cols()) + " columns, but " +
                                count(contacts()) + " contacts need " + count(3 * contacts()) + " of each");
  if (q.size() != w.rows())
    throw std::invalid_argument("q has " + count(q.size()) + " numbers, but W has " + count(w.rows()) + " rows");
  if (!w.allFinite() || !q.allFinite() || !mu.allFinite())
    throw std::invalid_argument("W, q or mu holds a number that is not finite");
  if (contacts() > 0 && mu.minCoeff() < 0)
    throw std::invalid_argument("a coefficient of friction is " + std::to_string(mu.minCoeff()) + ", which is below 0");
  if (contacts() > 0 && (w - w.transpose()).cwiseAbs().maxCoeff() > 1e-8 * w.cwiseAbs().maxCoeff())
    throw std::invalid_argument("W is not symmetric");
}

Vector3d nearest_in_cone(const Vector3d& x, double mu) {
  const double across = std::hypot(x[1], x[2]);
  if (across <= mu * x[0]) return x;
  if (mu * across <= -x[0]) return Vector3d::Zero();
  const double normal = (mu * across + x[0]) / (1 + mu * mu);
  return {normal, mu * normal * x[1] / across, mu * normal * x[2] / across};
}

VectorXd contact_scales(const Eigen::MatrixXd& w) {
  VectorXd scales(w.rows() / 3);
  for (Index c = 0; c < scales.size(); ++c) {
    const double trace = w.diagonal().segment<3>(3 * c).sum();
    scales[c] = trace > 0 ? std::sqrt(3 / trace) : 1;
  }
  return scales;
}

Residual residual(const ContactProblem& problem, const VectorXd& impulse) {
  const VectorXd scales = contact_scales(problem.w), velocity = problem.velocity(impulse);
  double sum = 0, size = 0, load = 0;
  Residual worst;
  for (Index c = 0; c < problem.contacts(); ++c) {
    const double mu = problem.mu[c], d = scales[c];
    const Vector3d r = impulse.segment<3>(3 * c) / d;
    Vector3d u = d * velocity.segment<3>(3 * c);
    u[0] += mu * std::hypot(u[1], u[2]);
    sum += (r - nearest_in_cone(r - u, mu)).squaredNorm();
    load += r.squaredNorm();
    size += (d * problem.q.segment<3>(3 * c)).squaredNorm();
    worst.primal = std::max(worst.primal, (r - nearest_in_cone(r, mu)).norm());
    // Moreau: u = P_K*(u) - P_K(-u).
    worst.dual = std::max(worst.dual, nearest_in_cone(-u, mu).norm());
    worst.complementarity = std::max(worst.complementarity, std::abs(r.dot(u)));
  }
  const double unit = size > 0 ? std::sqrt(size) : 1;
  worst.natural_map = std::sqrt(sum) / unit;
  worst.primal /= unit;
  worst.dual /= unit;
  worst.complementarity /= unit * std::max(unit, std::sqrt(load));
  return worst;
}

}  // namespace plumb::reference
