// A shape's descriptor, with the arrays that it points to.
#pragma once

#include "core.hpp"
#include "dtypes.hpp"

namespace plumb::python {

struct Shape {
  PlumbShapeDesc desc{};
  py::array_t<double, py::array::c_style> vertices, heights;
  py::array_t<std::uint32_t, py::array::c_style> indices, triangle_materials;
  std::vector<PlumbCompoundChild> children;
  std::vector<PlumbMaterial> materials;

  /// As the C calls read it. Good while this lives.
  [[nodiscard]] PlumbShapeDesc pointing() const;
};

}  // namespace plumb::python
