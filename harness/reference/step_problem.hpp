// The contact problem of one time step of rigid bodies: velocities before, forces, contacts -> W, q and back to the
// bodies' velocities. Global form: M (v - v_free) = H^T r, u = H v + w (Acary, Bremond & Huber 2018, section 2).
#pragma once

#include <span>
#include <vector>

#include "referee/mechanics.hpp"
#include "reference/contact_problem.hpp"

namespace plumb::reference {

/// Where two bodies touch, or will within the step.
struct StepContact {
  std::size_t body_a, body_b;  ///< indices of states
  referee::Vec3 point;         ///< world, m
  referee::Vec3 normal;        ///< unit, from a to b
  double friction;             ///< of the pair
  /// Added to the normal velocity: gap / dt where the surfaces are apart (they may close the gap), restitution times
  /// the normal velocity before the step (< 0) where they bounce. m/s
  double bias = 0;
};

/// How a step goes on without contacts: v + dt g, and the spin's gyroscopic term by one explicit Euler step.
struct StepForces {
  referee::Vec3 gravity = referee::Vec3::Zero();  ///< m/s2
  double dt = 1.0 / 60;                           ///< s
  bool gyroscopic = false;                        ///< whether -w x I w acts
};

class StepProblem {
 public:
  /// States before the step. Bodies of mass 0 keep their velocity; inertia 0 cannot turn.
  StepProblem(std::span<const referee::BodyState> before, std::vector<StepContact> contacts, const StepForces& forces);

  [[nodiscard]] const ContactProblem& problem() const { return problem_; }
  [[nodiscard]] const std::vector<StepContact>& contacts() const { return contacts_; }
  /// Rows 0..2 of a contact: its normal and two tangents.
  [[nodiscard]] const Eigen::Matrix3d& frame(std::size_t contact) const { return frames_[contact]; }

  /// Velocities of all bodies with no impulse at the contacts: six numbers a body, linear then angular.
  [[nodiscard]] const Eigen::VectorXd& free_velocity() const { return free_; }
  /// The same with these impulses: what is unique also where the impulses are not.
  [[nodiscard]] Eigen::VectorXd velocity_after(const Eigen::VectorXd& impulse) const;
  /// What the contacts give each body: linear (N s) and angular impulse about its centre of mass (N m s).
  [[nodiscard]] Eigen::VectorXd impulse_on_bodies(const Eigen::VectorXd& impulse) const;
  /// The change of velocity that such impulses on bodies make.
  [[nodiscard]] Eigen::VectorXd velocity_of(const Eigen::VectorXd& on_bodies) const;

 private:
  ContactProblem problem_;
  std::vector<StepContact> contacts_;
  std::vector<Eigen::Matrix3d> frames_;
  Eigen::MatrixXd h_;                                  ///< from velocities of bodies to those at contacts
  std::vector<Eigen::Matrix<double, 6, 6>> mobility_;  ///< M^-1 of each body
  Eigen::VectorXd free_;
};

}  // namespace plumb::reference
