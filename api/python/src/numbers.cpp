#include "numbers.hpp"

namespace plumb::python {

RowsOfNumbers numbers_in(const py::array& rows, std::uint32_t columns, const std::optional<Handles>& ids) {
  const bool wide = rows.dtype().equal(py::dtype::of<double>());
  if (!wide && !rows.dtype().equal(py::dtype::of<float>()))
    throw py::value_error("rows must be float64 or float32, not " + std::string(py::str(rows.dtype())));
  const auto size = static_cast<py::ssize_t>(wide ? sizeof(double) : sizeof(float));
  const bool shaped = rows.ndim() == 2 && rows.shape(1) == static_cast<py::ssize_t>(columns);
  if (!shaped || (ids && rows.shape(0) != ids->size()))
    throw py::value_error("rows must be one of " + std::to_string(columns) + " numbers for each handle, not of shape " +
                          std::string(py::str(rows.attr("shape"))));
  const bool dense = columns == 1 || rows.strides(1) == size;
  if (rows.shape(0) > 0 && (!dense || (rows.shape(0) > 1 && rows.strides(0) < columns * size)))
    throw py::value_error(
        "the numbers of a row must lie side by side, and the rows one after another: "
        "numpy.ascontiguousarray makes such an array");
  const py::ssize_t stride = rows.shape(0) > 1 ? rows.strides(0) : static_cast<py::ssize_t>(columns) * size;
  return {wide ? PLUMB_F64 : PLUMB_F32, ids ? ids->data() : nullptr, static_cast<std::uint32_t>(rows.shape(0)),
          static_cast<std::size_t>(stride)};
}

}  // namespace plumb::python
