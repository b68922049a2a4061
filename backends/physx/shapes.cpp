#include "shapes.hpp"

#include <utility>

#include "device.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::px {
namespace {

template <class Geometry>
void put(Shape& shape, const Geometry& geometry, const PxTransform& at = PxTransform(PxIdentity)) {
  Piece piece;
  piece.geometry.storeAny(geometry);
  piece.at = at;
  shape.pieces.push_back(piece);
}

void make_capsule(const PlumbShapeDesc& desc, Shape& shape) {
  const float radius = scalar(desc.radius, "radius"), half = scalar(desc.half_height, "half_height");
  if (half > 0)
    put(shape, PxCapsuleGeometry(radius, half), PxTransform(along_y()));
  else
    put(shape, PxSphereGeometry(radius));
}

/// PhysX 5.6.1 has cylinders twice. On meshes its convex cores have contacts that name no triangle, and read beyond the
/// table where triangles have materials: on the CPU its custom geometry is taken, which a GPU does not know.
void make_cylinder(const PlumbShapeDesc& desc, Shape& shape) {
  const float radius = scalar(desc.radius, "radius"), height = scalar(2 * desc.half_height, "half_height");
  if constexpr (kOnGpu) {
    put(shape, PxConvexCoreGeometry(PxConvexCore::Cylinder(height, radius)), PxTransform(along_y()));
    return;
  }
  constexpr int about_y = 1;
  shape.cylinder = std::make_unique<PxCustomGeometryExt::CylinderCallbacks>(height, radius, about_y);
  put(shape, PxCustomGeometry(*shape.cylinder));
}

/// A child has one piece.
void make_compound(const PlumbShapeDesc& desc, std::span<const Shape* const> children, Shape& shape) {
  for (std::uint32_t i = 0; i < desc.child_count; ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    Piece piece = children[i]->pieces.front();
    piece.at = transform(child.pose, "pose of a child") * piece.at;
    piece.child = i;
    piece.has_material = child.has_material != 0;
    piece.material = child.material;
    shape.pieces.push_back(piece);
  }
}

}  // namespace

Shape::~Shape() {
  if (cooked != nullptr) cooked->release();
}

void Shape::swap(Shape& other) {
  std::swap(type, other.type);
  std::swap(pieces, other.pieces);
  std::swap(cooked, other.cooked);
  std::swap(materials, other.materials);
  std::swap(triangles, other.triangles);
}

std::uint32_t Shape::triangle_of(PxU32 face) const {
  if (type != PLUMB_TRIANGLE_MESH) return 0;
  const PxTriangleMesh& mesh = *pieces.front().geometry.triangleMesh().triangleMesh;
  const PxU32* hosts = mesh.getTrianglesRemap();
  if (face >= mesh.getNbTriangles()) return 0;
  return hosts == nullptr ? face : hosts[face];
}

std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::span<const Shape* const> children) {
  auto shape = std::make_unique<Shape>();
  shape->type = desc.type;
  shape->triangles = backend::TriangleMaterials(desc);
  switch (desc.type) {
    case PLUMB_SPHERE: put(*shape, PxSphereGeometry(scalar(desc.radius, "radius"))); break;
    case PLUMB_BOX: put(*shape, PxBoxGeometry(vector(desc.half_extents, "half_extents"))); break;
    case PLUMB_CAPSULE: make_capsule(desc, *shape); break;
    case PLUMB_CYLINDER: make_cylinder(desc, *shape); break;
    case PLUMB_CONVEX_HULL: make_hull(desc, *shape); break;
    case PLUMB_TRIANGLE_MESH: make_mesh(desc, *shape); break;
    case PLUMB_HEIGHT_FIELD: make_height_field(desc, *shape); break;
    case PLUMB_PLANE: put(*shape, PxPlaneGeometry(), PxTransform(along_y())); break;
    default: make_compound(desc, children, *shape); break;
  }
  for (const Piece& piece : shape->pieces)
    if (!PxGeometryQuery::isValid(piece.geometry.any()))
      throw Error(PLUMB_E_INVALID_ARGUMENT,
                  std::string("PhysX holds no ") + backend::shape_name(desc.type) +
                      " of this size: its numbers are too small or too large for single precision");
  return shape;
}

}  // namespace plumb::px
