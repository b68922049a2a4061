#include "reference/solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "plumb/assert.hpp"
#include "reference/one_contact.hpp"

namespace plumb::reference {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The problem with its contacts brought to one scale (see Residual) and |q| to 1.
struct Scaled {
  ContactProblem problem;
  VectorXd factors;  ///< impulses of the problem as given are these times the scaled ones
};

Scaled scaled(const ContactProblem& given) {
  const VectorXd scales = contact_scales(given.w);
  VectorXd rows(given.q.size());
  for (Index c = 0; c < scales.size(); ++c) rows.segment<3>(3 * c).setConstant(scales[c]);
  Scaled result{{rows.asDiagonal() * given.w * rows.asDiagonal(), rows.cwiseProduct(given.q), given.mu}, rows};
  result.problem.w = (result.problem.w + result.problem.w.transpose()).eval() / 2;
  const double size = result.problem.q.norm();
  PLUMB_ASSERT(size > 0);
  result.problem.q /= size;
  result.factors *= size;
  return result;
}

/// One round over all contacts, forth or back.
void sweep(const ContactProblem& problem, VectorXd& impulse, VectorXd& velocity, bool forth) {
  const Index count = problem.contacts();
  for (Index k = 0; k < count; ++k) {
    const Index at = 3 * (forth ? k : count - 1 - k);
    const Matrix3d own = problem.w.block<3, 3>(at, at);
    if (own(0, 0) <= 0) continue;  // between bodies that cannot move
    const Vector3d before = impulse.segment<3>(at);
    // A contact whose bodies cannot be moved in some direction has a singular block; this little does not hurt others.
    const Matrix3d regular = own + 1e-12 * Matrix3d::Identity();
    const Vector3d free = velocity.segment<3>(at) - own * before;
    const Vector3d now = solve_one_contact(regular, free, problem.mu[at / 3], before);
    impulse.segment<3>(at) = now;
    velocity += problem.w.middleCols<3>(at) * (now - before);
  }
}

/// Alart and Curnier's projection of y = r - u and its derivative: the normal part on y_n >= 0, the tangential part on
/// the disc of radius mu y_n. r solves the problem where r is its own projection.
struct Projection {
  Vector3d value = Vector3d::Zero();
  Matrix3d derivative = Matrix3d::Zero();

  Projection(const Vector3d& y, double mu) {
    PLUMB_ASSERT(mu >= 0);
    if (y[0] <= 0) return;
    value[0] = y[0];
    derivative(0, 0) = 1;
    const double across = std::hypot(y[1], y[2]), radius = mu * y[0];
    if (across <= radius) {
      value.tail<2>() = y.tail<2>();
      derivative.bottomRightCorner<2, 2>().setIdentity();
      return;
    }
    const Eigen::Vector2d direction = y.tail<2>() / across;
    value.tail<2>() = radius * direction;
    derivative.block<2, 1>(1, 0) = mu * direction;
    derivative.bottomRightCorner<2, 2>() =
        radius / across * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  }
};

struct Equation {
  VectorXd value;
  MatrixXd jacobian;
};

VectorXd equation_value(const ContactProblem& problem, const VectorXd& impulse) {
  const VectorXd y = impulse - problem.velocity(impulse);
  VectorXd value(impulse.size());
  for (Index c = 0; c < problem.contacts(); ++c)
    value.segment<3>(3 * c) = impulse.segment<3>(3 * c) - Projection(y.segment<3>(3 * c), problem.mu[c]).value;
  return value;
}

/// F = r - G(r - u) and F' = I - G' + G' (W + proximal I).
Equation equation(const ContactProblem& problem, const VectorXd& impulse, double proximal) {
  const VectorXd y = impulse - problem.velocity(impulse);
  Equation result{VectorXd(impulse.size()), MatrixXd(impulse.size(), impulse.size())};
  for (Index c = 0; c < problem.contacts(); ++c) {
    const Index at = 3 * c;
    const Projection projected(y.segment<3>(at), problem.mu[c]);
    result.value.segment<3>(at) = impulse.segment<3>(at) - projected.value;
    result.jacobian.middleRows<3>(at).noalias() = projected.derivative * problem.w.middleRows<3>(at);
    result.jacobian.block<3, 3>(at, at) += Matrix3d::Identity() - (1 - proximal) * projected.derivative;
  }
  return result;
}

/// The best impulses so far, by the natural map.
struct Best {
  const ContactProblem& problem;
  VectorXd impulse;
  double value;

