#include "shapes.hpp"

namespace plumb::python {

PlumbShapeDesc Shape::pointing() const {
  PlumbShapeDesc pointed = desc;
  pointed.struct_size = sizeof pointed;
  pointed.vertices = vertices.size() == 0 ? nullptr : vertices.data();
  pointed.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
  pointed.indices = indices.size() == 0 ? nullptr : indices.data();
  pointed.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
  pointed.heights = heights.size() == 0 ? nullptr : heights.data();
  pointed.children = children.empty() ? nullptr : children.data();
  pointed.child_count = static_cast<std::uint32_t>(children.size());
  pointed.materials = materials.data();
  pointed.material_count = static_cast<std::uint32_t>(materials.size());
  pointed.triangle_materials = triangle_materials.data();
  return pointed;
}

namespace {

using Three = std::array<double, 3>;

PlumbVec3 vector(const Three& xyz) { return {xyz[0], xyz[1], xyz[2]}; }

}  // namespace

void bind_shapes(py::module_& module) {
  // The functions trust their callers, plumb/shapes.py, with the arrays' dimensions.
  py::class_<Shape>(module, "Shape")
      .def(py::init(
               [](PlumbShapeType type, double radius, double half_height, Three half_extents, std::uint64_t user_data) {
                 Shape shape;
                 shape.desc.type = type;
                 shape.desc.radius = radius;
                 shape.desc.half_height = half_height;
                 shape.desc.half_extents = vector(half_extents);
                 shape.desc.user_data = user_data;
                 return shape;
               }),
           py::kw_only(), py::arg("type"), py::arg("radius") = 0.0, py::arg("half_height") = 0.0,
           py::arg("half_extents") = Three{}, py::arg("user_data") = std::uint64_t{0})
      .def("set_vertices", [](Shape& shape, py::array_t<double, py::array::c_style> xyz) { shape.vertices = xyz; })
      .def("set_triangles",
           [](Shape& shape, py::array_t<std::uint32_t, py::array::c_style> corners) { shape.indices = corners; })
      .def("set_heights",
           [](Shape& shape, py::array_t<double, py::array::c_style> heights, double spacing_x, double spacing_z) {
             if (heights.ndim() != 2) throw py::value_error("heights must have rows and columns");
             shape.heights = heights;
             shape.desc.rows = static_cast<std::uint32_t>(heights.shape(0));
             shape.desc.columns = static_cast<std::uint32_t>(heights.shape(1));
             shape.desc.spacing = {spacing_x, 0, spacing_z};
           })
      .def("set_materials",
           [](Shape& shape, const py::array& materials, py::array_t<std::uint32_t, py::array::c_style> of_triangles) {
             shape.materials = rows_of<PlumbMaterial>(materials, "materials");
             shape.triangle_materials = of_triangles;
           })
      .def("set_children", [](Shape& shape, const py::array& children) {
        shape.children = rows_of<PlumbCompoundChild>(children, "children");
      });
}

}  // namespace plumb::python
