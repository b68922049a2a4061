// Energy and momentum of bodies from their rows and masses, and accounts of them over time (metrics 2 to 4).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "referee/mass.hpp"

namespace plumb::referee {

/// One body at one instant. Mass 0: static or kinematic; carries no energy or momentum.
struct BodyState {
  Mass mass;
  Pose pose;                    ///< of the body frame
  Vec3 linear = Vec3::Zero();   ///< of the centre of mass, m/s
  Vec3 angular = Vec3::Zero();  ///< rad/s, world axes

  [[nodiscard]] Vec3 centre() const { return pose * mass.centre; }  ///< of mass, world
  [[nodiscard]] Mat3 inertia() const {
    return pose.rotation * mass.inertia * pose.rotation.transpose();
  }  ///< world axes
  [[nodiscard]] Vec3 velocity_at(const Vec3& point) const { return linear + angular.cross(point - centre()); }
  [[nodiscard]] Vec3 momentum() const { return mass.mass * linear; }
  [[nodiscard]] Vec3 spin() const { return inertia() * angular; }  ///< angular momentum about the centre of mass
};

/// From any rows with members position, orientation and linear, angular (PlumbVec3, PlumbQuat).
template <class PoseRow, class VelocityRow>
[[nodiscard]] BodyState body_state(const Mass& mass, const PoseRow& where, const VelocityRow& velocity) {
  return {mass, pose(where.position, where.orientation), vec(velocity.linear), vec(velocity.angular)};
}
template <class PoseRow, class VelocityRow>
[[nodiscard]] std::vector<BodyState> body_states(std::span<const Mass> masses, std::span<const PoseRow> poses,
                                                 std::span<const VelocityRow> velocities) {
  std::vector<BodyState> states;
  states.reserve(masses.size());
  for (std::size_t i = 0; i < masses.size(); ++i) states.push_back(body_state(masses[i], poses[i], velocities[i]));
  return states;
}

struct Energy {
  double linear = 0;      ///< sum m v^2 / 2, J
  double rotational = 0;  ///< sum w . I w / 2
  double potential = 0;   ///< -sum m g . (x - datum), with each centre of mass x
  double spring = 0;      ///< as passed in

  [[nodiscard]] double kinetic() const { return linear + rotational; }
  [[nodiscard]] double total() const { return linear + rotational + potential + spring; }
};
/// gravity m/s2; datum: where the potential is 0, m; spring: of joints and the like, J, as the caller knows it.
[[nodiscard]] Energy energy(std::span<const BodyState> bodies, const Vec3& gravity, const Vec3& datum = Vec3::Zero(),
                            double spring = 0);

[[nodiscard]] double total_mass(std::span<const BodyState> bodies);
[[nodiscard]] Vec3 linear_momentum(std::span<const BodyState> bodies);
/// About a point of the world.
[[nodiscard]] Vec3 angular_momentum(std::span<const BodyState> bodies, const Vec3& about = Vec3::Zero());
/// sum |m v|: what a closed system's momentum drift is measured against.
[[nodiscard]] double sum_of_momenta(std::span<const BodyState> bodies);

/// Energy over time. Injection and drift hide each other, so both are kept.
class EnergyAccount {
 public:
  /// The energy after a step; work: what the host's forces, motors and kinematic bodies did in it. The first call is
  /// the start. J.
  void add(double total, double work = 0);
  [[nodiscard]] double injected() const { return injected_; }              ///< sum over steps of max(0, dE - work), J
  [[nodiscard]] double lost() const { return lost_; }                      ///< sum over steps of max(0, work - dE), J
  [[nodiscard]] double drift() const { return last_ - first_ - work_; }    ///< E - E0 - all work, J
  [[nodiscard]] double largest_rise() const { return highest_ - first_; }  ///< max over time of E - E0 - work so far, J

 private:
  std::optional<double> start_;
  double first_ = 0, last_ = 0, work_ = 0, injected_ = 0, lost_ = 0, highest_ = 0;
};

/// Momentum of the world over one step: P+ - P- - h M g - impulses, and the same for angular momentum about a point.
struct MomentumBalance {
  Vec3 linear;   ///< N s that nothing accounts for
  Vec3 angular;  ///< N m s, about `about`
};
struct ExternalImpulse {
  Vec3 impulse;  ///< N s on the moving bodies, from static or kinematic ones, joints to the world, or the host
  Vec3 point;    ///< world, m
};
/// Gravity's torque acts at the centres of mass before the step. gravity_scale is taken to be 1.
[[nodiscard]] MomentumBalance momentum_balance(std::span<const BodyState> before, std::span<const BodyState> after,
                                               const Vec3& gravity, double dt,
                                               std::span<const ExternalImpulse> impulses,
                                               const Vec3& about = Vec3::Zero());

}  // namespace plumb::referee
