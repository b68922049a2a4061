// Bodies in memory: what the host writes and the step reads or moves, rows by body slot.
#pragma once

#include "bodies/body_state.hpp"
#include "exec/table.hpp"

namespace plumb::impulse {

struct BodyTable {
  explicit BodyTable(Executor& executor) : state(executor) {}

  BodyState state;  ///< say which rows were touched
  Table<BodyForce> force;
  Table<BodyMass> mass;
  Table<BodyFrame> frames;
  Table<RollingFriction> rolling_frictions;  ///< in worlds that have them
  std::uint32_t count = 0;                   ///< slots in use; rows behind are nobody's, and the last row is a sentinel

  [[nodiscard]] std::size_t size() const { return state.size(); }
  /// Where memory runs out, size() stays as it was.
  void grow(std::size_t rows, bool with_rolling_friction) {
    force.grow(rows);
    mass.grow(rows);
    frames.grow(rows);
    if (with_rolling_friction) rolling_frictions.grow(rows);
    state.grow(rows);
  }
  /// turn: whether dynamic bodies may.
  [[nodiscard]] MovableBodies view(bool turn) {
    return {state.position.device(), state.orientation.device(),
            state.velocity.device(), force.device(),
            mass.device(),           turn};
  }
};

}  // namespace plumb::impulse
