// Look-ups in a scene whose parameters have values.
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plumb/nearest.hpp"

namespace plumb::harness {
namespace {

template <class Items>
std::size_t find_item(const Items& items, const std::string& what, const std::string& name, const std::string& scene) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return i;
  std::vector<std::string> known;
  for (const auto& item : items) known.push_back(item.name);
  throw UsageError(fmt::format("scene {}: unknown {} \"{}\"{}", scene, what, name, suggestion(name, known)));
}

}  // namespace

PlumbShapeDesc SceneShape::descriptor() const {
  PlumbShapeDesc full = desc;
  full.vertices = vertices.empty() ? nullptr : vertices.data();
  full.indices = indices.empty() ? nullptr : indices.data();
  full.heights = heights.empty() ? nullptr : heights.data();
  full.materials = materials.data();
  full.material_count = static_cast<std::uint32_t>(materials.size());
  full.triangle_materials = triangle_materials.data();
  full.children = nullptr;
  full.child_count = 0;
  return full;
}

bool Scene::has_part_materials() const {
  return std::any_of(shapes.begin(), shapes.end(), [](const SceneShape& shape) {
    return !shape.materials.empty() ||
           std::any_of(shape.children.begin(), shape.children.end(),
                       [](const SceneShape::Child& child) { return child.material.has_value(); });
  });
}

std::size_t Scene::body(const std::string& name) const { return find_item(bodies, "body", name, id); }
std::size_t Scene::joint(const std::string& name) const { return find_item(joints, "joint", name, id); }

double Scene::number(const std::string& parameter) const {
  const auto found = parameters.find(parameter);
  if (found == parameters.end() || !std::holds_alternative<double>(found->second))
    throw std::logic_error(fmt::format("scene {} has no number parameter \"{}\"", id, parameter));
  return std::get<double>(found->second);
}

const std::string& Scene::word(const std::string& parameter) const {
  const auto found = parameters.find(parameter);
  if (found == parameters.end() || !std::holds_alternative<std::string>(found->second))
    throw std::logic_error(fmt::format("scene {} has no word parameter \"{}\"", id, parameter));
  return std::get<std::string>(found->second);
}

}  // namespace plumb::harness
