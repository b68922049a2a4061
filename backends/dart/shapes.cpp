#include "shapes.hpp"

#include <assimp/scene.h>

#include <array>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "plumb/backend/convex_hull.hpp"

namespace plumb::dart6 {
namespace {

using Triangle = std::array<PlumbVec3, 3>;

std::vector<Triangle> triangles_of_hull(const PlumbShapeDesc& desc) {
  const backend::ConvexHull hull = backend::convex_hull(desc);
  std::vector<Triangle> out;
  for (const auto& corners : hull.triangles)
    out.push_back({hull.vertices[corners[0]], hull.vertices[corners[1]], hull.vertices[corners[2]]});
  return out;
}

std::vector<Triangle> triangles_of_mesh(const PlumbShapeDesc& desc) {
  const auto vertex = [&](std::size_t corner) {
    const double* v = desc.vertices + std::size_t{3} * desc.indices[corner];
    return PlumbVec3{v[0], v[1], v[2]};
  };
  std::vector<Triangle> out;
  for (std::size_t i = 0; i < std::size_t{3} * desc.triangle_count; i += 3)
    out.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
  return out;
}

/// Cells are cut as shapes.h says, which DART's own height maps do not promise.
std::vector<Triangle> triangles_of_field(const PlumbShapeDesc& desc) {
  const auto point = [&](std::uint32_t r, std::uint32_t c) {
    return PlumbVec3{(c - (desc.columns - 1) / 2.0) * desc.spacing.x, desc.heights[r * desc.columns + c],
                     (r - (desc.rows - 1) / 2.0) * desc.spacing.z};
  };
  std::vector<Triangle> out;
  for (std::uint32_t r = 0; r + 1 < desc.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < desc.columns; ++c) {
      out.push_back({point(r, c), point(r + 1, c), point(r, c + 1)});
      out.push_back({point(r + 1, c + 1), point(r, c + 1), point(r + 1, c)});
    }
  return out;
}

aiVector3D to_assimp(const PlumbVec3& v) {
  return {static_cast<ai_real>(v.x), static_cast<ai_real>(v.y), static_cast<ai_real>(v.z)};
}

/// DART hands ODE one normal a vertex where it reads one a triangle; so each triangle has corners of its own, of which
/// there are enough for the first normals to be those of the triangles.
void fill(aiMesh& mesh, const std::vector<Triangle>& triangles) {
  mesh.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh.mNumFaces = static_cast<unsigned>(triangles.size());
  mesh.mNumVertices = 3 * mesh.mNumFaces;
  mesh.mVertices = new aiVector3D[mesh.mNumVertices];
  mesh.mNormals = new aiVector3D[mesh.mNumVertices];
  mesh.mFaces = new aiFace[mesh.mNumFaces];
  for (unsigned t = 0; t < mesh.mNumFaces; ++t) {
    const Triangle& corners = triangles[t];
    const PlumbVec3 across = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
    mesh.mNormals[t] = to_assimp(length(across) > 0 ? normalized(across) : unit(1));
    aiFace& face = mesh.mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (unsigned k = 0; k < 3; ++k) {
      mesh.mVertices[3 * t + k] = to_assimp(corners[k]);
      face.mIndices[k] = 3 * t + k;
    }
  }
}

/// DART has meshes as scenes of assimp's, which it frees.
::dart::dynamics::ShapePtr make_mesh(const std::vector<Triangle>& triangles) {
  auto mesh = std::make_unique<aiMesh>();
  fill(*mesh, triangles);
  auto scene = std::make_unique<aiScene>();
  scene->mMeshes = new aiMesh*[1];
  scene->mMeshes[0] = mesh.release();
  scene->mNumMeshes = 1;
  return std::make_shared<::dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), scene.release());
}

::dart::dynamics::ShapePtr make_geometry(const PlumbShapeDesc& desc) {
  using namespace ::dart::dynamics;
  switch (desc.type) {
    case PLUMB_SPHERE: return std::make_shared<SphereShape>(desc.radius);
    case PLUMB_BOX: return std::make_shared<BoxShape>(2 * eigen(desc.half_extents));
    case PLUMB_CAPSULE:  // one without a length would be refused
      return std::make_shared<CapsuleShape>(desc.radius, std::max(2 * desc.half_height, 1e-9));
    case PLUMB_CYLINDER: return std::make_shared<CylinderShape>(desc.radius, 2 * desc.half_height);
    case PLUMB_PLANE: return std::make_shared<PlaneShape>(Eigen::Vector3d::UnitY(), 0);
    case PLUMB_CONVEX_HULL: return make_mesh(triangles_of_hull(desc));
    case PLUMB_TRIANGLE_MESH: return make_mesh(triangles_of_mesh(desc));
    case PLUMB_HEIGHT_FIELD: return make_mesh(triangles_of_field(desc));
    default: return nullptr;
  }
}

/// m, from a shape's origin: beyond it ODE cannot count the cells in which it looks for pairs, and ends the process.
constexpr double kFarthest = 1e8;

void require_near(const Eigen::Vector3d& middle) {
  if (middle.cwiseAbs().sum() < kFarthest) return;
  throw Error(PLUMB_E_UNSUPPORTED, "the middle of a shape, or of a compound's child, is " +
                                       std::to_string(middle.norm()) +
                                       " m from the origin, and for ODE within DART it is less than 1e8 m; move the "
                                       "body, and its shape to its origin");
}

}  // namespace

std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::vector<const Shape*> children) {
  auto shape = std::make_unique<Shape>();
  shape->type = desc.type;
  shape->geometry = make_geometry(desc);
  if (desc.type == PLUMB_CAPSULE || desc.type == PLUMB_CYLINDER) shape->frame.orientation = kZToY;
  if (shape->geometry && desc.type != PLUMB_PLANE) require_near(shape->geometry->getBoundingBox().computeCenter());
  for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    require_near(eigen(child.pose.position));
    shape->children.push_back({children[i], child.pose, child.has_material != 0, child.material});
  }
  return shape;
}

}  // namespace plumb::dart6
