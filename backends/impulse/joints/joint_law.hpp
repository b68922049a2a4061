// What one row of a joint may do: the impulse along it as a falling function of the speed u along it.
//
//            | lower limit: u cannot be less
//            |
//            '----.  the motor pushes with all its force, and the spring with its own
//                  \ motor's speed: any force between
//                   |
//                   '----.  the motor brakes
//                         |
//                         | upper limit: u cannot be more
//
// A row that always holds has one u. Each piece is a line, so that a row on a known piece is an equation of the
// mechanism's linear system; which piece it is on is found in rounds (a primal-dual active set: Hintermueller, Ito and
// Kunisch, SIAM J. Optim. 13, 2003). The first guess is where the line of the row alone, the impulse over its own mass,
// meets the law; after that a row goes on to the next piece where the solution has left the one that it is on.
#pragma once

#include "bodies/step_parameters.hpp"
#include "joints/joint_axes.hpp"

namespace plumb::impulse {

enum class RowPiece : std::uint8_t {
  kHeld,   ///< always holds
  kLower,  ///< at the lower limit
  kPush,   ///< slower than the motor wants; where there is none, the spring alone or nothing
  kSteady,
  kBrake,
  kUpper
};
/// Whether the speed is known there, and not the impulse by the speed.
PLUMB_HD constexpr bool is_hard(RowPiece piece) { return piece != RowPiece::kPush && piece != RowPiece::kBrake; }

struct RowLaw {
  Real lower, upper;  ///< speeds that the limits allow in this sub-step
  Real steady;        ///< that the motor wants
  Real push;          ///< the most that it gives, N s
  Real spring, drag;  ///< the spring's impulse: spring - drag u
  Real pull = 0;      ///< the most by which a limit may hold back what would leave it, N s

  PLUMB_HD Real sign_of(RowPiece piece) const { return piece == RowPiece::kBrake ? -push : push; }
  /// Speed of a hard piece.
  PLUMB_HD Real speed(RowPiece piece) const {
    return piece == RowPiece::kUpper ? upper : piece == RowPiece::kSteady ? steady : lower;
  }
  /// The first guess: the piece on which the law meets u = now + mobility (impulse - total).
  PLUMB_HD RowPiece piece(Real now, Real total, Real mobility) const {
    const Real free = now - mobility * total, yielding = Real(1) + mobility * drag;
    const Real pushed = (free + mobility * (push + spring)) / yielding;
    const Real braked = (free + mobility * (spring - push)) / yielding;
    const Real u = pushed < steady ? pushed : braked > steady ? braked : steady;
    if (u < lower) return RowPiece::kLower;
    if (u > upper) return RowPiece::kUpper;
    return pushed < steady ? RowPiece::kPush : braked > steady ? RowPiece::kBrake : RowPiece::kSteady;
  }
  PLUMB_HD bool has_limit() const { return lower > -kHuge / 2 || upper < kHuge / 2; }
  PLUMB_HD RowPiece nearer_limit() const { return upper < -lower ? RowPiece::kUpper : RowPiece::kLower; }
  /// Where a row is next that was solved on a piece and came out with that speed and impulse.
  PLUMB_HD RowPiece next(RowPiece piece, Real u, Real total) const {
    if (is_hard(piece)) {
      const Range range = range_of(piece);
      if (piece != RowPiece::kUpper && total < range.least - pull)
        return speed(piece) < steady && piece == RowPiece::kLower ? RowPiece::kPush : RowPiece::kBrake;
      if (piece != RowPiece::kLower && total > range.most + pull)
        return speed(piece) > steady && piece == RowPiece::kUpper ? RowPiece::kBrake : RowPiece::kPush;
      return piece;
    }
    if (piece == RowPiece::kPush && u > steady && steady <= upper)
      return steady < lower ? RowPiece::kBrake : RowPiece::kSteady;
    if (piece == RowPiece::kBrake && u < steady && steady >= lower)
      return steady > upper ? RowPiece::kPush : RowPiece::kSteady;
    return u < lower ? RowPiece::kLower : u > upper ? RowPiece::kUpper : piece;
  }
  /// The impulse of a row on a piece, brought back to where it may be.
  PLUMB_HD Real allowed(RowPiece piece, Real total) const {
    if (!is_hard(piece)) return total;
    const Range range = range_of(piece);
    if (piece == RowPiece::kLower) return max(total, range.least - pull);
    if (piece == RowPiece::kUpper) return min(total, range.most + pull);
    return clamp(total, range.least, range.most);
  }
  /// Whether a row on a piece holds with force to spare: a limit that bears, a motor that needs no more than half.
  PLUMB_HD bool holds(RowPiece piece, Real total) const {
    if (!is_hard(piece)) return false;
    const Range range = range_of(piece);
    if (piece == RowPiece::kLower) return total > range.least;
    if (piece == RowPiece::kUpper) return total < range.most;
    const Real spare = (range.most - range.least) / 4;
    return total > range.least + spare && total < range.most - spare;
  }

