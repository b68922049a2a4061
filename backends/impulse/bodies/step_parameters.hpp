// What one step works with: written by the host before the step, read by kernels.
#pragma once

#include <cstdint>

#include "math/vec3.hpp"

namespace plumb::impulse {

/// A spring and damper as three numbers, so that it stays stable however stiff: Catto, "Soft Constraints", GDC 2011.
struct Softness {
  Real bias_rate;      ///< how fast an error is taken back, 1/s
  Real mass_scale;     ///< of the effective mass
  Real impulse_scale;  ///< of the accumulated impulse, taken off again
  Real gamma = 0;      ///< impulse_scale over mass_scale
};

/// Of what is as stiff as can be, and takes errors back at that rate, 1/s.
PLUMB_HD constexpr Softness rigid(Real bias_rate) { return {bias_rate, 1, 0, 0}; }

/// Softness of a damped spring of `hertz` and damping ratio `zeta` in steps of h seconds.
inline Softness make_softness(double hertz, double zeta, double h) {
  if (hertz <= 0) return {0, 1, 0, 0};
  const double omega = 2 * 3.14159265358979323846 * hertz;
  const double a1 = 2 * zeta + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
  return {static_cast<Real>(omega / a1), static_cast<Real>(a2 * a3), static_cast<Real>(a3), static_cast<Real>(1 / a2)};
}

/// Masses are alike where none is so many times another.
constexpr Real kAlikeMasses = 5;
template <class N>
PLUMB_HD auto alike_masses(const N& a, const N& b) {
  return N(kAlikeMasses) * min(a, b) > max(a, b);
}

/// How constraints are solved: the word of the setting "solver".
enum class SolverKind : std::uint32_t { kTgsSoft, kSequential, kJacobi, kPosition };

/// The solvers that have passes make no more of them in a step.
constexpr std::uint32_t kMostPasses = 1000;

/// What depends on the length of a sub-step.
struct SubstepParameters {
  std::uint32_t level;  ///< its number among SubstepLevels
  std::uint32_t substeps;
  std::uint32_t relaxations;  ///< passes over the contacts after the positions have moved
  Real h;                     ///< s, one sub-step
  Real inverse_h;             ///< 1/s
  Softness contact;           ///< between two bodies that move, of like masses
  Softness loaded;            ///< of unlike ones
  Softness ground;            ///< against a body that does not
  Softness joint;             ///< of joints that are solved one by one
  Real joint_rate;            ///< errors of mechanisms that are solved as a whole are taken back at this rate, 1/s
  Real chain_rate;            ///< those of long mechanisms no faster than at this one
  // Where all bodies have the same sub-steps; else each body knows (SolverBodies):
  Real warm_start;  ///< share of the last step's impulses that is kept: its sub-step to this one's, or 0
  Real shortened;   ///< this sub-step over the last one, squared
};

/// Kinds of sub-steps that islands of one step may have: so many lengths, and those of small and of large stars.
constexpr std::uint32_t kSubstepLengths = 5, kStarLevel = kSubstepLengths, kSubstepLevels = kStarLevel + 2;

/// In what sub-steps an island may be solved: its loads choose (solver/choose_substeps.hpp). Hierarchical time-step
/// levels: McMillan, "The Vectorization of Small-N Integrators", 1986.
struct SubstepLevels {
  /// Those of the setting first, each shorter than the one before; at last those of stars (solver/stars.hpp): as long
  /// as the first, with more relaxations.
  SubstepParameters of[kSubstepLevels];
  std::uint32_t count;  ///< of lengths that may be chosen; with one of them stars are solved as all others are
};

struct StepParameters : SubstepParameters {
  Vec gravity;                   ///< m/s2
  Real dt;                       ///< s
  std::uint32_t step;            ///< number of this step; steps count from 1
  bool may_be_taken_back;        ///< where it makes energy, to be gone in parts
  bool is_repeat;                ///< rows of joints have not held, or were opened (solver/energy_bound.hpp)
  bool is_later_part;            ///< of a step that is gone in parts
  bool lets_go;                  ///< what may have squeezed bodies is gone or another (contacts/match.cpp)
  Real max_depenetration_speed;  ///< overlap is taken back no faster than this, m/s
  bool relaxes_once;             ///< in a step, and not in each sub-step
  bool warm_starting;            ///< from the impulses of the last step
  Real restitution_speed;        ///< slower impacts do not bounce, m/s
  Position origin;               ///< of the bounds

  Real sleep_speed;              ///< a body that is slower rests, m/s
  Real sleep_time;               ///< an island that has rested for so long falls asleep, s
  std::uint32_t woken_contacts;  ///< how many were put aside in sleep and are to be matched in this step

  SolverKind solver;
  // Of the solvers that take the step whole:
  std::uint32_t passes;  ///< over all constraints, at most
  Real stop_below;       ///< largest change of an impulse in a pass, relative to the largest impulse; 0: never stop
  Real bias_rate;        ///< share of the overlap beyond the slop that is taken back, 1/s
  Real slop;             ///< overlap that is let be, m
};

}  // namespace plumb::impulse
