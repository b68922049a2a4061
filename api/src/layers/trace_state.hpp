// The state rows of a world as a trace records and compares them: poses and velocities of all live bodies.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "plumb/backend/state_hash.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::layers {

using StateRow = std::array<double, 13>;
inline constexpr const char* state_columns[13] = {
    "position.x",         "position.y",         "position.z",        "orientation.x",     "orientation.y",
    "orientation.z",      "orientation.w",      "linear_velocity.x", "linear_velocity.y", "linear_velocity.z",
    "angular_velocity.x", "angular_velocity.y", "angular_velocity.z"};

/// In order of creation. None when the backend cannot read them.
[[nodiscard]] inline std::optional<std::vector<StateRow>> read_state(const PlumbBackendTable& table,
                                                                     PlumbWorld* world) {
  std::uint32_t count = 0;
  if (table.list_bodies(world, nullptr, 0, &count) < 0) return {};
  std::vector<StateRow> rows(count);
  const auto read = [&](PlumbField field, std::size_t column) {
    double* first = rows.empty() ? nullptr : rows.data()->data() + column;
    return table.read(world, field, PLUMB_F64, nullptr, count, first, sizeof(StateRow)) >= 0;
  };
  if (!read(PLUMB_FIELD_POSE, 0) || !read(PLUMB_FIELD_VELOCITY, 7)) return {};
  return rows;
}

/// The same number as plumb.snapshot/1 hash.
[[nodiscard]] inline std::uint64_t hash_of(const std::vector<StateRow>& rows) {
  backend::StateHash hash;
  for (const StateRow& row : rows)
    for (const double number : row) hash.add(number);
  return hash.value();
}

}  // namespace plumb::layers
