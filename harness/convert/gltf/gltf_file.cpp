#include "convert/gltf/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/shown.hpp"
#include "base/usage_error.hpp"

namespace plumb::harness {
namespace {

using nlohmann::json;

constexpr const char* rigid_bodies_extension = "KHR_physics_rigid_bodies";
constexpr const char* shapes_extension = "KHR_implicit_shapes";

tinygltf::Model load(const std::filesystem::path& file) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](auto...) { return true; }, nullptr);  // nobody looks at pictures here
  loader.SetStoreOriginalJSONForExtrasAndExtensions(true);
  tinygltf::Model model;
  std::string error, warning;
  const bool binary = file.extension() == ".glb";
  const bool read = binary ? loader.LoadBinaryFromFile(&model, &error, &warning, file.string())
                           : loader.LoadASCIIFromFile(&model, &error, &warning, file.string());
  while (!error.empty() && error.back() == '\n') error.pop_back();
  if (!read)
    throw UsageError(
        fmt::format("{}: {}", file.string(), error.empty() ? "it is no glTF file" : shortened(error, 500)));
  return model;
}

/// tinygltf keeps a thing's extensions as the text that they were.
json extension(const std::string& text, const char* name) {
  if (text.empty()) return nullptr;
  const json all = json::parse(text);
  return all.contains(name) ? all.at(name) : json(nullptr);
}

referee::Pose rigid_part(const Eigen::Affine3d& whole) {
  referee::Mat3 rotation = whole.linear();
  for (int axis = 0; axis < 3; ++axis) {
    const double length = rotation.col(axis).norm();
    if (length > 0) rotation.col(axis) /= length;
  }
  if (rotation.determinant() < 0) rotation = -rotation;
  return {referee::Quat(rotation).normalized().toRotationMatrix(), whole.translation()};
}

}  // namespace

Eigen::Affine3d local_of(const tinygltf::Node& node) {
  Eigen::Affine3d local = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    local.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return local;
  }
  if (node.translation.size() == 3) local.translate(Eigen::Vector3d(node.translation.data()));
  if (const auto& q = node.rotation; q.size() == 4)
    local.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
  if (node.scale.size() == 3) local.scale(Eigen::Vector3d(node.scale.data()));
  return local;
}

GltfFile::GltfFile(const std::filesystem::path& file) try : model(load(file)) {
  const std::size_t count = model.nodes.size();
  parent.assign(count, -1);
  place.resize(count);
  physics.resize(count);
  rigid_bodies = extension(model.extensions_json_string, rigid_bodies_extension);
  shapes = extension(model.extensions_json_string, shapes_extension);
  for (std::size_t i = 0; i < count; ++i)
    physics[i] = extension(model.nodes[i].extensions_json_string, rigid_bodies_extension);
  if (model.scenes.empty()) throw UsageError(file.string() + ": it has no scene");
  nodes = model.scenes.at(static_cast<std::size_t>(std::max(0, model.defaultScene))).nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {  // which grows meanwhile
    if (nodes.size() > count) throw UsageError(file.string() + ": a node stands in it twice");
    const auto node = static_cast<std::size_t>(nodes[i]);
    const tinygltf::Node& read = model.nodes.at(node);
    const int above = parent[node];
    const Eigen::Affine3d outer =
        above < 0 ? Eigen::Affine3d::Identity() : place[static_cast<std::size_t>(above)].whole;
    place[node].whole = outer * local_of(read);
    place[node].pose = rigid_part(place[node].whole);
    for (const int child : read.children) {
      parent.at(static_cast<std::size_t>(child)) = nodes[i];
      nodes.push_back(child);
    }
  }
} catch (const json::exception& error) {
  throw UsageError(fmt::format("{}: {}", file.string(), error.what()));
} catch (const std::out_of_range&) {
  throw UsageError(file.string() + ": it names a node or scene that is not in it");
}

std::string GltfFile::name(int node) const {
  const std::string& name = model.nodes[static_cast<std::size_t>(node)].name;
  return name.empty() ? fmt::format("node{}", node) : name;
}

std::optional<int> GltfFile::body_of(int node) const {
  for (; node >= 0; node = parent[static_cast<std::size_t>(node)])
    if (physics[static_cast<std::size_t>(node)].contains("motion")) return node;
  return std::nullopt;
}

}  // namespace plumb::harness
