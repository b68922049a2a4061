// Forms of collisions, asked for and attached without SDF.
#pragma once

#include <ignition/physics/BoxShape.hh>
#include <ignition/physics/CapsuleShape.hh>
#include <ignition/physics/CylinderShape.hh>
#include <ignition/physics/EllipsoidShape.hh>
#include <ignition/physics/PlaneShape.hh>
#include <ignition/physics/SphereShape.hh>
#include <ignition/physics/mesh/MeshShape.hh>

#include "hosts/gazebo/features/base.hpp"

namespace plumb::gazebo {

struct RoundFormFeatureList
    : physics::FeatureList<physics::GetSphereShapeProperties, physics::AttachSphereShapeFeature,
                           physics::GetCylinderShapeProperties, physics::AttachCylinderShapeFeature,
                           physics::GetCapsuleShapeProperties, physics::AttachCapsuleShapeFeature,
                           physics::GetEllipsoidShapeProperties, physics::AttachEllipsoidShapeFeature> {};

struct OtherFormFeatureList
    : physics::FeatureList<physics::GetBoxShapeProperties, physics::AttachBoxShapeFeature,
                           physics::GetPlaneShapeProperties, physics::AttachPlaneShapeFeature,
                           physics::mesh::GetMeshShapeProperties, physics::mesh::AttachMeshShapeFeature> {};

class FormFeatures : public virtual Base,
                     public virtual physics::Implements3d<RoundFormFeatureList>,
                     public virtual physics::Implements3d<OtherFormFeatureList> {
 public:
  using Vector3 = physics::LinearVector3d;
  using Pose3 = physics::Pose3d;

  Identity CastToBoxShape(const Identity& shape) const override;
  Vector3 GetBoxShapeSize(const Identity& box) const override;
  Identity AttachBoxShape(const Identity& link, const std::string& name, const Vector3& size,
                          const Pose3& pose) override;
  Identity CastToSphereShape(const Identity& shape) const override;
  double GetSphereShapeRadius(const Identity& sphere) const override;
  Identity AttachSphereShape(const Identity& link, const std::string& name, double radius, const Pose3& pose) override;
  Identity CastToCylinderShape(const Identity& shape) const override;
  double GetCylinderShapeRadius(const Identity& cylinder) const override;
  double GetCylinderShapeHeight(const Identity& cylinder) const override;
  Identity AttachCylinderShape(const Identity& link, const std::string& name, double radius, double height,
                               const Pose3& pose) override;
  Identity CastToCapsuleShape(const Identity& shape) const override;
  double GetCapsuleShapeRadius(const Identity& capsule) const override;
  double GetCapsuleShapeLength(const Identity& capsule) const override;
  Identity AttachCapsuleShape(const Identity& link, const std::string& name, double radius, double length,
                              const Pose3& pose) override;
  Identity CastToEllipsoidShape(const Identity& shape) const override;
  Vector3 GetEllipsoidShapeRadii(const Identity& ellipsoid) const override;
  Identity AttachEllipsoidShape(const Identity& link, const std::string& name, Vector3 radii,
                                const Pose3& pose) override;
  Identity CastToPlaneShape(const Identity& shape) const override;
  Vector3 GetPlaneShapeNormal(const Identity& plane) const override;
  Vector3 GetPlaneShapePoint(const Identity& plane) const override;
  Identity AttachPlaneShape(const Identity& link, const std::string& name, const Vector3& normal,
                            const Vector3& point) override;
  Identity CastToMeshShape(const Identity& shape) const override;
  Vector3 GetMeshShapeSize(const Identity& mesh) const override;
  Vector3 GetMeshShapeScale(const Identity& mesh) const override;
  Identity AttachMeshShape(const Identity& link, const std::string& name, const ignition::common::Mesh& mesh,
                           const Pose3& pose, const Vector3& scale) override;

 private:
  [[nodiscard]] Identity cast(std::size_t shape, Form form) const;
  Identity attach(std::size_t link, const std::string& name, const Placement& pose, Geometry geometry);
  /// Of nothing for what is not there.
  [[nodiscard]] const Geometry& geometry_of(std::size_t shape) const;
};

}  // namespace plumb::gazebo
