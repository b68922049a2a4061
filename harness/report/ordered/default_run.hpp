// The run of an engine as it ships, for whatever says "at the defaults".
#pragma once

#include "report/ordered/ordered_rows.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// Null where the backend has run the problem with other settings only, whose cell is no word on its defaults.
[[nodiscard]] inline const Row* default_run(const OrderedRows& ordered, const Problem& problem,
                                            const std::string& backend) {
  const Row* row = ordered.representative(problem, backend);
  return row && ordered.is_default(*row) ? row : nullptr;
}

}  // namespace plumb::harness
