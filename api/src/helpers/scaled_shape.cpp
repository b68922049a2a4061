#include "plumb/helpers/scaled_shape.hpp"

#include <cmath>
#include <utility>

#include "common.hpp"

namespace plumb::helpers {

namespace {

std::string text_of(const PlumbVec3& v) {
  return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

void require_scale(bool holds, const PlumbVec3& scale, const char* remedy) {
  require(holds, "scaled shape: the scale is " + text_of(scale) + "; " + remedy);
}

}  // namespace

ScaledShape::ScaledShape(const PlumbShapeDesc& desc, const PlumbVec3& scale) : desc_(desc) {
  const PlumbVec3 size = {std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)};
  require_scale(std::isfinite(size.x + size.y + size.z) && size.x > 0 && size.y > 0 && size.z > 0, scale,
                "it must be finite, and 0 along no axis");
  const bool mirrors = (scale.x < 0) != ((scale.y < 0) != (scale.z < 0));
  const auto vertices = [&] {
    numbers_.assign(desc.vertices, desc.vertices + std::size_t{3} * desc.vertex_count);
    for (std::size_t i = 0; i < numbers_.size(); i += 3) {
      numbers_[i] *= scale.x;
      numbers_[i + 1] *= scale.y;
      numbers_[i + 2] *= scale.z;
    }
    desc_.vertices = numbers_.data();
  };
  switch (desc.type) {
    case PLUMB_SPHERE:
    case PLUMB_CAPSULE:
      require_scale(size.x == size.y && size.y == size.z, scale,
                    "spheres and capsules stay round: give all axes the same size");
      desc_.radius *= size.x;
      desc_.half_height *= size.x;
      break;
    case PLUMB_CYLINDER:
      require_scale(size.x == size.z, scale, "a cylinder stays round: give x and z the same size");
      desc_.radius *= size.x;
      desc_.half_height *= size.y;
      break;
    case PLUMB_BOX:
      desc_.half_extents = {size.x * desc.half_extents.x, size.y * desc.half_extents.y, size.z * desc.half_extents.z};
      break;
    case PLUMB_CONVEX_HULL: vertices(); break;
    case PLUMB_TRIANGLE_MESH:
      vertices();
      if (!mirrors) break;
      mirrored_.assign(desc.indices, desc.indices + std::size_t{3} * desc.triangle_count);
      for (std::size_t i = 0; i < mirrored_.size(); i += 3) std::swap(mirrored_[i + 1], mirrored_[i + 2]);
      desc_.indices = mirrored_.data();
      break;
    case PLUMB_HEIGHT_FIELD:
      require_scale(scale.x > 0 && scale.z > 0, scale, "a height field wants x and z above 0");
      numbers_.assign(desc.heights, desc.heights + std::size_t{desc.rows} * desc.columns);
      for (double& height : numbers_) height *= scale.y;
      desc_.heights = numbers_.data();
      desc_.spacing = {scale.x * desc.spacing.x, desc.spacing.y, scale.z * desc.spacing.z};
      break;
    case PLUMB_PLANE: require_scale(scale.y > 0, scale, "a plane wants y above 0: turn it over instead"); break;
    default:
      throw Error(PLUMB_E_INVALID_ARGUMENT,
                  "scaled shape: the children of a compound are shapes of a world; scale those, and their places");
  }
}

}  // namespace plumb::helpers
