#include "convert/sdf/sdf_shapes.hpp"

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Collision.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Geometry.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sdf/Surface.hh>

#include "convert/sdf/sdf_types.hpp"
#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

/// A number of the file under these names, one within the other; SDF's own default where they are not there.
double number_at(sdf::ElementPtr element, std::initializer_list<const char*> names, double otherwise) {
  for (const char* name : names) {
    if (!element || !element->HasElement(name)) return otherwise;
    element = element->GetElement(name);
  }
  return element->Get<double>();
}

/// DOM classes of libsdformat 12 know no friction: it stands in the elements. Both of its directions are one here.
PlumbMaterial material_of(const sdf::Collision& collision, const std::string& name, Remarks& remarks) {
  PlumbMaterial material{};
  material.friction = number_at(collision.Element(), {"surface", "friction", "ode", "mu"}, 1);
  material.restitution = number_at(collision.Element(), {"surface", "bounce", "restitution_coefficient"}, 0);
  const double across = number_at(collision.Element(), {"surface", "friction", "ode", "mu2"}, material.friction);
  if (across != material.friction) remarks.add("friction of a second direction (mu2) is left out", name);
  return material;
}

SceneShape mesh_shape(const sdf::Mesh& mesh, bool moves, const std::string& name, const ModelFolders& folders,
                      Remarks& remarks) {
  if (!mesh.Submesh().empty()) remarks.add("of a mesh one part is named, and all of it is taken", name);
  // Of what was converted from URDF, libsdformat says no file.
  const bool included = std::filesystem::exists(mesh.FilePath());
  const ModelFolders beside{included ? std::filesystem::path(mesh.FilePath()) : folders.file, folders.folders};
  return surface_shape(load_surface(beside.find(mesh.Uri()), referee::plain(vec_of(mesh.Scale()))), moves, name,
                       remarks);
}

LinkShape shape_of(const sdf::Collision& collision, bool moves, const std::string& name, const ModelFolders& folders,
                   Remarks& remarks) {
  ignition::math::Pose3d pose;
  check_sdf(name, collision.SemanticPose().Resolve(pose));
  LinkShape part{{}, pose_of(pose), material_of(collision, name, remarks)};
  const sdf::Geometry& geometry = *collision.Geom();
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX: part.shape = box_shape_of(vec_of(geometry.BoxShape()->Size()) / 2); return part;
    case sdf::GeometryType::SPHERE: part.shape = sphere_shape(geometry.SphereShape()->Radius()); return part;
    case sdf::GeometryType::CYLINDER:
      part.shape = cylinder_shape(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length() / 2);
      part.pose = part.pose * along_z();
      return part;
    case sdf::GeometryType::CAPSULE:
      part.shape = capsule_shape(geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length() / 2);
      part.pose = part.pose * along_z();
      return part;
    case sdf::GeometryType::ELLIPSOID:
      part.shape = ellipsoid_shape(vec_of(geometry.EllipsoidShape()->Radii()));
      remarks.add("ellipsoids are hulls of 64 corners", name);
      return part;
    case sdf::GeometryType::PLANE: {
      part.shape = plane_shape();
      const Vec3 normal = vec_of(geometry.PlaneShape()->Normal());
      part.pose.rotation = part.pose.rotation * referee::Quat::FromTwoVectors(Vec3::UnitY(), normal).toRotationMatrix();
      return part;
    }
    case sdf::GeometryType::MESH:
      part.shape = mesh_shape(*geometry.MeshShape(), moves, name, folders, remarks);
      return part;
    default:
      throw UsageError(fmt::format(
          "{}: collision \"{}\" is a height map or another kind of shape that scenes cannot take over; make it a mesh",
          folders.file.string(), name));
  }
}

bool has_geometry(const sdf::Collision& collision) {
  return collision.Geom() != nullptr && collision.Geom()->Type() != sdf::GeometryType::EMPTY;
}

}  // namespace

std::vector<LinkShape> shapes_of(const sdf::Link& link, bool moves, const std::string& name,
                                 const ModelFolders& folders, Remarks& remarks) {
  std::vector<LinkShape> shapes;
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    if (has_geometry(collision))
      shapes.push_back(shape_of(collision, moves, name + "/" + collision.Name(), folders, remarks));
  }
  return shapes;
}

std::uint32_t bitmask_of(const sdf::Link& link, const std::string& name, Remarks& remarks) {
  std::optional<std::uint32_t> first;
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Surface* surface = link.CollisionByIndex(i)->Surface();
    const std::uint32_t mask =
        surface == nullptr || surface->Contact() == nullptr ? 0xffff : surface->Contact()->CollideBitmask();
    if (first && *first != mask) remarks.add("of several collide_bitmasks of a link the first is taken", name);
    first = first.value_or(mask);
  }
  return first.value_or(0xffff);
}

}  // namespace plumb::harness
