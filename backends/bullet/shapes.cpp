#include "shapes.hpp"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>

#include "plumb/assert.hpp"

namespace plumb::bullet {
namespace {

/// btConvexInternalShape::setSafeMargin keeps margins under this share of the smallest half extent.
constexpr double kSafeMargin = 0.1;
constexpr double kDefaultMargin = 0.04;

void set_margin(btConvexInternalShape& shape, double margin, double smallest_half_extent) {
  if (margin != kDefaultMargin)
    shape.setMargin(static_cast<btScalar>(std::min(margin, kSafeMargin * smallest_half_extent)));
}

std::unique_ptr<btCollisionShape> make_box(const PlumbShapeDesc& desc, const ShapeOptions& options) {
  const PlumbVec3& half = desc.half_extents;
  const double least = std::min({half.x, half.y, half.z});
  positive_scalar(least, "half_extents");
  auto box = std::make_unique<btBoxShape>(vector(half, "half_extents"));
  set_margin(*box, options.margin, least);
  return box;
}

std::unique_ptr<btCollisionShape> make_cylinder(const PlumbShapeDesc& desc, const ShapeOptions& options) {
  const btScalar radius = positive_scalar(desc.radius, "radius");
  auto cylinder =
      std::make_unique<btCylinderShape>(btVector3(radius, positive_scalar(desc.half_height, "half_height"), radius));
  set_margin(*cylinder, options.margin, std::min(desc.radius, desc.half_height));
  return cylinder;
}

/// Bullet adds its margin outside of a hull: move the faces inward by as much, so that the surface is where it should
/// be (edges and corners are rounded by the margin).
std::unique_ptr<btCollisionShape> make_hull(const PlumbShapeDesc& desc, const ShapeOptions& options) {
  btScalar largest = 0;
  for (std::size_t i = 0; i < std::size_t{desc.vertex_count} * 3; ++i)
    largest = std::max(largest, std::abs(scalar(desc.vertices[i], "vertices")));
  positive_scalar(largest, "the largest coordinate of the vertices");
  btConvexHullComputer hull;
  const btScalar shrunk = hull.compute(desc.vertices, 3 * sizeof(double), static_cast<int>(desc.vertex_count),
                                       static_cast<btScalar>(options.margin), static_cast<btScalar>(kSafeMargin));
  auto shape = std::make_unique<btConvexHullShape>();
  if (shrunk >= 0 && hull.vertices.size() >= 4) {
    for (int i = 0; i < hull.vertices.size(); ++i) shape->addPoint(hull.vertices[i], false);
    shape->setMargin(shrunk);
  } else {
    for (std::uint32_t i = 0; i < desc.vertex_count; ++i)
      shape->addPoint(vector(desc.vertices + 3 * i, "vertices"), false);
    shape->setMargin(0);
  }
  shape->recalcLocalAabb();
  if (options.hull_clipping) shape->initializePolyhedralFeatures();
  return shape;
}

std::vector<btScalar> vertices_of(const PlumbShapeDesc& desc) {
  std::vector<btScalar> vertices;
  for (std::size_t i = 0; i < std::size_t{desc.vertex_count} * 3; ++i)
    vertices.push_back(scalar(desc.vertices[i], "vertices"));
  return vertices;
}

void make_mesh(const PlumbShapeDesc& desc, Shape& shape) {
  take_triangles(desc, shape);
  shape.bullet = std::make_unique<btBvhTriangleMeshShape>(shape.mesh.get(), desc.triangle_count < kQuantizedTriangles);
}

/// Bullet puts the origin in the middle of the least and greatest height: bounds that are symmetric leave it at 0.
void make_height_field(const PlumbShapeDesc& desc, Shape& shape) {
  btScalar bound = 0;
  for (std::size_t i = 0; i < std::size_t{desc.rows} * desc.columns; ++i) {
    shape.heights.push_back(scalar(desc.heights[i], "heights"));
    bound = std::max(bound, std::abs(shape.heights.back()));
  }
  auto field = std::make_unique<btHeightfieldTerrainShape>(static_cast<int>(desc.columns), static_cast<int>(desc.rows),
                                                           shape.heights.data(), -bound, bound, 1, false);
  field->setLocalScaling(
      btVector3(positive_scalar(desc.spacing.x, "spacing.x"), 1, positive_scalar(desc.spacing.z, "spacing.z")));
  shape.bullet = std::move(field);
}

void add_children(btCompoundShape& compound, const Shape& shape, const btTransform& offset, bool identity) {
  for (const Shape::Child& child : shape.children) {
    PLUMB_ASSERT(child.shape != nullptr && child.shape->type != PLUMB_COMPOUND);
    compound.addChildShape(identity ? child.pose : offset * child.pose, child.shape->bullet.get());
  }
}

double inner_radius(const PlumbShapeDesc& desc, const Shape& shape) {
  switch (desc.type) {
    case PLUMB_SPHERE:
    case PLUMB_CAPSULE: return desc.radius;
    case PLUMB_BOX: return std::min({desc.half_extents.x, desc.half_extents.y, desc.half_extents.z});
    case PLUMB_CYLINDER: return std::min(desc.radius, desc.half_height);
    case PLUMB_CONVEX_HULL: {
      btVector3 lower, upper;
      shape.bullet->getAabb(btTransform::getIdentity(), lower, upper);
      const btVector3 half = (upper - lower) / 2;
      return std::min({half.x(), half.y(), half.z()});
    }
    default: return 0;
  }
}

}  // namespace

void take_triangles(const PlumbShapeDesc& desc, Shape& shape) {
  shape.vertices = vertices_of(desc);
  shape.indices.assign(desc.indices, desc.indices + std::size_t{desc.triangle_count} * 3);
  index_triangles(shape);
}

void index_triangles(Shape& shape) {
  auto mesh = std::make_unique<btTriangleIndexVertexArray>();
  mesh->addIndexedMesh(indexed_mesh(shape.vertices, shape.indices), PHY_INTEGER);
  shape.mesh = std::move(mesh);
}

bool Shape::has_own_material() const {
  return !materials.empty() ||
         std::any_of(children.begin(), children.end(), [](const Child& child) { return child.has_material; });
}

std::shared_ptr<const Shape> make_shape(const PlumbShapeDesc& desc, std::vector<Shape::Child> children,
                                        const ShapeOptions& options) {
  auto shape = std::make_shared<Shape>();
  shape->type = desc.type;
  shape->materials = backend::TriangleMaterials(desc);
  switch (desc.type) {
    case PLUMB_SPHERE: shape->bullet = std::make_unique<btSphereShape>(positive_scalar(desc.radius, "radius")); break;
    case PLUMB_BOX: shape->bullet = make_box(desc, options); break;
    case PLUMB_CAPSULE:
      shape->bullet = std::make_unique<btCapsuleShape>(positive_scalar(desc.radius, "radius"),
                                                       2 * scalar(desc.half_height, "half_height"));
      break;
    case PLUMB_CYLINDER: shape->bullet = make_cylinder(desc, options); break;
    case PLUMB_CONVEX_HULL:
      shape->bullet = make_hull(desc, options);
      shape->vertices = vertices_of(desc);
      break;
    case PLUMB_TRIANGLE_MESH: make_mesh(desc, *shape); break;
    case PLUMB_HEIGHT_FIELD: make_height_field(desc, *shape); break;
    case PLUMB_PLANE: shape->bullet = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)); break;
    case PLUMB_COMPOUND: {
      shape->children = std::move(children);
      auto compound = std::make_unique<btCompoundShape>();
      add_children(*compound, *shape, btTransform::getIdentity(), true);
      shape->bullet = std::move(compound);
      break;
    }
    default: throw Error(PLUMB_E_UNSUPPORTED, "Bullet has no shape of type " + std::to_string(desc.type));
  }
  PLUMB_ASSERT(shape->bullet != nullptr);
  shape->inner_radius = inner_radius(desc, *shape);
  return shape;
}

btIndexedMesh indexed_mesh(const std::vector<btScalar>& vertices, const std::vector<int>& indices) {
  PLUMB_ASSERT(vertices.size() % 3 == 0 && indices.size() % 3 == 0);
  btIndexedMesh mesh;
  mesh.m_numTriangles = static_cast<int>(indices.size() / 3);
  mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
  mesh.m_triangleIndexStride = 3 * sizeof(int);
  mesh.m_numVertices = static_cast<int>(vertices.size() / 3);
  mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices.data());
  mesh.m_vertexStride = 3 * sizeof(btScalar);
  return mesh;
}

std::unique_ptr<btCollisionShape> make_offset_shape(const Shape& shape, const btTransform& offset) {
  auto compound = std::make_unique<btCompoundShape>();
  if (shape.type == PLUMB_COMPOUND)
    add_children(*compound, shape, offset, false);
  else
    compound->addChildShape(offset, shape.bullet.get());
  return compound;
}

}  // namespace plumb::bullet
