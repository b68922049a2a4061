// The frictional contact problem of one time step with circular cones, and how far an answer is from solving it.
//
// With the bodies' velocities eliminated, the relative velocities at the contacts are u = W r + q, where W = H M^-1 H^T
// and q = H v_free + w holds the free velocities and what is asked of each contact (restitution, gaps). Signorini's and
// Coulomb's laws are, after De Saxce & Feng 1998 ("The bipotential method", Math. Comput. Modelling 28), one
// complementarity of cones: with u^ = u + mu |u_t| n,
//   r in K, u^ in K*, r . u^ = 0,   K = {|r_t| <= mu r_n}.
// Notation and existence: Acary, Bremond & Huber 2018, "On solving contact problems with Coulomb friction".
#pragma once

#include <Eigen/Core>

namespace plumb::reference {

/// Three rows a contact: normal, then two tangents. Velocities in m/s and impulses in N s, or any other units that
/// agree: nothing here depends on them.
struct ContactProblem {
  Eigen::MatrixXd w;  ///< symmetric, positive semidefinite
  Eigen::VectorXd q;
  Eigen::VectorXd mu;  ///< one a contact, >= 0

  [[nodiscard]] Eigen::Index contacts() const { return mu.size(); }
  [[nodiscard]] Eigen::VectorXd velocity(const Eigen::VectorXd& impulse) const { return w * impulse + q; }
  /// Throws std::invalid_argument that names what does not fit: sizes, numbers that are not finite, mu below 0, W not
  /// symmetric.
  void check() const;
};

/// The point of the cone K of friction mu that is nearest to x (normal first).
[[nodiscard]] Eigen::Vector3d nearest_in_cone(const Eigen::Vector3d& x, double mu);

/// What proves an answer: each is 0 exactly where the impulses solve the problem. Contacts are first brought to one
/// scale: r_c / d_c and d_c u_c with d_c = sqrt(3 / trace W_cc), which keeps the cones; then all is relative to |q|. So
/// no change of units, of sizes or of the number of contacts moves them.
struct Residual {
  double natural_map = 0;      ///< |r - P_K(r - u^)|, the norm over all contacts: what FCLIB scores by
  double primal = 0;           ///< worst distance of r from K
  double dual = 0;             ///< worst distance of u^ from K*
  double complementarity = 0;  ///< worst |r . u^|, relative to |q| and the larger of |q| and |r|
};
[[nodiscard]] Residual residual(const ContactProblem& problem, const Eigen::VectorXd& impulse);

/// The factors d_c. 1 where W_cc is 0, as between two bodies that cannot move.
[[nodiscard]] Eigen::VectorXd contact_scales(const Eigen::MatrixXd& w);

}  // namespace plumb::reference
