// One shape in several sizes: what a descriptor describes, longer along each axis by a factor. The numbers are copied
// and every backend makes a shape of its own from them, which can be cooked like any other.
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

class ScaledShape {
 public:
  /// scale: by which each axis of the shape's frame is longer; not 0. A negative one mirrors, and of a mesh the
  /// triangles still look outwards. Round shapes stay what they are: spheres and capsules want the same size along all
  /// axes, cylinders along x and z. Height fields want x and z above 0. Materials by triangle stay those of their
  /// triangles, user_data the same. desc is not looked at afterwards, but for its arrays of materials and of indices
  /// that stay the same. Throws Error for a scale that cannot be, and for a compound, whose children are shapes of a
  /// world: scale those.
  ScaledShape(const PlumbShapeDesc& desc, const PlumbVec3& scale);

  ScaledShape(const ScaledShape&) = delete;
  ScaledShape& operator=(const ScaledShape&) = delete;

  /// Lives as long as this.
  [[nodiscard]] const PlumbShapeDesc& desc() const { return desc_; }

 private:
  PlumbShapeDesc desc_;
  std::vector<double> numbers_;          // vertices or heights
  std::vector<std::uint32_t> mirrored_;  // indices, in the other order
};

}  // namespace plumb::helpers
