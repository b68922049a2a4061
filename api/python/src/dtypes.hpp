// The structs of plumb.h as NumPy's structured types: the same bytes, vectors as rows of numbers.
#pragma once

#include <cstring>
#include <vector>

#include "core.hpp"

namespace plumb::python {

/// The type for rows of a struct, made once.
template <class Row>
const py::dtype& dtype_of();

/// Throws TypeError unless the array is a row of Rows without gaps.
void require_rows(const py::array& rows, const py::dtype& dtype, const char* what);

/// A copy of the caller's rows, so that they may be changed meanwhile and struct_size is ours to set.
template <class Row>
std::vector<Row> rows_of(const py::array& rows, const char* what) {
  require_rows(rows, dtype_of<Row>(), what);
  std::vector<Row> copy(static_cast<std::size_t>(rows.size()));
  if (!copy.empty()) std::memcpy(copy.data(), rows.data(), copy.size() * sizeof(Row));
  if constexpr (requires { copy[0].struct_size; })
    for (Row& row : copy) row.struct_size = sizeof(Row);
  return copy;
}

template <class Row>
py::array array_of(const std::vector<Row>& rows) {
  return {dtype_of<Row>(), rows.size(), rows.data()};
}

using Handles = py::array_t<std::uint64_t, py::array::c_style>;

inline py::array_t<std::uint64_t> handles(const std::vector<std::uint64_t>& ids) {
  return py::array_t<std::uint64_t>(static_cast<py::ssize_t>(ids.size()), ids.data());
}

inline std::uint32_t count_of(std::size_t size) { return static_cast<std::uint32_t>(size); }
inline std::uint32_t count_of(const Handles& ids) { return static_cast<std::uint32_t>(ids.size()); }

}  // namespace plumb::python
