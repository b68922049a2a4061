#include "hosts/gazebo/features/forms.hpp"

#include "hosts/gazebo/features/eigen.hpp"
#include "hosts/gazebo/sdf/mesh.hpp"
#include "hosts/gazebo/world/console.hpp"

namespace plumb::gazebo {

Identity FormFeatures::cast(std::size_t id, Form form) const {
  const Shape* shape = shape_of(id);
  return shape != nullptr && shape->geometry.form == form ? identity_of(shape) : GenerateInvalidId();
}

const Geometry& FormFeatures::geometry_of(std::size_t id) const {
  static const Geometry nothing;
  const Shape* shape = shape_of(id);
  return shape != nullptr ? shape->geometry : nothing;
}

Identity FormFeatures::attach(std::size_t id, const std::string& name, const Placement& pose, Geometry geometry) {
  Link* link = link_of(id);
  if (link != nullptr) return identity_of(add_shape(*link, name, pose, std::move(geometry)));
  complain("collision [" + name + "] is left out: its link is not there");
  return GenerateInvalidId();
}

Identity FormFeatures::CastToBoxShape(const Identity& shape) const { return cast(shape, Form::box); }
physics::LinearVector3d FormFeatures::GetBoxShapeSize(const Identity& box) const {
  return to_eigen(geometry_of(box).size);
}
Identity FormFeatures::AttachBoxShape(const Identity& link, const std::string& name, const Vector3& size,
                                      const Pose3& pose) {
  return attach(link, name, from_eigen(pose), box_of(from_eigen(size)));
}
Identity FormFeatures::CastToSphereShape(const Identity& shape) const { return cast(shape, Form::sphere); }
double FormFeatures::GetSphereShapeRadius(const Identity& sphere) const { return geometry_of(sphere).radius; }
Identity FormFeatures::AttachSphereShape(const Identity& link, const std::string& name, double radius,
                                         const Pose3& pose) {
  return attach(link, name, from_eigen(pose), sphere_of(radius));
}
Identity FormFeatures::CastToCylinderShape(const Identity& shape) const { return cast(shape, Form::cylinder); }
double FormFeatures::GetCylinderShapeRadius(const Identity& cylinder) const { return geometry_of(cylinder).radius; }
double FormFeatures::GetCylinderShapeHeight(const Identity& cylinder) const { return geometry_of(cylinder).length; }
Identity FormFeatures::AttachCylinderShape(const Identity& link, const std::string& name, double radius, double height,
                                           const Pose3& pose) {
  return attach(link, name, from_eigen(pose), cylinder_of(radius, height));
}
Identity FormFeatures::CastToCapsuleShape(const Identity& shape) const { return cast(shape, Form::capsule); }
double FormFeatures::GetCapsuleShapeRadius(const Identity& capsule) const { return geometry_of(capsule).radius; }
double FormFeatures::GetCapsuleShapeLength(const Identity& capsule) const { return geometry_of(capsule).length; }
Identity FormFeatures::AttachCapsuleShape(const Identity& link, const std::string& name, double radius, double length,
                                          const Pose3& pose) {
  return attach(link, name, from_eigen(pose), capsule_of(radius, length));
}
Identity FormFeatures::CastToEllipsoidShape(const Identity& shape) const { return cast(shape, Form::ellipsoid); }
physics::LinearVector3d FormFeatures::GetEllipsoidShapeRadii(const Identity& ellipsoid) const {
  return to_eigen(geometry_of(ellipsoid).size);
}
Identity FormFeatures::AttachEllipsoidShape(const Identity& link, const std::string& name, Vector3 radii,
                                            const Pose3& pose) {
  return attach(link, name, from_eigen(pose), ellipsoid_of(from_eigen(radii)));
}
Identity FormFeatures::CastToPlaneShape(const Identity& shape) const { return cast(shape, Form::plane); }
physics::LinearVector3d FormFeatures::GetPlaneShapeNormal(const Identity& plane) const {
  return to_eigen(geometry_of(plane).size);
}
physics::LinearVector3d FormFeatures::GetPlaneShapePoint(const Identity& plane) const {
  const Shape* shape = shape_of(plane);
  return to_eigen(shape != nullptr ? shape->pose.Pos() : Vector::Zero);
}
Identity FormFeatures::AttachPlaneShape(const Identity& link, const std::string& name, const Vector3& normal,
                                        const Vector3& point) {
  return attach(link, name, Placement(from_eigen(point), Rotation::Identity), plane_of(from_eigen(normal)));
}
Identity FormFeatures::CastToMeshShape(const Identity& shape) const { return cast(shape, Form::mesh); }
physics::LinearVector3d FormFeatures::GetMeshShapeSize(const Identity& mesh) const {
  return to_eigen(bounds_of(geometry_of(mesh)).Size());
}
physics::LinearVector3d FormFeatures::GetMeshShapeScale(const Identity& mesh) const {
  return to_eigen(geometry_of(mesh).size);
}
Identity FormFeatures::AttachMeshShape(const Identity& link, const std::string& name,
                                       const ignition::common::Mesh& mesh, const Pose3& pose, const Vector3& scale) {
  return attach(link, name, from_eigen(pose), mesh_of(mesh, from_eigen(scale)));
}

}  // namespace plumb::gazebo
