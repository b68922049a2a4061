// How kLanes bodies that follow each other move within a step, where nothing is special about any of them: the same
// arithmetic as in motion.hpp, and the same bits.
#pragma once

#include "bodies/motion.hpp"
#include "math/wide.hpp"

namespace plumb::impulse {

#if !defined(PLUMB_IMPULSE_CUDA)

/// Reads and writes kLanes rows that follow each other: the first numbers of all of them, the second and so on.
template <class Row>
void load_rows(const Row* rows, Lanes (&numbers)[kLanes]) {
  Lanes found[kLanes];
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) found[lane] = load_row(rows[lane]);
  transpose(found, numbers);
}
template <class Row>
void store_rows(const Lanes (&numbers)[kLanes], Row* rows) {
  Lanes found[kLanes];
  transpose(numbers, found);
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) store_row(rows[lane], found[lane]);
}

/// Whether the kLanes bodies from i on are dynamic and free of locks, and none tumbles; and whether they turn, all of
/// them or none.
struct PlainBodies {
  bool plain, turn;

  PlainBodies(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i) {
    std::uint32_t all = ~0U, any = 0;
    bool tumble = false;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t flags = bodies.mass[i + lane].flags;
      all &= flags;
      any |= flags;
      tumble = tumble || tumbles(bodies, solver, i + lane);
    }
    constexpr std::uint32_t kMove = kBodyDynamic | kBodyMoves;
    turn = (all & kBodyTurns) != 0;
    plain = (all & kMove) == kMove && (any & kBodyLocked) == 0 && !tumble && turn == ((any & kBodyTurns) != 0);
  }
};

/// integrate_velocity() of plain bodies.
inline void integrate_plain_velocities(const Bodies& bodies, const SolverBodies& solver, bool first, std::uint32_t i) {
  Lanes velocity[kLanes], free[kLanes], forces[kLanes];
  load_rows(solver.velocity + i, velocity);
  load_rows(solver.forces + i, forces);
  if (!first) load_rows(solver.free_velocity + i, free);
  const auto integrate = [&](std::uint32_t k, const Lanes& drag) {
    const Lanes carried = first ? Lanes(0) : velocity[k] - free[k];
    free[k] = drag * (velocity[k] + forces[k]);
    velocity[k] = free[k] + carried;
  };
  for (std::uint32_t k = 0; k < 3; ++k) integrate(k, forces[3]);
  free[3] = free[7] = Lanes(0);
  for (std::uint32_t k = 4; k < 7; ++k) {
    if (bodies.turn)
      integrate(k, forces[7]);
    else if (first)
      free[k] = Lanes(0);
  }
  store_rows(velocity, solver.velocity + i);
  store_rows(free, solver.free_velocity + i);
}

/// turn_by() of turns by less than a right angle.
inline Quat4<Lanes> small_turn_by(const Vec3<Lanes>& rotation, const Lanes& angle) {
  const SinCosOf<Lanes> half = small_sin_cos(angle / Lanes(2));
  const Lanes k = half.sine / angle;
  const auto turns = angle > Lanes(0);
  const auto along = [&](const Lanes& x) { return select(turns, k * x, x / Lanes(2)); };
  return {along(rotation.x), along(rotation.y), along(rotation.z), select(turns, half.cosine, Lanes(1))};
}

/// integrate_position() of plain bodies; false where one of them turns too far for that, and nothing was done.
inline bool integrate_plain_positions(const SolverBodies& solver, Real h, bool turn, std::uint32_t i) {
  Lanes velocity[kLanes], displacement[kLanes];
  load_rows(solver.velocity + i, velocity);
  load_rows(solver.displacement + i, displacement);
  for (std::uint32_t k = 0; k < 3; ++k) displacement[k] = displacement[k] + Lanes(h) * velocity[k];
  if (turn) {
    const Vec3<Lanes> rotation = Lanes(h) * Vec3<Lanes>{velocity[4], velocity[5], velocity[6]};
    const Lanes angle = length(rotation);
    if (any(!(angle / Lanes(2) < Lanes(kPi / 4)))) return false;
    const Quat4<Lanes> before = {displacement[4], displacement[5], displacement[6], displacement[7]};
    const Quat4<Lanes> after = normalized(small_turn_by(rotation, angle) * before);
    displacement[4] = after.x;
    displacement[5] = after.y;
    displacement[6] = after.z;
    displacement[7] = after.w;
  }
  store_rows(displacement, solver.displacement + i);
  return true;
}

#endif

/// How many groups of bodies that are moved together there are among n.
PLUMB_HD constexpr std::uint32_t body_groups(std::uint32_t n) { return (n + kLanes - 1) / kLanes; }

/// A group among n bodies, or those of it that have sub-steps of a level.
class BodyGroup {
 public:
  std::uint32_t begin, end;

  PLUMB_HD BodyGroup(std::uint32_t group, std::uint32_t n) : begin(group * kLanes), end(min(n, begin + kLanes)) {}
  PLUMB_HD BodyGroup(std::uint32_t group, std::uint32_t n, const BodyLevels& levels, std::uint32_t level)
      : begin(group * kLanes), end(min(n, begin + kLanes)), levels_(levels), level_(level) {}
  PLUMB_HD bool has(std::uint32_t i) const { return levels_(i) == level_; }
  /// Whether it is of as many bodies as there are lanes.
  [[nodiscard]] PLUMB_HD bool is_full() const {
    for (std::uint32_t i = begin; i < end; ++i)
      if (!has(i)) return false;
    return end - begin == kLanes;
  }

 private:
  BodyLevels levels_;
  std::uint32_t level_ = 0;
};

/// integrate_velocity() of the bodies of a group.
PLUMB_HD inline void integrate_velocities(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step,
                                          bool first, const BodyGroup& group) {
#if !defined(PLUMB_IMPULSE_CUDA)
  if (group.is_full() && PlainBodies(bodies, solver, group.begin).plain)
    return integrate_plain_velocities(bodies, solver, first, group.begin);
#endif
  for (std::uint32_t i = group.begin; i < group.end; ++i)
    if (group.has(i)) integrate_velocity(bodies, solver, step, first, i);
}

/// integrate_position() likewise.
PLUMB_HD inline void integrate_positions(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step,
                                         const BodyGroup& group) {
#if !defined(PLUMB_IMPULSE_CUDA)
  if (group.is_full()) {
    const PlainBodies all(bodies, solver, group.begin);
    if (all.plain && integrate_plain_positions(solver, step.h, all.turn, group.begin)) return;
  }
#endif
  for (std::uint32_t i = group.begin; i < group.end; ++i)
    if (group.has(i)) integrate_position(bodies, solver, step, i);
}

}  // namespace plumb::impulse
