// Shapes as ODE's geoms: each geom with its place in the shape's frame. ODE keeps pointers to hulls, meshes and height
// fields, so a Shape owns those arrays and outlives its geoms.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "ode_math.hpp"
#include "plumb/backend/triangle_materials.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::ode {

struct TriMeshDataDeleter {
  void operator()(dTriMeshDataID data) const { dGeomTriMeshDataDestroy(data); }
};
struct HeightfieldDataDeleter {
  void operator()(dHeightfieldDataID data) const { dGeomHeightfieldDataDestroy(data); }
};

struct Shape {
  struct Child {
    const Shape* shape;
    PlumbPose pose;
    bool has_material;
    PlumbMaterial material;
  };

  PlumbShapeType type = PLUMB_SPHERE;
  double radius = 0;
  double half_height = 0;
  PlumbVec3 half_extents{};
  std::vector<Child> children;

  // Hull: corners around their mean, which lies inside: libccd takes the geom's origin for an inner point.
  PlumbVec3 centre{};
  std::vector<dReal> points;
  std::vector<dReal> planes;
  std::vector<unsigned> polygons;

  // Mesh and height field; row by row as given.
  std::vector<double> vertices;
  std::vector<std::uint32_t> indices;
  std::uint32_t triangle_count = 0;  ///< as given: a single one is cut in two
  std::unique_ptr<dxTriMeshData, TriMeshDataDeleter> mesh;
  std::unique_ptr<dxHeightfieldData, HeightfieldDataDeleter> field;
  backend::TriangleMaterials materials;
};

/// A geom of a shape and where it stands in the shape's frame. A plane has no place: see place_plane.
struct PlacedGeom {
  dGeomID geom;
  PlumbPose place;
  bool lying;  ///< its axis is z where the shape's is y: turned by turn_axis after place
  std::uint32_t child;
  const PlumbMaterial* material;  ///< of a compound's child; null: the body's
};

/// Fills an empty shape. children[i]: the shapes that desc.children[i] names. Throws Error for what ODE cannot hold.
void fill_shape(Shape& shape, const PlumbShapeDesc& desc, const std::vector<const Shape*>& children);

/// Makes the shape's geoms in a space (null: in none). The caller destroys them before the shape.
void make_geoms(const Shape& shape, dSpaceID space, std::vector<PlacedGeom>& geoms);

/// Puts a geom without a body where its shape's frame stands in the world.
void place_geom(const PlacedGeom& geom, const PlumbPose& frame);

/// Puts a geom that belongs to a body at its place relative to the body's centre of mass.
void offset_geom(const PlacedGeom& geom, const PlumbVec3& centre_of_mass);

}  // namespace plumb::ode
