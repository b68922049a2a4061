#include "convert/write/gltf/gltf_filters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace plumb::harness {
namespace {

using Key = std::tuple<std::uint32_t, std::uint32_t, std::int32_t>;

Key key_of(const PlumbFilter& filter) { return {filter.category, filter.mask, filter.group}; }

std::string word_of(const PlumbFilter& filter) {
  return fmt::format("category {:x} mask {:x} group {}", filter.category, filter.mask, filter.group);
}

}  // namespace

std::vector<std::optional<std::size_t>> add_filters(const Scene& scene, GltfDraft& draft) {
  std::vector<PlumbFilter> systems;
  std::map<Key, std::size_t> known;
  std::vector<std::optional<std::size_t>> system_of;
  for (const SceneBody& body : scene.bodies) {
    const auto [system, is_new] = known.try_emplace(key_of(body.desc.filter), systems.size());
    if (is_new) systems.push_back(body.desc.filter);
    system_of.emplace_back(system->second);
  }
  const auto all_meet = [&](const PlumbFilter& one) {
    return std::all_of(systems.begin(), systems.end(), [&](const PlumbFilter& other) { return may_touch(one, other); });
  };
  if (std::all_of(systems.begin(), systems.end(), all_meet))
    return std::vector<std::optional<std::size_t>>(system_of.size());
  for (const PlumbFilter& filter : systems) {
    Json entry{{"collisionSystems", Json::array({word_of(filter)})}};
    for (const PlumbFilter& other : systems)
      if (!may_touch(filter, other)) entry["notCollideWithSystems"].push_back(word_of(other));
    draft.add("collisionFilters", entry);
  }
  return system_of;
}

}  // namespace plumb::harness
