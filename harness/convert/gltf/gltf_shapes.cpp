#include "convert/gltf/gltf_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace plumb::harness {
namespace {

using nlohmann::json;
using referee::Vec3;

/// Points on a ball of this radius about a point on the y axis.
void add_ball(std::vector<double>& points, double radius, double height) {
  for (const PlumbVec3& direction : even_directions(32))
    points.insert(points.end(), {radius * direction.x, height + radius * direction.y, radius * direction.z});
}

void add_circle(std::vector<double>& points, double radius, double height) {
  constexpr int corners = 32;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.insert(points.end(), {radius * std::cos(angle), height, radius * std::sin(angle)});
  }
}

SceneShape tapered(double bottom, double top, double half_height, bool capsule) {
  SceneShape shape;
  shape.desc = shape_desc(PLUMB_CONVEX_HULL);
  const auto add = capsule ? add_ball : add_circle;
  add(shape.vertices, bottom, -half_height);
  add(shape.vertices, top, half_height);
  return shape;
}

SceneShape round_shape(const json& numbers, const Vec3& scale, bool capsule, const std::string& name,
                       Remarks& remarks) {
  const double wide = std::max(scale.x(), scale.z());
  const double bottom = wide * member(numbers, "radiusBottom", 0.25), top = wide * member(numbers, "radiusTop", 0.25);
  const double half_height = scale.y() * member(numbers, "height", 0.5) / 2;
  if (scale.x() != scale.z()) remarks.add("round shapes that are scaled unevenly are as wide as their widest", name);
  if (bottom == top) return capsule ? capsule_shape(bottom, half_height) : cylinder_shape(bottom, half_height);
  remarks.add("cones and tapered capsules are hulls of 64 corners", name);
  return tapered(bottom, top, half_height, capsule);
}

SceneShape implicit_shape(const GltfFile& file, std::size_t index, const Vec3& scale, const std::string& name,
                          Remarks& remarks) {
  const json& shape = file.shapes.at("shapes").at(index);
  const auto type = shape.at("type").get<std::string>();
  const json numbers = shape.contains(type) ? shape.at(type) : json::object();
  if (type == "box") return box_shape_of(vector_member(numbers, "size", Vec3::Ones()).cwiseProduct(scale) / 2);
  if (type == "sphere") {
    const double radius = member(numbers, "radius", 0.5);
    if (scale.isApproxToConstant(scale.x(), 1e-9)) return sphere_shape(radius * scale.x());
    remarks.add("ellipsoids are hulls of 64 corners", name);
    return ellipsoid_shape(radius * scale);
  }
  if (type == "capsule" || type == "cylinder") return round_shape(numbers, scale, type == "capsule", name, remarks);
  if (type == "plane") {
    if (numbers.contains("sizeX") || numbers.contains("sizeZ")) remarks.add("planes have no end", name);
    return plane_shape();
  }
  throw UsageError(
      fmt::format("the shape of \"{}\" is a {}; known are box, sphere, capsule, cylinder and plane", name, type));
}

std::vector<std::uint32_t> indices_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                      std::size_t vertices) {
  std::vector<std::uint32_t> indices;
  if (primitive.indices < 0) {
    for (std::uint32_t i = 0; i < vertices; ++i) indices.push_back(i);
    return indices;
  }
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(primitive.indices));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const std::vector<unsigned char>& bytes = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  const auto size =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
  const auto stride = static_cast<std::size_t>(accessor.ByteStride(view));
  for (std::size_t i = 0; i < accessor.count; ++i) {
    std::uint32_t index = 0;
    for (std::size_t byte = 0; byte < size; ++byte)
      index |= std::uint32_t{bytes.at(view.byteOffset + accessor.byteOffset + i * stride + byte)} << (8 * byte);
    if (index >= vertices) throw UsageError("a triangle names a vertex that is not there");
    indices.push_back(index);
  }
  return indices;
}

