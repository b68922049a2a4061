// Bullet's constraint solvers, each with a record of how it fared in a step.
#pragma once

#include <memory>

#include "bullet_math.hpp"

namespace plumb::bullet {

enum class SolverKind { SequentialImpulse, Nncg, MlcpDantzig, MlcpLemke };

class TrackedSolver {
 public:
  virtual ~TrackedSolver() = default;
  [[nodiscard]] virtual btConstraintSolver& solver() = 0;
  virtual void begin_step() = 0;
  virtual void begin_sub_step() = 0;
  /// Contact points that were solved since begin_sub_step.
  [[nodiscard]] virtual std::uint32_t contacts() const = 0;
  /// The largest squared change of an impulse in the last iteration of any island, N2 s2; NaN when not known.
  [[nodiscard]] virtual double residual() const = 0;
  /// Whether a direct solver gave up since begin_step and sequential impulses took its place.
  [[nodiscard]] virtual bool fell_back() const = 0;
};

std::unique_ptr<TrackedSolver> make_solver(SolverKind kind);

}  // namespace plumb::bullet
