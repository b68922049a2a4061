#include "hosts/gazebo/features/shapes.hpp"

#include "hosts/gazebo/features/eigen.hpp"
#include "hosts/gazebo/world/console.hpp"

namespace plumb::gazebo {

physics::Pose3d ShapeFeatures::GetShapeRelativeTransform(const Identity& id) const {
  const Shape* shape = shape_of(id);
  return shape != nullptr ? to_eigen(shape->pose) : physics::Pose3d::Identity();
}
void ShapeFeatures::SetShapeRelativeTransform(const Identity& id, const physics::Pose3d& pose) {
  Shape* shape = shape_of(id);
  if (shape == nullptr || !pose.matrix().allFinite())
    return complain("a collision stays where it is: it is gone, or its pose is not finite");
  shape->pose = from_eigen(pose);
  shape->link->model->world->rebuild(*shape->link);
}
void ShapeFeatures::SetCollisionFilterMask(const Identity& id, std::uint16_t mask) {
  Shape* shape = shape_of(id);
  if (shape == nullptr) return complain("the mask of a collision that is gone was to be set");
  if (shape->mask == mask) return;
  shape->mask = mask;
  shape->link->model->world->rebuild(*shape->link);
}
std::uint16_t ShapeFeatures::GetCollisionFilterMask(const Identity& id) const {
  const Shape* shape = shape_of(id);
  return shape != nullptr ? shape->mask : std::uint16_t{0};
}
void ShapeFeatures::RemoveCollisionFilterMask(const Identity& shape) { SetCollisionFilterMask(shape, kTouchesAll); }

ShapeFeatures::AlignedBoxType ShapeFeatures::GetShapeAxisAlignedBoundingBox(const Identity& shape) const {
  const Shape* found = shape_of(shape);
  if (found == nullptr) return {};
  const auto bounds = bounds_of(found->geometry);
  return {to_eigen(bounds.Min()), to_eigen(bounds.Max())};
}

}  // namespace plumb::gazebo
