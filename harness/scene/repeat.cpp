// Entries of a scene file that stand for many objects.
#include <fmt/format.h>

#include "scene/build.hpp"
#include "scene/limits.hpp"

namespace plumb::harness {

RepeatIndices::RepeatIndices(const Node& entry) : expressions_(entry.expressions()) {
  const auto repeat = entry.find("repeat");
  if (!repeat) return;
  auto indices = repeat->members();
  if (indices.empty()) repeat->fail("a repeat has at least one index: {\"i\": 10}");
  for (auto& [name, count] : indices) {
    count.check_new_name(name);
    expressions_.set(name, 0);
    list.emplace_back(name, count);
  }
}

RepeatIndices::~RepeatIndices() {
  for (const auto& index : list) expressions_.erase(index.first);
}

void for_each_repeat(const Node& entry, const std::function<void()>& each) {
  const auto when = entry.find("when");
  const RepeatIndices indices(entry);
  const auto nest = [&](const auto& self, std::size_t depth) -> void {
    if (depth == indices.list.size()) {
      if (!when || when->number() != 0) each();
      return;
    }
    const auto& [name, node] = indices.list[depth];
    const auto count = node.integer(0, static_cast<std::int64_t>(most_objects));
    for (std::int64_t i = 0; i < count; ++i) {
      entry.expressions().set(name, static_cast<double>(i));
      self(self, depth + 1);
    }
  };
  nest(nest, 0);
}

}  // namespace plumb::harness
