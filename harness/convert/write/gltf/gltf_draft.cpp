#include "convert/write/gltf/gltf_draft.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/base64.hpp"
#include "convert/scene_text.hpp"

namespace plumb::harness {
namespace {

constexpr const char* physics_extension = "KHR_physics_rigid_bodies";
constexpr const char* shapes_extension = "KHR_implicit_shapes";
// Words of OpenGL.
constexpr int array_buffer = 34962, element_array_buffer = 34963, kind_float = 5126, kind_unsigned = 5125;

static_assert(std::endian::native == std::endian::little, "buffers of glTF are little endian");

void add_number(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// A chunk of a binary file: its length, its kind, its content filled up to whole words.
void add_chunk(std::string& bytes, const char* kind, std::string content, char filling) {
  content.resize((content.size() + 3) / 4 * 4, filling);
  add_number(bytes, static_cast<std::uint32_t>(content.size()));
  bytes.append(kind, 4).append(content);
}

}  // namespace

std::size_t GltfDraft::add_node(const std::string& name, const PlumbPose& pose, std::optional<std::size_t> parent) {
  const std::size_t index = nodes_.size();
  Json node{{"name", name}};
  const PlumbVec3& p = pose.position;
  const PlumbQuat& q = pose.orientation;
  if (p.x != 0 || p.y != 0 || p.z != 0) node["translation"] = {p.x, p.y, p.z};
  if (q.x != 0 || q.y != 0 || q.z != 0) node["rotation"] = {q.x, q.y, q.z, q.w};
  nodes_.push_back(std::move(node));
  (parent ? nodes_[*parent]["children"] : roots_).push_back(index);
  return index;
}

Json& GltfDraft::physics(std::size_t node) { return nodes_[node]["extensions"][physics_extension]; }

std::size_t GltfDraft::add_once(Json& list, const Json& entry) {
  const auto found = std::find(list.begin(), list.end(), entry);
  const auto index = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(entry);
  return index;
}

Json GltfDraft::view_of(const void* data, std::size_t size, int target) {
  views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}, {"target", target}});
  bytes_.append(static_cast<const char*>(data), size);
  return {{"bufferView", views_.size() - 1}};
}

std::size_t GltfDraft::add_mesh(const Model& surface) {
  const std::vector<float> corners(surface.vertices.begin(), surface.vertices.end());
  std::vector<float> low(3, std::numeric_limits<float>::max()), high(3, std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], corners[i]);
    high[i % 3] = std::max(high[i % 3], corners[i]);
  }
  Json positions = view_of(corners.data(), corners.size() * sizeof(float), array_buffer);
  positions.update(
      {{"componentType", kind_float}, {"count", corners.size() / 3}, {"type", "VEC3"}, {"min", low}, {"max", high}});
  Json indices = view_of(surface.indices.data(), surface.indices.size() * sizeof(std::uint32_t), element_array_buffer);
  indices.update({{"componentType", kind_unsigned}, {"count", surface.indices.size()}, {"type", "SCALAR"}});
  accessors_.push_back(std::move(positions));
  accessors_.push_back(std::move(indices));
  Json primitive{{"attributes", {{"POSITION", accessors_.size() - 2}}}, {"indices", accessors_.size() - 1}};
  meshes_.push_back({{"primitives", Json::array({std::move(primitive)})}});
  return meshes_.size() - 1;
}

/// Lists that are empty are none: glTF forbids them.
Json GltfDraft::file() const {
  Json file{{"asset", {{"version", "2.0"}, {"generator", "plumb convert"}}}};
  file["extensionsUsed"] = Json::array({physics_extension});
  if (!shapes_.empty()) file["extensionsUsed"].push_back(shapes_extension);
  file["scene"] = 0;
  file["scenes"] = Json::array({{{"nodes", roots_}}});
  file["nodes"] = nodes_;
  for (const auto& [key, list] : {std::pair("meshes", &meshes_), {"accessors", &accessors_}, {"bufferViews", &views_}})
    if (!list->empty()) file[key] = *list;
  if (!bytes_.empty()) file["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  file["extensions"][physics_extension] = rigid_bodies_;
  if (!shapes_.empty()) file["extensions"][shapes_extension]["shapes"] = shapes_;
  return file;
}

std::string GltfDraft::text() const {
  Json whole = file();
  if (!bytes_.empty()) whole["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes_);
  return scene_text(whole);
}

std::string GltfDraft::binary() const {
  std::string chunks;
  add_chunk(chunks, "JSON", line_of(file()), ' ');
  if (!bytes_.empty()) add_chunk(chunks, "BIN\0", bytes_, '\0');
  std::string whole = "glTF";
  add_number(whole, 2);
  add_number(whole, static_cast<std::uint32_t>(whole.size() + sizeof(std::uint32_t) + chunks.size()));
  return whole + chunks;
}

}  // namespace plumb::harness
