// The solver "xpbd": sub-steps of position-based dynamics.
#pragma once

#include "joints/joint_position.hpp"
#include "joints/mechanisms.hpp"
#include "solver/impacts.hpp"
#include "solver/position_contacts.hpp"

namespace plumb::impulse {

/// Extended position-based dynamics in sub-steps of one pass each (M. Mueller, M. Macklin, N. Chentanez, S. Jeschke,
/// T.-Y. Kim, "Detailed Rigid Body Simulation with Extended Position Based Dynamics", SCA 2020, algorithm 2): bodies
/// move freely, constraints of no compliance put them back, and a pass over velocities sees to friction of what slides.
/// Unlike there, what strikes is thrown back before it moves, and friction at the level of positions is cut to the cone
/// and not refused beyond it: one point of a face would always be beyond, and a cube at rest on a slope would creep.
template <JointCode kJoints, bool kSurfaceEffects>
struct StepPositions : PositionContacts<kSurfaceEffects> {
  PLUMB_DEVICE void operator()(Team& team) const {
    if (this->must_repeat()) return;
    const SolverStep self = *this;
    const StepParameters step = *this->parameters;
    std::uint32_t round = 0;  // of impacts
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      this->accelerate_bodies(team, step, true);
      if (self.features.collision && self.features.restitution)
        solve_impacts<kSurfaceEffects, false>(team, self, step, round);
      this->move_bodies(team, step);
      correct_joints(team, step, k == 0);
      if (!self.features.collision) continue;
      this->solve_positions(team, step);
      this->solve_velocities(team);
    }
    this->finish(team);
  }

 private:
  PLUMB_DEVICE void correct_joints(Team& team, const StepParameters& step, bool first) const {
    const auto view = view_of<kJoints>(this->joints);
    for_joints(team, this->joints, [=](std::uint32_t j) { correct(view, j, step, first); });
  }
};

}  // namespace plumb::impulse
