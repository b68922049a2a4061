// Rows by the hardware they ran on: times of different machines are never held against each other.
#pragma once

#include <string>
#include <vector>

#include "rows/result_row.hpp"

namespace plumb::harness {

struct MachineRows {
  std::string name;             ///< processor, cores, device
  std::vector<ResultRow> rows;  ///< their indices count on over all machines
};

/// In order of appearance; one without rows where there are no lines.
[[nodiscard]] std::vector<MachineRows> rows_by_machine(const std::vector<Json>& lines);

}  // namespace plumb::harness
