// What the laws of contact say about an engine's impulses (metrics 3, 5 to 8 and 10). The impulses are the engine's,
// since only it knows them; the velocities are taken from the state that it delivered, at the points that it named.
#pragma once

#include <cstdint>
#include <span>

#include "plumb/world.h"
#include "referee/mechanics.hpp"

namespace plumb::referee {

/// One contact with its bodies after the step and the pair's coefficients.
struct ContactSample {
  const PlumbContact* contact;
  const BodyState* a;
  const BodyState* b;
  double friction;            ///< of the pair
  double restitution = 0;     ///< of the pair
  double approach_speed = 0;  ///< m/s: normal speed before the step, for restitution; >= 0 is approaching
};

/// Normalisers of a scene: an impulse (sum m g h), a speed (sqrt(g L)) and a length (a typical side).
struct Scale {
  double impulse = 1;  ///< W, N s
  double speed = 1;    ///< v0, m/s
  double length = 1;   ///< L, m
};
[[nodiscard]] Scale scale_of(double total_mass, double gravity, double dt, double length);

/// Relative velocity of b against a at the contact, split along the normal.
struct Slip {
  double normal;  ///< u_n, m/s: above 0 is parting
  Vec3 tangent;   ///< u_t, m/s
};
[[nodiscard]] Slip slip_of(const ContactSample& sample);

/// Metric 6: max(0, |l_t| - mu l_n) / (mu l_n + 1e-9 W).
[[nodiscard]] double cone_violation(const ContactSample& sample, const Scale& scale);
/// The nearest impulse inside Coulomb's cone about n (projection in the plane of l_n and |l_t|).
[[nodiscard]] Vec3 project_on_cone(const Vec3& impulse, const Vec3& normal, double friction);
/// Metric 7, for slipping contacts: 0 friction opposes slip with all it may, 1 it does no work, 2 it drives. NaN when
/// the contact does not slip faster than `least_slip` or carries no load.
[[nodiscard]] double dissipation_defect(const ContactSample& sample, double least_slip);
/// Metric 8: |lambda . u^| / (W v0) with De Saxce's u^ = u + e u- + mu |u_t| n.
[[nodiscard]] double complementarity(const ContactSample& sample, const Scale& scale);

/// Worst and mean over the contacts of one step. Contacts without known impulses are counted and left out.
struct ContactQuality {
  std::uint32_t contacts = 0;
  std::uint32_t without_impulse = 0;
  double cone_max = 0;             ///< metric 6
  double cone_distance_max = 0;    ///< |lambda - P_K(lambda)| / W
  double signorini_speed_max = 0;  ///< l_n max(0, u_n - e approach) / (W v0)
  double signorini_gap_max = 0;    ///< l_n max(0, gap) / (W L)
  double pull_max = 0;             ///< max(0, -l_n) / W: contacts that stick
  double dissipation_mean = 0;     ///< metric 7 over slipping contacts, weighted by mu l_n |u_t|; NaN when none slips
  double creep_max = 0;            ///< |u_t| / v0 of contacts inside their cone
  double complementarity_max = 0;  ///< metric 8
};
[[nodiscard]] ContactQuality contact_quality(std::span<const ContactSample> contacts, const Scale& scale,
                                             double least_slip_of_speed = 1e-3);

/// Impulse that bodies without mass (static, kinematic) gave to those with mass through these contacts, and where: the
/// input of momentum_balance.
[[nodiscard]] std::vector<ExternalImpulse> ground_impulses(std::span<const ContactSample> contacts);
/// Metric 10: |sum of the ground's impulses + h M g| / (h M |g|): 0 for a scene at rest.
[[nodiscard]] double ground_balance(std::span<const ContactSample> contacts, double total_mass, const Vec3& gravity,
                                    double dt);
/// Metric 4 for one body without joints: |change of momentum - h m g - its contacts' impulses| / W, and the same for
/// spin divided by L. `body` must be the address that the samples carry.
[[nodiscard]] double body_balance(const BodyState& before, const BodyState& body,
                                  std::span<const ContactSample> contacts, const Vec3& gravity, double dt,
                                  const Scale& scale);

}  // namespace plumb::referee
