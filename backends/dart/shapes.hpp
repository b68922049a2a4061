// Collision shapes: from a descriptor to DART's, and where theirs stand in ours.
#pragma once

#include <dart/dynamics/Shape.hpp>

#include <memory>
#include <vector>

#include "dart_math.hpp"

namespace plumb::dart6 {

struct Shape {
  struct Child {
    const Shape* shape;
    PlumbPose pose;
    bool has_material;
    PlumbMaterial material;
  };

  PlumbShapeType type = PLUMB_SPHERE;
  ::dart::dynamics::ShapePtr geometry;  ///< null of a compound
  PlumbPose frame = identity_pose();    ///< of DART's shape in ours
  std::vector<Child> children;
};

/// children: of a compound, in their order; they outlive it.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::vector<const Shape*> children);

}  // namespace plumb::dart6
