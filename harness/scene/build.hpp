// The parts of a scene file, read into a Scene whose parameters have values. Used by scene_file.cpp and by tests.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/node.hpp"

namespace plumb::harness {

/// What is being read, and where names lie in it.
struct SceneBuilder {
  Scene scene;
  std::unordered_map<std::string, std::size_t> shape_index, body_index, joint_index;
};

void read_shapes(const Node& shapes, SceneBuilder& builder);
void read_bodies(const Node& bodies, SceneBuilder& builder);
void read_joints(const Node& joints, SceneBuilder& builder);

/// Calls `each` for every combination of the indices of entry's repeat for which its `when` holds (once without).
template <class Each>
void for_each_repeat(const Node& entry, const Each& each);

/// Adds a name to an index; fails when it is taken. what: "body".
void add_name(const Node& place, const std::string& what, const std::string& name,
              std::unordered_map<std::string, std::size_t>& index, std::size_t value);
/// Looks a name up; fails with the nearest.
[[nodiscard]] std::size_t find_name(const Node& place, const std::string& what,
                                    const std::unordered_map<std::string, std::size_t>& index);

/// Keys that the reader knows, by the schema's definition that lists them ("" is the root).
[[nodiscard]] const std::map<std::string, std::vector<std::string>>& scene_keys();
[[nodiscard]] const std::vector<std::string>& need_words();  ///< by bit
[[nodiscard]] const std::vector<std::string>& shape_words();
[[nodiscard]] const std::vector<std::string>& joint_words();

constexpr std::size_t most_objects = 2'000'000;  ///< of bodies or joints in a scene: more is a slip of the pen

template <class Each>
void for_each_repeat(const Node& entry, const Each& each) {
  const auto repeat = entry.find("repeat");
  const auto when = entry.find("when");
  std::vector<std::pair<std::string, Node>> indices;
  if (repeat) indices = repeat->members();
  for (const auto& [name, count] : indices) {
    if (entry.expressions().has(name)) count.fail("\"" + name + "\" is the name of something else already");
    entry.expressions().set(name, 0);
  }
  const auto nest = [&](const auto& self, std::size_t depth) -> void {
    if (depth == indices.size()) {
      if (!when || when->number() != 0) each();
      return;
    }
    const auto& [name, count_node] = indices[depth];
    const auto count = count_node.integer(0, static_cast<std::int64_t>(most_objects));
    for (std::int64_t i = 0; i < count; ++i) {
      entry.expressions().set(name, static_cast<double>(i));
      self(self, depth + 1);
    }
  };
  nest(nest, 0);
  for (const auto& index : indices) entry.expressions().erase(index.first);
}

}  // namespace plumb::harness
