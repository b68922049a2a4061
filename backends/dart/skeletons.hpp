// DART's skeletons of a world as it is now, and which of ours each of its things is.
#pragma once

#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "joints/joint.hpp"

namespace plumb::dart6 {

/// One shape of one body.
struct Geom {
  Body* body;
  const Shape* shape;
  std::uint32_t child;
  PlumbPose at;  ///< of the shape in the body's frame
  const PlumbMaterial* material;
};

struct Skeletons {
  std::vector<::dart::dynamics::SkeletonPtr> all;
  std::vector<Body*> bodies;  ///< each after its parent
  std::vector<Geom> geoms;
  std::unordered_map<const ::dart::dynamics::ShapeFrame*, std::size_t> geom_of;

  [[nodiscard]] const Geom& geom(const ::dart::collision::CollisionObject& object) const {
    return geoms[geom_of.at(object.getShapeFrame())];
  }
};

/// order: as grow_trees gives it. A skeleton for each tree; bodies get their nodes, links their joints.
[[nodiscard]] Skeletons make_skeletons(std::vector<Body*> order, const PlumbVec3& gravity);

/// Puts what hangs on nothing where the body says, and lets it move so. Free joints stand in the centre of mass, and
/// move along their own axes.
void place(const Body& body);

/// Motors of a link, at any time.
void apply_motors(const Joint& link);
/// Where its springs rest, likewise.
void apply_targets(const Joint& link);

}  // namespace plumb::dart6
