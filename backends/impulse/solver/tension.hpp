// What tension in joints asks of a body's inertia, so that a light link under a heavy load does not fly apart.
//
// A joint that pulls with F at an arm r turns its body back towards the line of the force: a spring of stiffness up to
// |F| |r|, the geometric stiffness of the mechanism. It is taken as it was in the sub-step before, and such a spring is
// stable only while its stiffness is below 4 I / h^2. So no moment is less than h^2 |F| |r|: what swings faster than a
// sub-step can follow swings more slowly instead (Andrews, Teichmann, Kry, "Geometric Stiffness for Real-time
// Constrained Multibody Dynamics", Eurographics 2017, section 4, bounds its diagonal likewise; Tournier et al., "Stable
// Constrained Dynamics", SIGGRAPH 2015, on why it is needed). What turns slowly keeps its own inertia. About the arm,
// too, though nothing pulls there: moments that differ much make energy where a body tumbles.
#pragma once

#include "solver/joint_system.hpp"

namespace plumb::impulse {

/// The least moment falls no faster than this, s: tension that comes and goes would pump.
inline constexpr Real kTensionFades = Real(0.25);

/// Of the body at a place of the system. warm_start: a sub-step of this length to the one in which impulses were found.
PLUMB_HD inline void find_least_moment(const JointSystem& system, std::uint32_t place, Real h, Real warm_start,
                                       std::uint32_t step) {
  Real least = 0;
  for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
    const JointOnBody on = system.on_body[k];
    const Joint& joint = system.view.joints[on.joint];
    if (joint.born == step) continue;
    const Real* impulse = system.view.impulses[joint.slot].along;
    Real pull = 0;
    for (int i = 0; i < row_count(joint); ++i)
      if ((joint.pulls >> i & 1U) != 0) pull = pull + impulse[i] * impulse[i];
    least = least + h * warm_start * sqrt(pull * length_squared((on.is_b ? joint.frame_b : joint.frame_a).position));
  }
  Real& kept = system.view.least_moment[system.bodies[place]];
  kept = max(least, max(Real(0), Real(1) - h / kTensionFades) * kept);
}

}  // namespace plumb::impulse
