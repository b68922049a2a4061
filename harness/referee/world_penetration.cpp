#include "referee/world_penetration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb::referee {

namespace {

struct Entry {
  Aabb box;
  std::uint32_t index;
  bool moves;
};

bool finite(const Pose& pose) { return pose.position.allFinite() && pose.rotation.allFinite(); }

int widest_axis(const std::vector<Entry>& entries) {
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  double count = 0;
  for (const Entry& entry : entries) {
    const Vec3 middle = (entry.box.low + entry.box.high) / 2;
    if (!middle.allFinite()) continue;  // planes
    sum += middle;
    squares += middle.cwiseProduct(middle);
    count += 1;
  }
  int axis = 0;
  if (count > 0) (squares - sum.cwiseProduct(sum) / count).maxCoeff(&axis);
  return axis;
}

double nearest_rank(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> bounding_pairs(std::span<const PosedShape> shapes) {
  std::vector<Entry> entries;
  entries.reserve(shapes.size());
  for (std::uint32_t i = 0; i < shapes.size(); ++i)
    if (shapes[i].shape != nullptr && finite(shapes[i].pose))
      entries.push_back({shapes[i].shape->bounds(shapes[i].pose), i, shapes[i].moves});
  const int axis = widest_axis(entries);
  std::ranges::stable_sort(entries, {}, [axis](const Entry& entry) { return entry.box.low[axis]; });

  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t j = i + 1; j < entries.size() && entries[j].box.low[axis] <= entries[i].box.high[axis]; ++j)
      if ((entries[i].moves || entries[j].moves) && entries[i].box.overlaps(entries[j].box))
        pairs.push_back(std::minmax(entries[i].index, entries[j].index));
  std::ranges::sort(pairs);
  return pairs;
}

WorldPenetration world_penetration(std::span<const PosedShape> shapes, const MayTouch& may_touch) {
  WorldPenetration world;
  std::vector<double> depths;
  for (const auto& [a, b] : bounding_pairs(shapes)) {
    if (may_touch && !may_touch(a, b)) continue;
    const Penetration found =
        penetration(*shapes[a].shape, shapes[a].pose, *shapes[b].shape, shapes[b].pose, Apart::lower_bound);
    if (!(found.depth > 0)) continue;
    world.overlaps.push_back({a, b, found});
    depths.push_back(found.depth);
    world.sum_of_squares += found.depth * found.depth;
  }
  std::ranges::sort(depths);
  world.p50 = nearest_rank(depths, 0.5);
  world.p95 = nearest_rank(depths, 0.95);
  world.p99 = nearest_rank(depths, 0.99);
  world.max = depths.empty() ? 0 : depths.back();
  return world;
}

}  // namespace plumb::referee
