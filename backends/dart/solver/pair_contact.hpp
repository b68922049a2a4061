// DART's own contact constraint with the pair's material: DART takes the lesser friction of two shapes and the product
// of their restitutions, and its error reduction is the same for all worlds of a process.
#pragma once

#include <dart/collision/Contact.hpp>
#include <dart/constraint/ContactConstraint.hpp>

#include "dart_math.hpp"
#include "settings.hpp"

namespace plumb::dart6 {

/// Of two surfaces that touch.
struct PairMaterial {
  double friction, restitution;
  Eigen::Vector3d slide;  ///< m/s, world axes: what the first's surface does beyond the second's, beside their bodies
};

class PairContact final : public ::dart::constraint::ContactConstraint {
 public:
  /// contact: has to outlive it; DART writes the force into it, on the first body. h: s, of the sub-step.
  PairContact(::dart::collision::Contact& contact, const PairMaterial& material, const Settings& settings, double h);

  void getInformation(::dart::constraint::ConstraintInfo* info) override;
  void applyUnitImpulse(std::size_t index) override;
  void getVelocityChange(double* change, bool with_softness) override;

 private:
  [[nodiscard]] double wanted_speed(double closing, double rate) const;

  const ::dart::collision::Contact& contact_;
  PairMaterial material_;
  const Settings& settings_;
  double inverse_mass_;  ///< 1/kg, of what impulses move
  std::size_t applied_ = 0;
};

}  // namespace plumb::dart6