 private:
  struct Range {
    Real least, most;
  };
  /// What motor and spring can give at the speed of a hard piece.
  PLUMB_HD Range range_of(RowPiece piece) const {
    const Real u = speed(piece), soft = spring - drag * u;
    return {soft + (u < steady ? push : -push), soft + (u > steady ? -push : push)};
  }
};

/// Which equation a pass over the joints solves.
enum class PassKind : std::uint8_t {
  kPlaces,  ///< rows hold where the bodies arrive in h seconds: the first pass of a sub-step
  kSpeeds,  ///< rows keep still: the second
  kWhole,   ///< both at once, as the rows stand at the start of a step of h seconds
  kMoved    ///< bodies have moved for h seconds and are put where they should have arrived
};

struct JointPass {
  PassKind kind;
  Real h, inverse_h;
  Softness softness = rigid(0);  ///< of rows that always hold; what is beyond a limit comes back at its rate, too
  Real chain_rate = kHuge;       ///< the most at which errors of chains are taken back, 1/s
  Real whip_rate = kHuge;        ///< and those of whips
  Real return_rate = kHuge;      ///< the most at which what is beyond a limit comes back, 1/s,
  Real most_return = kHuge;      ///< and its speed, m/s or rad/s
};

/// e^x - 1 for small x; a little less for large ones.
PLUMB_HD inline Real growth(Real x) {
  return x * (Real(1) + x / 2 * (Real(1) + x / 3 * (Real(1) + x / 4 * (Real(1) + x / 5))));
}

/// A spring's impulse over h seconds: drag times the speed, and pull times what it is off. A slow spring keeps its
/// energy without damping: its place enters as it is. A fast one, of more than a quarter of a radian a sub-step,
/// becomes implicit in its place too, which is stable at any stiffness. One that is given by its frequency knows its
/// mass, and has the decrement of the true one; of the others it is only known that no less moves than the two bodies
/// by themselves.
struct SpringNumbers {
  Real drag, pull;
};
PLUMB_HD inline SpringNumbers spring_numbers(const JointAxes& axes, int row, Real mass, Real h) {
  const bool by_mass = axes.is_by_mass(row);
  const Real unit = axes.spring_unit(row, mass), stiffness = axes.stiffness[row], damping = h * axes.damping[row];
  const Real turn = h * sqrt(by_mass ? stiffness : stiffness * reciprocal_or_zero(mass));
  const Real fast = clamp(4 * turn - Real(1), Real(0), Real(1));
  const Real slow_drag = by_mass ? growth(min(damping, Real(64))) : damping;
  const Real drag = (Real(1) - fast) * slow_drag + fast * (damping + h * h * stiffness);
  return {unit * drag, unit * (h * stiffness)};
}

/// As a pass over places has it, from which others differ (law_of_row in joint_axis_solve.hpp). x: the row's
/// coordinate.
PLUMB_HD inline RowLaw law_of_places(const JointAxes& axes, int row, Real x, const JointDrive& drive, Real spring_mass,
                                     const JointPass& pass) {
  const RowSpec& spec = axes.row[row];
  const bool turns = goes_round(spec.kind);
  RowLaw law = {-kHuge, kHuge, kHuge, 0, 0, 0};
  const WaysToLimits to = ways_to_limits(axes, row, x);
  const Real back = min(pass.softness.bias_rate, pass.return_rate);
  if (to.has_lower) law.lower = to.lower < 0 ? to.lower * pass.inverse_h : min(to.lower * back, pass.most_return);
  if (to.has_upper) law.upper = to.upper > 0 ? to.upper * pass.inverse_h : max(to.upper * back, -pass.most_return);
  const Real force = drive.max_force[spec.coordinate];
  if (force > 0) {
    law.steady = drive.velocity[spec.coordinate];
    law.push = force * pass.h;
  }
  if (axes.has_spring(row)) {
    const SpringNumbers numbers = spring_numbers(axes, row, spring_mass, pass.h);
    const Real off = x - drive.rest[spec.coordinate], bent = turns ? wrapped(off) : off;
    law.drag = numbers.drag;
    law.spring = -(numbers.pull * bent);
  }
  return law;
}

}  // namespace plumb::impulse
