// The solver "xpbd": sub-steps of position-based dynamics.
#pragma once

#include "constraints/contact_friction.hpp"
#include "constraints/contact_position.hpp"
#include "constraints/joint_position.hpp"
#include "solver/axis_mechanisms.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// Extended position-based dynamics in sub-steps of one pass each (M. Mueller, M. Macklin, N. Chentanez, S. Jeschke,
/// T.-Y. Kim, "Detailed Rigid Body Simulation with Extended Position Based Dynamics", SCA 2020, algorithm 2): bodies
/// move freely, constraints of no compliance put them back, and a pass over velocities sees to restitution and to
/// friction of what slides. Unlike there, friction at the level of positions is cut to the cone and not refused beyond
/// it: one point of a face would always be beyond, and a cube at rest on a slope would creep.
template <JointCode kJoints, bool kBelts>
struct StepPositions : SolverStep {
  PLUMB_DEVICE void operator()(Team& team) const {
    if (must_repeat()) return;
    const StepPositions self = *this;
    const StepParameters step = *parameters;
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      team.each(body_count, [=](std::uint32_t i) { integrate_velocity(self.bodies, self.solver, step, true, i); });
      move_bodies(team, step);
      correct_joints(team, step, k == 0);
      if (!features.collision) continue;
      solve_positions(team, step);
      solve_velocities(team, step);
    }
    finish(team);
  }

 private:
  PLUMB_DEVICE void correct_joints(Team& team, const StepParameters& step, [[maybe_unused]] bool first) const {
    if constexpr (kJoints == JointCode::kAll) {
      const AxisView view = axis_view(joints);
      for_joints(team, joints, [=](std::uint32_t j) { correct_axis_joint(view, j, step, first); });
    } else {
      const JointView view = joints.view;
      for_joints(team, joints, [=](std::uint32_t j) { correct_joint(view, j, step); });
    }
  }
  PLUMB_DEVICE void solve_positions(Team& team, const StepParameters& step) const {
    const bool friction = features.friction, note_impacts = features.restitution;
    for_contacts<kBelts>(team, contacts, solver, BodyUse::kAll, [=](const auto& row, auto& contact, auto& a, auto& b) {
      start_contact_position(contact, a, b, step);
      const auto a_linear = a.linear, a_angular = a.angular, b_linear = b.linear, b_angular = b.angular;
      solve_contact(row, contact, a, b, friction, note_impacts);
      if (note_impacts) store_impact_speeds(row, contact);
      displace(a, a_linear, a_angular, step.h);
      displace(b, b_linear, b_angular, step.h);
    });
  }
  PLUMB_DEVICE void solve_velocities(Team& team, const StepParameters& step) const {
    const Real slowest = step.restitution_speed;
    const bool friction = features.friction;
    for_contacts<kBelts>(team, contacts, solver, BodyUse::kVelocity,
                         [=](const auto& row, auto& contact, auto& a, auto& b) {
                           start_contact_velocity(contact, slowest);
                           solve_contact(row, contact, a, b, friction, false);
                           add_up_impulses(row, contact.impulse);
                         });
  }
  template <int P, class N>
  PLUMB_HD static void solve_contact(const RowAccess<N>& row, Contact<P, N>& contact, SolverBody<N>& a,
                                     SolverBody<N>& b, bool friction, bool note_impacts) {
    const ManifoldAim<P, N> aim = aim_hard(contact);
    ContactMotion<N> motion = motion_of(contact, a, b);
    ContactWrench<N> wrench = no_wrench<N>();
    solve_normals(contact, aim, motion, wrench, note_impacts);
    const auto held = N(1) < N(0);  // no normals follow that could
    if (friction) solve_friction(contact, motion, wrench, held);
    push(contact, wrench, a, b);
    store_impulses(row, contact);
  }
};

}  // namespace plumb::impulse
