#include "joints/joint_system_memory.hpp"

#include <algorithm>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// A joint of the system as one of its bodies sees it.
struct End {
  std::uint32_t mechanism, body;
  JointOnBody on;
};

/// By mechanism, and in each by body.
std::vector<End> ends_of(const OrderedJoints& ordered, const Table<BodyMass>& masses) {
  std::vector<End> ends;
  for (std::uint32_t j = ordered.base; j < ordered.count(); ++j) {
    const Joint& joint = ordered.joints[j];
    if (is_pushed(joint.body_a, masses)) ends.push_back({ordered.mechanism[j], joint.body_a, {j, false}});
    if (is_pushed(joint.body_b, masses)) ends.push_back({ordered.mechanism[j], joint.body_b, {j, true}});
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& x, const End& y) {
    return x.mechanism != y.mechanism ? x.mechanism < y.mechanism : x.body < y.body;
  });
  return ends;
}

}  // namespace

std::vector<std::uint32_t> JointSystemMemory::put(const OrderedJoints& ordered, const Table<BodyMass>& masses) {
  const JointElimination& found = ordered.elimination;
  base_ = ordered.base;
  levels_ = static_cast<std::uint32_t>(found.level_first.size() - 1);
  level_first_.assign(found.level_first);
  entries_.assign(found.entries);
  column_first_.assign(found.column_first);
  row_entries_.assign(found.row_entries);
  row_first_.assign(found.row_first);
  products_.assign(found.products);
  product_first_.assign(found.product_first);
  scaled_.grow(found.entries.size());
  whole_.grow(found.entries.size());
  if constexpr (!Executor::kWarps) turned_.grow(found.entries.size());
  changes_.grow(3);

  std::vector<std::uint32_t> bodies, first;
  std::vector<JointOnBody> list;
  for (const End& end : ends_of(ordered, masses)) {
    if (bodies.empty() || bodies.back() != end.body) {
      bodies.push_back(end.body);
      first.push_back(static_cast<std::uint32_t>(list.size()));
    }
    list.push_back(end.on);
  }
  first.push_back(static_cast<std::uint32_t>(list.size()));
  PLUMB_ASSERT(first.size() == bodies.size() + 1);
  body_count_ = static_cast<std::uint32_t>(bodies.size());
  bodies_.assign(bodies);
  body_first_.assign(first);
  on_body_.assign(list);
  return bodies;
}

}  // namespace plumb::impulse