  bool offer(const VectorXd& other) {
    const double now = other.allFinite() ? residual(problem, other).natural_map : INFINITY;
    if (!(now < value)) return false;
    PLUMB_ASSERT(other.size() == problem.q.size());
    value = now;
    impulse = other;
    return true;
  }
};

/// Newton's method from `impulse`, damped so that |F| falls below the largest of its last values (Grippo, Lampariello &
/// Lucidi 1986). Ends when it is there, or gets no further.
int newton(Best& best, VectorXd impulse, double tolerance) {
  constexpr int most_iterations = 40, memory = 5;
  const ContactProblem& problem = best.problem;
  double proximal = 1e-7;
  std::vector<double> last;
  int iterations = 0;
  for (; iterations < most_iterations && best.value > tolerance; ++iterations) {
    const Equation now = equation(problem, impulse, proximal);
    last.push_back(now.value.norm());
    const double allowed = *std::max_element(last.size() > memory ? last.end() - memory : last.begin(), last.end());
    const VectorXd step = now.jacobian.partialPivLu().solve(-now.value);
    if (!step.allFinite()) {
      proximal *= 100;
      if (proximal > 1e-2) break;
      continue;
    }
    double share = 1;
    VectorXd next = impulse + step;
    while (share > 1e-3 && !(equation_value(problem, next).norm() <= (1 - 1e-4 * share) * allowed)) {
      share /= 2;
      next = impulse + share * step;
    }
    if (share <= 1e-3) {
      proximal *= 100;
      if (proximal > 1e-2) break;
      continue;
    }
    impulse = next;
    best.offer(impulse);
  }
  return iterations;
}

/// All contacts held, as far as their cones allow: where stacks at rest end.
VectorXd all_held(const ContactProblem& problem) {
  const Index size = problem.q.size();
  const MatrixXd regular = problem.w + 1e-9 * MatrixXd::Identity(size, size);
  return regular.ldlt().solve(-problem.q);
}

struct Effort {
  int sweeps = 0, newton_iterations = 0;
};

/// Sweeps from `impulse` on, which is left where they end, then Newton's method from there.
void approach(Best& best, VectorXd& impulse, int sweeps, double tolerance, Effort& effort) {
  VectorXd velocity = best.problem.velocity(impulse);
  for (int i = 0; i < sweeps && best.value > tolerance; ++i, ++effort.sweeps) {
    sweep(best.problem, impulse, velocity, i % 2 == 0);
    if (i % 10 == 9) best.offer(impulse);
  }
  if (best.value > tolerance) effort.newton_iterations += newton(best, impulse, tolerance);
}

/// Proximal points: r_k+1 solves the problem of W + a I and q - a r_k, which is far better conditioned; where they
/// stand still the problem itself is solved (Rockafellar 1976; for contacts Acary, Bremond & Huber 2018, section 5.5).
void proximal_points(Best& best, VectorXd& impulse, double weight, double tolerance, Effort& effort) {
  constexpr int most_points = 40, sweeps = 20;
  ContactProblem nearer = best.problem;
  nearer.w.diagonal().array() += weight;
  for (int k = 0; k < most_points && best.value > tolerance; ++k) {
    nearer.q = best.problem.q - weight * impulse;
    Best inner{nearer, impulse, residual(nearer, impulse).natural_map};
    VectorXd sweeping = impulse;
    approach(inner, sweeping, sweeps, tolerance / 10, effort);
    impulse = inner.impulse;
    best.offer(impulse);
  }
}

}  // namespace

Solution solve(const ContactProblem& problem, const SolverOptions& options) {
  problem.check();
  Solution solution;
  const Index size = problem.q.size();
  solution.impulse = VectorXd::Zero(size);
  if (size > 0 && problem.q.norm() > 0) {
    const Scaled work = scaled(problem);
    const double tolerance = options.tolerance / 2;  // the rest is for the rounding of scaling back
    VectorXd impulse = VectorXd::Zero(size);
    Best best{work.problem, impulse, residual(work.problem, impulse).natural_map};
    Effort effort;
    int sweeps = 20;
    double weight = 0.1;
    for (int round = 0; round < options.rounds && best.value > tolerance; ++round, sweeps *= 2, weight /= 4) {
      approach(best, impulse, sweeps, tolerance, effort);
      if (round == 0 && best.value > tolerance)
        effort.newton_iterations += newton(best, all_held(work.problem), tolerance);
      if (round > 0) proximal_points(best, impulse, weight, tolerance, effort);
    }
    solution.impulse = work.factors.cwiseProduct(best.impulse);
    solution.sweeps = effort.sweeps;
    solution.newton_iterations = effort.newton_iterations;
  }
  PLUMB_ASSERT(solution.impulse.allFinite());
  solution.velocity = problem.velocity(solution.impulse);
  solution.residual = residual(problem, solution.impulse);
  solution.converged = solution.residual.natural_map <= options.tolerance;
  return solution;
}

}  // namespace plumb::reference
