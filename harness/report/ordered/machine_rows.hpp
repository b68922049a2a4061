// Rows by the hardware they ran on: times of different machines are never held against each other.
#pragma once

#include <string>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

struct MachineRows {
  std::string name;       ///< processor, cores, device
  std::vector<Row> rows;  ///< their indices count on over all machines
};

/// In order of appearance; one without rows where there are none at all.
[[nodiscard]] std::vector<MachineRows> rows_by_machine(const std::vector<Row>& rows);

}  // namespace plumb::harness
