#include <cmath>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Geometry.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sdf/Surface.hh>

#include "hosts/gazebo/sdf/mesh.hpp"
#include "hosts/gazebo/sdf/read.hpp"
#include "hosts/gazebo/world/console.hpp"

namespace plumb::gazebo {
namespace {

/// The element at the end of a path, null where one is missing: asking for it would make it up.
sdf::ElementPtr inside(sdf::ElementPtr element, std::initializer_list<const char*> path) {
  for (const char* name : path) {
    if (!element || !element->HasElement(name)) return nullptr;
    element = element->GetElement(name);
  }
  return element;
}

}  // namespace

std::optional<Geometry> read_geometry(const sdf::Collision& collision) {
  const sdf::Geometry* geometry = collision.Geom();
  if (geometry != nullptr) {
    if (const auto* box = geometry->BoxShape()) return box_of(box->Size());
    if (const auto* sphere = geometry->SphereShape()) return sphere_of(sphere->Radius());
    if (const auto* cylinder = geometry->CylinderShape()) return cylinder_of(cylinder->Radius(), cylinder->Length());
    if (const auto* capsule = geometry->CapsuleShape()) return capsule_of(capsule->Radius(), capsule->Length());
    if (const auto* ellipsoid = geometry->EllipsoidShape()) return ellipsoid_of(ellipsoid->Radii());
    if (const auto* plane = geometry->PlaneShape()) return plane_of(plane->Normal());
    if (const auto* mesh = geometry->MeshShape()) return mesh_of(mesh->Uri(), mesh->Submesh(), mesh->Scale());
  }
  const bool heights = geometry != nullptr && geometry->HeightmapShape() != nullptr;
  complain("collision [" + collision.Name() + "] is left out: " +
           (heights ? "heightmaps are not taken; make a mesh of it" : "it has no geometry that is known here"));
  return std::nullopt;
}

Surface surface_of(const sdf::Collision& collision) {
  Surface surface;
  if (const auto* said = collision.Surface(); said != nullptr && said->Contact() != nullptr)
    surface.mask = said->Contact()->CollideBitmask();
  const sdf::ElementPtr element = inside(collision.Element(), {"surface"});
  if (const auto ode = inside(element, {"friction", "ode"}); ode && ode->HasElement("mu"))
    surface.friction = ode->Get<double>("mu");
  if (const auto bounce = inside(element, {"bounce"}); bounce && bounce->HasElement("restitution_coefficient"))
    surface.restitution = bounce->Get<double>("restitution_coefficient");
  if (!(surface.friction >= 0) || !std::isfinite(surface.friction)) {
    complain("the friction of collision [" + collision.Name() + "] is " + std::to_string(surface.friction) +
             "; 1 is taken: it must be finite and not below 0");
    surface.friction = 1;
  }
  if (!(surface.restitution >= 0 && surface.restitution <= 1)) {
    complain("the restitution of collision [" + collision.Name() + "] is " + std::to_string(surface.restitution) +
             "; 0 is taken: it must be within 0 and 1");
    surface.restitution = 0;
  }
  return surface;
}

}  // namespace plumb::gazebo