std::vector<Vec3> positions_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const tinygltf::Accessor& accessor =
      model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("POSITION")));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const std::vector<unsigned char>& bytes = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  const auto stride = static_cast<std::size_t>(accessor.ByteStride(view));
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < accessor.count; ++i) {
    const std::size_t at = view.byteOffset + accessor.byteOffset + i * stride;
    std::array<float, 3> v{};
    if (at + sizeof(v) > bytes.size()) throw UsageError("a mesh lies beyond the end of its buffer");
    std::memcpy(v.data(), &bytes[at], sizeof(v));
    positions.emplace_back(v[0], v[1], v[2]);
  }
  return positions;
}

/// The triangles of a node's mesh and of those of its children.
void add_meshes(const tinygltf::Model& model, int node, const Eigen::Affine3d& within, Model& surface) {
  const tinygltf::Node& read = model.nodes.at(static_cast<std::size_t>(node));
  if (read.mesh >= 0)
    for (const tinygltf::Primitive& primitive : model.meshes.at(static_cast<std::size_t>(read.mesh)).primitives) {
      if (primitive.mode != TINYGLTF_MODE_TRIANGLES) continue;
      const auto first = static_cast<std::uint32_t>(surface.vertices.size() / 3);
      const std::vector<Vec3> positions = positions_of(model, primitive);
      for (const Vec3& p : positions) {
        const Vec3 v = within * p;
        surface.vertices.insert(surface.vertices.end(), v.begin(), v.end());
      }
      std::vector<std::uint32_t> indices = indices_of(model, primitive, positions.size());
      const bool mirrored = within.linear().determinant() < 0;
      for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (mirrored) std::swap(indices[i + 1], indices[i + 2]);
        for (std::size_t corner = 0; corner < 3; ++corner) surface.indices.push_back(first + indices[i + corner]);
      }
    }
  for (const int child : read.children)
    add_meshes(model, child, within * local_of(model.nodes.at(static_cast<std::size_t>(child))), surface);
}

PlumbMaterial material_of(const GltfFile& file, const json& collider, const std::string& name, Remarks& remarks) {
  PlumbMaterial material{};
  json read = json::object();
  if (collider.contains("physicsMaterial"))
    read = file.rigid_bodies.at("physicsMaterials").at(collider.at("physicsMaterial").get<std::size_t>());
  material.friction = member(read, "dynamicFriction", 0.6);
  material.restitution = std::clamp(member(read, "restitution", 0.0), 0.0, 1.0);
  if (member(read, "staticFriction", material.friction) != material.friction)
    remarks.add("friction at rest is that of sliding", name);
  return material;
}

}  // namespace

LinkShape collider_shape(const GltfFile& file, int node, const referee::Pose& body, bool moves, Remarks& remarks) {
  const std::string name = file.name(node);
  const json& collider = file.physics[static_cast<std::size_t>(node)].at("collider");
  const json& geometry = collider.at("geometry");
  const NodePlace& place = file.place[static_cast<std::size_t>(node)];
  LinkShape part{{}, place.pose.seen_from(body), material_of(file, collider, name, remarks)};
  if (geometry.contains("shape")) {
    const Vec3 scale = place.whole.linear().colwise().norm().transpose();
    part.shape = implicit_shape(file, geometry.at("shape").get<std::size_t>(), scale, name, remarks);
    return part;
  }
  Eigen::Affine3d within = place.whole;  // as the node's rigid frame sees it
  within.linear() = place.pose.rotation.transpose() * place.whole.linear();
  within.translation().setZero();
  Model surface;
  add_meshes(file.model, geometry.at("node").get<int>(), within, surface);
  if (surface.indices.empty())
    throw UsageError(fmt::format("the collider of \"{}\" names a node without triangles", name));
  const bool hull = moves || member(geometry, "convexHull", false);
  part.shape = surface_shape(surface, hull, name, remarks);
  return part;
}

}  // namespace plumb::harness
