// The solver "tgs_soft": sub-steps with soft contacts and relaxation.
#pragma once

#include "constraints/contact_friction.hpp"
#include "solver/axis_mechanisms.hpp"
#include "solver/mechanisms.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// Sub-steps with soft constraints and relaxation ("soft step": Catto, "Solver2D", 2024; sub-stepping after Macklin et
/// al., "Small Steps in Physics Simulation", SCA 2019). In each sub-step velocities are solved with a soft bias against
/// overlap, positions moved, and velocities solved again without the bias, so that what it pushed does not stay.
template <JointCode kJoints, bool kBelts>
struct StepSoftly : SolverStep {
  PLUMB_DEVICE void operator()(Team& team) const {
    if (must_repeat()) return;
    const StepParameters step = *parameters;
    [[maybe_unused]] std::uint32_t turn = 0;
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      const bool first = k == 0;
      team.each(body_count, [&](std::uint32_t i) { integrate_velocity(bodies, solver, step, first, i); });
      if (first) warm_start(team);
      if constexpr (kJoints == JointCode::kPlain) {
        warm_start_mechanisms(team, joints, first, step);
        solve_mechanisms(team, joints, step, true);
      }
      if constexpr (kJoints == JointCode::kAll) {
        warm_start_axes(team, joints, first, step);
        solve_axes(team, joints, step, RowPass::kPlaces, turn);
      }
      const bool relaxes = !step.relaxes_once || k + 1 == step.substeps;
      push_contacts(team, step, !relaxes);
      move_bodies(team, step);
      hold_speeds(team, step, turn);
      if (relaxes) relax_contacts(team);
    }
    if (features.collision && features.restitution) {
      bounce<kBelts>(team, step.restitution_speed);
      hold_speeds(team, step, turn);  // what bounced takes along what it is joined to
    }
    finish(team);
  }

 private:
  PLUMB_DEVICE void hold_speeds(Team& team, const StepParameters& step, [[maybe_unused]] std::uint32_t& turn) const {
    if constexpr (kJoints == JointCode::kPlain) solve_mechanisms(team, joints, step, false);
    if constexpr (kJoints == JointCode::kAll) solve_axes(team, joints, step, RowPass::kSpeeds, turn);
  }
  PLUMB_DEVICE void warm_start(Team& team) const {
    if (!features.collision) return;
    for_contacts(team, contacts, solver, BodyUse::kVelocity,
                 [](const auto& /*row*/, const auto& contact, auto& a, auto& b) { warm_start_contact(contact, a, b); });
  }
  /// Takes overlap back, softly. final: no relaxing pass follows in this sub-step.
  PLUMB_DEVICE void push_contacts(Team& team, const StepParameters& step, bool final) const {
    if (!features.collision) return;
    const ContactSoftness softness = {step.contact, step.ground, step.inverse_h, step.push_speed};
    const bool friction = features.friction, note_impacts = features.restitution;
    for_contacts<kBelts>(team, contacts, solver, BodyUse::kVelocityWhereMoved,
                         [=](const auto& row, auto& contact, auto& a, auto& b) {
                           const auto aim = aim_softly(contact, a, b, softness);
                           solve_contact(contact, aim, a, b, friction, note_impacts);
                           close_pushed(contact);
                           store_impulses(row, contact);
                           if (note_impacts) store_impact_speeds(row, contact);
                           if (final) add_up_impulses(row, contact.impulse);
                         });
  }
  /// After the positions have moved: nothing that touches approaches, and what was pushed does not stay as velocity.
  PLUMB_DEVICE void relax_contacts(Team& team) const {
    if (!features.collision) return;
    const bool friction = features.friction;
    for_contacts<kBelts>(team, contacts, solver, BodyUse::kVelocity,
                         [=](const auto& row, auto& contact, auto& a, auto& b) {
                           solve_contact(contact, aim_hard(contact), a, b, friction, false);
                           store_impulses(row, contact);
                           add_up_impulses(row, contact.impulse);
                         });
  }
  /// Friction below the centre tilts a body: the normals have the first word and the last.
  template <int P, class N>
  PLUMB_HD static void solve_contact(Contact<P, N>& contact, const ManifoldAim<P, N>& aim, SolverBody<N>& a,
                                     SolverBody<N>& b, bool friction, bool note_impacts) {
    ContactMotion<N> motion = motion_of(contact, a, b);
    ContactWrench<N> wrench = no_wrench<N>();
    const auto held = solve_normals(contact, aim, motion, wrench, note_impacts);
    if (friction) {
      solve_friction(contact, motion, wrench, held);
      solve_normals(contact, aim, motion, wrench, note_impacts);
    }
    push(contact, wrench, a, b);
  }
  /// A point that was apart and had to be pushed is no longer free to approach.
  template <int P, class N>
  PLUMB_HD static void close_pushed(Contact<P, N>& contact) {
    contact.open = select(contact.impulse[0] > N(0), N(0), contact.open);
  }
};

}  // namespace plumb::impulse
