// NumPy's arrays of numbers as the rows that read and write take: f32 or f64, any distance from row to row.
#pragma once

#include <optional>

#include "core.hpp"
#include "dtypes.hpp"

namespace plumb::python {

struct RowsOfNumbers {
  PlumbDataType type;
  const std::uint64_t* ids;  ///< null: the first `count` objects
  std::uint32_t count;
  std::size_t stride;  ///< bytes
};

/// Throws ValueError for an array that is not rows of `columns` numbers, one for each handle.
RowsOfNumbers numbers_in(const py::array& rows, std::uint32_t columns, const std::optional<Handles>& ids);

}  // namespace plumb::python
