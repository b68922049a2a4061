// Collisions: their places, bounds and masks.
#pragma once

#include <ignition/physics/GetBoundingBox.hh>
#include <ignition/physics/Shape.hh>

#include "hosts/gazebo/features/base.hpp"

namespace plumb::gazebo {

struct ShapeFeatureList
    : physics::FeatureList<physics::GetShapeKinematicProperties, physics::SetShapeKinematicProperties,
                           physics::CollisionFilterMaskFeature, physics::GetModelBoundingBox> {};

class ShapeFeatures : public virtual Base, public virtual physics::Implements3d<ShapeFeatureList> {
 public:
  physics::Pose3d GetShapeRelativeTransform(const Identity& shape) const override;
  void SetShapeRelativeTransform(const Identity& shape, const physics::Pose3d& pose) override;
  void SetCollisionFilterMask(const Identity& shape, std::uint16_t mask) override;
  std::uint16_t GetCollisionFilterMask(const Identity& shape) const override;
  void RemoveCollisionFilterMask(const Identity& shape) override;
  AlignedBoxType GetShapeAxisAlignedBoundingBox(const Identity& shape) const override;
};

}  // namespace plumb::gazebo
