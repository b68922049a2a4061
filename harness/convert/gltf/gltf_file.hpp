// A glTF file: its nodes with their places in the world, and what its physics extensions say.
#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "referee/pose.hpp"

namespace plumb::harness {

/// A node's place in the world, which may scale: its pose is the rigid part of it.
struct NodePlace {
  referee::Pose pose;
  Eigen::Affine3d whole = Eigen::Affine3d::Identity();
};

struct GltfFile {
  /// Throws UsageError.
  explicit GltfFile(const std::filesystem::path& file);

  tinygltf::Model model;
  std::vector<int> nodes;               ///< of the default scene, parents first
  std::vector<int> parent;              ///< by node; -1: none
  std::vector<NodePlace> place;         ///< by node
  std::vector<nlohmann::json> physics;  ///< by node: its KHR_physics_rigid_bodies, or null
  nlohmann::json rigid_bodies, shapes;  ///< of the whole file; null where it has none

  [[nodiscard]] std::string name(int node) const;
  /// The nearest node, itself or above, that has motion; none: it belongs to the world.
  [[nodiscard]] std::optional<int> body_of(int node) const;
};

/// A node's place in its parent.
[[nodiscard]] Eigen::Affine3d local_of(const tinygltf::Node& node);

/// A member of an object, or `otherwise`.
template <class T>
[[nodiscard]] T member(const nlohmann::json& json, const char* key, const T& otherwise) {
  return json.is_object() && json.contains(key) ? json.at(key).get<T>() : otherwise;
}

/// Three numbers.
[[nodiscard]] inline referee::Vec3 vector_member(const nlohmann::json& json, const char* key,
                                                 const referee::Vec3& otherwise) {
  const auto numbers = member<std::vector<double>>(json, key, {otherwise.x(), otherwise.y(), otherwise.z()});
  return numbers.size() == 3 ? referee::Vec3(numbers[0], numbers[1], numbers[2]) : otherwise;
}

}  // namespace plumb::harness
