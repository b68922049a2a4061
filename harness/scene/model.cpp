#include "scene/model.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "base/usage_error.hpp"

namespace plumb::harness {
namespace {

using Point = std::array<float, 3>;

/// The triangles of a file in its own units and axes.
struct Surface {
  std::vector<Point> points;
  std::vector<std::uint32_t> corners;
};

/// Points at one place are one, whatever normals and texture coordinates told them apart.
class SurfaceBuilder {
 public:
  void add(const aiMesh& mesh) {
    for (unsigned face = 0; face < mesh.mNumFaces; ++face)
      if (mesh.mFaces[face].mNumIndices == 3) add(mesh, mesh.mFaces[face]);
  }
  [[nodiscard]] Surface take() { return std::move(surface_); }

 private:
  void add(const aiMesh& mesh, const aiFace& face) {
    std::array<std::uint32_t, 3> corners{};
    for (unsigned i = 0; i < 3; ++i) {
      const aiVector3D& v = mesh.mVertices[face.mIndices[i]];
      const Point point{v.x, v.y, v.z};
      const auto [place, is_new] = places_.emplace(point, static_cast<std::uint32_t>(surface_.points.size()));
      if (is_new) surface_.points.push_back(point);
      corners[i] = place->second;
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    surface_.corners.insert(surface_.corners.end(), corners.begin(), corners.end());
  }

  Surface surface_;
  std::map<Point, std::uint32_t> places_;
};

Surface read_surface(const std::filesystem::path& file) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // what refers to it means its own axes
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  SurfaceBuilder builder;
  for (unsigned mesh = 0; mesh < scene->mNumMeshes; ++mesh) builder.add(*scene->mMeshes[mesh]);
  Surface surface = builder.take();
  if (surface.corners.empty()) throw std::runtime_error("it holds no triangles");
  return surface;
}

/// A scene file is instantiated many times; its models are read once.
const Surface& known_surface(const std::filesystem::path& file) {
  static std::map<std::filesystem::path, Surface> surfaces;
  auto found = surfaces.find(file);
  if (found == surfaces.end()) found = surfaces.emplace(file, read_surface(file)).first;
  return found->second;
}

}  // namespace

std::optional<Model> load_model(const ModelRequest& request) {
  if (!std::filesystem::is_regular_file(request.file)) return std::nullopt;
  const Surface& surface = known_surface(request.file);
  Eigen::AlignedBox3d box;
  for (const Point& p : surface.points) box.extend(Eigen::Vector3d(p[0], p[1], p[2]));
  const double scale = request.size / box.sizes().maxCoeff();
  const PlumbQuat& q = request.orientation;
  const Eigen::Matrix3d turn = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  Model model;
  model.indices = surface.corners;
  for (const Point& p : surface.points) {
    const Eigen::Vector3d v = scale * (turn * (Eigen::Vector3d(p[0], p[1], p[2]) - box.center()));
    model.vertices.insert(model.vertices.end(), {v.x(), v.y(), v.z()});
  }
  return model;
}

Model load_surface(const std::filesystem::path& file, const PlumbVec3& scale) try {
  const Surface& surface = known_surface(file);
  Model model;
  model.indices = surface.corners;
  if (scale.x * scale.y * scale.z < 0)
    for (std::size_t i = 0; i < model.indices.size(); i += 3) std::swap(model.indices[i + 1], model.indices[i + 2]);
  for (const Point& p : surface.points)
    model.vertices.insert(model.vertices.end(), {scale.x * p[0], scale.y * p[1], scale.z * p[2]});
  return model;
} catch (const std::runtime_error& error) {
  throw UsageError(file.string() + ": " + error.what());
}

std::vector<PlumbVec3> even_directions(std::size_t count) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<PlumbVec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double across = std::sqrt(1 - y * y), angle = golden * static_cast<double>(i);
    directions.push_back({across * std::cos(angle), y, across * std::sin(angle)});
  }
  return directions;
}

std::vector<double> extreme_points(const Model& model, std::size_t count) {
  const auto points = Eigen::Map<const Eigen::Matrix3Xd>(model.vertices.data(), 3,
                                                         static_cast<Eigen::Index>(model.vertices.size() / 3));
  std::set<Eigen::Index> chosen;
  for (const PlumbVec3& direction : even_directions(count)) {
    Eigen::Index furthest = 0;
    (Eigen::RowVector3d(direction.x, direction.y, direction.z) * points).maxCoeff(&furthest);
    chosen.insert(furthest);
  }
  std::vector<double> corners;
  for (const Eigen::Index i : chosen) corners.insert(corners.end(), {points(0, i), points(1, i), points(2, i)});
  return corners;
}

}  // namespace plumb::harness
