// Materials by triangle, for an engine that asks for a contact's coefficients where it has found it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "plumb/backend/check_descs.hpp"

namespace plumb::backend {

/// Those of a shape, copied from its descriptor; empty where all of it has the body's material.
class TriangleMaterials {
 public:
  TriangleMaterials() = default;
  /// desc: as check_shape() passes it.
  explicit TriangleMaterials(const PlumbShapeDesc& desc) {
    if (!has_triangle_materials(desc)) return;
    rows_.assign(desc.materials, desc.materials + desc.material_count);
    of_.assign(desc.triangle_materials, desc.triangle_materials + triangles_of(desc));
    rows_of_field_ = desc.rows;
    columns_ = desc.columns;
    spacing_ = desc.spacing;
  }

  [[nodiscard]] bool empty() const { return of_.empty(); }
  /// Of a triangle; null: the body's, also where there is no such triangle.
  [[nodiscard]] const PlumbMaterial* of(std::size_t triangle) const {
    return triangle < of_.size() && of_[triangle] != PLUMB_BODY_MATERIAL ? &rows_[of_[triangle]] : nullptr;
  }
  /// Of a height field at a place in the shape's frame, m: for engines that do not tell the triangle.
  [[nodiscard]] const PlumbMaterial* at(double x, double z) const {
    if (empty()) return nullptr;
    const double across = std::clamp(x / spacing_.x + 0.5 * (columns_ - 1), 0.0, columns_ - 1.0),
                 along = std::clamp(z / spacing_.z + 0.5 * (rows_of_field_ - 1), 0.0, rows_of_field_ - 1.0);
    const std::size_t column = std::min<std::size_t>(static_cast<std::size_t>(across), columns_ - 2),
                      row = std::min<std::size_t>(static_cast<std::size_t>(along), rows_of_field_ - 2);
    const bool second = across - static_cast<double>(column) + (along - static_cast<double>(row)) > 1;
    return of(2 * (row * (columns_ - 1) + column) + (second ? 1 : 0));
  }

 private:
  std::vector<PlumbMaterial> rows_;
  std::vector<std::uint32_t> of_;
  std::uint32_t rows_of_field_ = 0, columns_ = 0;
  PlumbVec3 spacing_{};
};

}  // namespace plumb::backend
