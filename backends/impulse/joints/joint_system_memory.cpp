#include "joints/joint_system_memory.hpp"

#include <algorithm>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// A joint of a mechanism, as one of its bodies sees it.
struct End {
  std::uint32_t body;
  JointOnBody on;
};
/// All of them, bodies ascending.
std::vector<End> ends_of(const OrderedJoints& ordered, const MechanismColumns& columns, const Table<BodyMass>& masses) {
  std::vector<End> ends;
  for (std::uint32_t j = ordered.base + columns.first_column; j < ordered.base + columns.column_end; ++j) {
    const Joint& joint = ordered.joints[j];
    if (is_pushed(joint.body_a, masses)) ends.push_back({joint.body_a, {j, false}});
    if (is_pushed(joint.body_b, masses)) ends.push_back({joint.body_b, {j, true}});
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.body < y.body; });
  return ends;
}

}  // namespace

JointSystemMemory::Content JointSystemMemory::put(const OrderedJoints& ordered, const Table<BodyMass>& masses) {
  const JointElimination& found = ordered.elimination;
  base_ = ordered.base;
  level_first_.assign(found.level_first);
  entries_.assign(found.entries);
  column_first_.assign(found.column_first);
  row_entries_.assign(found.row_entries);
  row_first_.assign(found.row_first);
  products_.assign(found.products);
  product_first_.assign(found.product_first);
  scaled_.grow(found.entries.size());
  whole_.grow(found.entries.size());
  turned_.grow(found.entries.size());
  changes_.grow(std::size_t{3} * found.columns.size());

  Content content;
  std::vector<std::uint32_t> first;
  std::vector<JointOnBody> list;
  for (const MechanismColumns& columns : found.columns) {
    const auto place = static_cast<std::uint32_t>(content.pushed.size());
    std::uint32_t last = kWorld;
    for (const End& end : ends_of(ordered, columns, masses)) {
      if (end.body != last) {
        content.pushed.push_back(last = end.body);
        first.push_back(static_cast<std::uint32_t>(list.size()));
      }
      list.push_back(end.on);
    }
    const Joint* const joints = ordered.joints.data() + ordered.base;
    const bool plain = std::all_of(joints + columns.first_column, joints + columns.column_end, is_plain);
    content.mechanisms.push_back({static_cast<std::uint32_t>(content.mechanisms.size()), columns.first_level,
                                  columns.level_end, columns.first_column, columns.column_end, place,
                                  static_cast<std::uint32_t>(content.pushed.size()), plain});
  }
  first.push_back(static_cast<std::uint32_t>(list.size()));
  PLUMB_ASSERT(first.size() == content.pushed.size() + 1);
  body_count_ = static_cast<std::uint32_t>(content.pushed.size());
  bodies_.assign(content.pushed);
  body_first_.assign(first);
  on_body_.assign(list);
  std::vector<SystemMechanism> small_first = content.mechanisms;
  const auto large = std::stable_partition(
      small_first.begin(), small_first.end(),
      [](const SystemMechanism& mechanism) { return mechanism.column_count() <= kMostSolvedAlone; });
  small_count_ = static_cast<std::uint32_t>(large - small_first.begin());
  mechanism_count_ = static_cast<std::uint32_t>(small_first.size());
  mechanisms_.assign(small_first);
  return content;
}

}  // namespace plumb::impulse
