// A glTF file as it is written: nodes with physics, and the bytes of meshes.
#pragma once

#include <optional>
#include <string>

#include "base/json.hpp"
#include "referee/pose.hpp"
#include "scene/model.hpp"

namespace plumb::harness {

class GltfDraft {
 public:
  /// A node with this place in another or in the world.
  std::size_t add_node(const std::string& name, const PlumbPose& pose, std::optional<std::size_t> parent = {});
  /// A mesh that nodes may have.
  std::size_t add_mesh(const Model& surface);

  [[nodiscard]] Json& node(std::size_t index) { return nodes_[index]; }
  /// What KHR_physics_rigid_bodies says of a node.
  [[nodiscard]] Json& physics(std::size_t node);
  /// Appends to a list of KHR_physics_rigid_bodies, unless there is an equal one; the index.
  std::size_t add(const char* list, const Json& entry) { return add_once(rigid_bodies_[list], entry); }
  /// Likewise to the shapes of KHR_implicit_shapes.
  std::size_t add_shape(const Json& shape) { return add_once(shapes_, shape); }

  /// The whole file as text, or in the binary form (.glb).
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string binary() const;

 private:
  static std::size_t add_once(Json& list, const Json& entry);
  [[nodiscard]] Json file() const;
  /// Bytes of a mesh that an accessor reads; the accessor.
  Json view_of(const void* data, std::size_t size, int target);

  Json nodes_ = Json::array(), roots_ = Json::array(), meshes_ = Json::array(), accessors_ = Json::array(),
       views_ = Json::array(), shapes_ = Json::array(), rigid_bodies_ = Json::object();
  std::string bytes_;
};

}  // namespace plumb::harness
