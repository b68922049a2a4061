// The machine that a row was measured on, and how much memory this process uses.
#pragma once

#include <cstdint>

#include "base/json.hpp"

namespace plumb::harness {

/// {"cpu","cores","memory_mb","os","compiler","build","plumb","date"}
[[nodiscard]] Json describe_machine();
[[nodiscard]] std::uint64_t machine_memory_bytes();

/// Largest resident size of this process since reset_peak_memory (since its start where the system cannot reset it),
/// MB.
[[nodiscard]] double peak_memory_mb();
void reset_peak_memory();

}  // namespace plumb::harness
