// States of single bodies of a simulation in the referee's terms.
#pragma once

#include "measure/measure.hpp"
#include "referee/mechanics.hpp"

namespace plumb::harness {

/// A shape of the scene, by index, as the referee sees it.
[[nodiscard]] referee::ShapePtr shape_of(const Scene& scene, std::size_t index);

/// Mass properties of a body as its scene describes them, by the referee's own formulas.
[[nodiscard]] referee::Mass mass_of_body(const Scene& scene, std::size_t body);

/// Pose and velocity of a body as of the last step.
[[nodiscard]] referee::BodyState state_of(Simulation& simulation, std::size_t body, const referee::Mass& mass);

/// A metric whose truth a scheme misses by a known bias: error is against the truth, unbiased_error against what
/// semi-implicit Euler gives, both over `scale`.
void compare_biased(MeasureContext& context, const std::string& name, double value, double truth, double scale,
                    double semi_implicit, const std::string& note = "");

}  // namespace plumb::harness
