#include "scene/limits.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scene/build.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

std::size_t count_entry(const Node& entry, std::size_t most) {
  if (!entry.find("generate")) return count_repeats(entry, most);
  const std::size_t generator = entry.at("generate").word("generator", generator_words());
  const Node count = entry.at("count");
  return generated_bodies(generator, count.integer(1, largest_count(generator)));
}

std::size_t count_all(const Node& root, const char* key) {
  std::size_t objects = 0;
  const auto list = root.find(key);
  if (!list) return 0;
  for (const Node& entry : list->elements()) {
    objects += count_entry(entry, most_objects);
    const std::size_t most = key == std::string("host") ? most_actions : most_objects;
    if (objects > most)
      entry.fail(fmt::format("with this the scene has more than {} {}: is a count mistaken?", most,
                             key == std::string("host") ? "actions of the host" : key));
  }
  return objects;
}

}  // namespace

double steps_of(double seconds, double dt) { return std::max(0.0, std::ceil(seconds / dt - 1e-6)); }

std::size_t count_repeats(const Node& entry, std::size_t most) {
  const RepeatIndices indices(entry);
  std::size_t total = 0, visits = 0;
  const auto nest = [&](const auto& self, std::size_t depth) -> void {
    const auto& [name, node] = indices.list[depth];
    const auto count = static_cast<std::size_t>(node.integer(0, static_cast<std::int64_t>(most)));
    const bool innermost = depth + 1 == indices.list.size();
    total += innermost ? count : 0;
    if (total > most || ++visits > most)
      entry.at("repeat").fail(fmt::format("this makes more than {} combinations: is a count mistaken?", most));
    for (std::size_t i = 0; !innermost && i < count; ++i) {
      entry.expressions().set(name, static_cast<double>(i));
      self(self, depth + 1);
    }
  };
  if (indices.list.empty()) return 1;
  nest(nest, 0);
  return total;
}

std::size_t count_objects(const Node& root) {
  return count_all(root, "bodies") + count_all(root, "joints") + count_all(root, "host");
}

}  // namespace plumb::harness
