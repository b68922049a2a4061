#include "world/proxy_lists.hpp"

#include <algorithm>
#include <vector>

#include "plumb/assert.hpp"

namespace plumb::impulse {

void ProxyList::add(std::uint32_t proxy) {
  if (count_ == rows_.size()) rows_.grow(std::max<std::size_t>(64, 2 * rows_.size()));
  rows_[count_++] = proxy;
  PLUMB_ASSERT(count_ < 2 || rows_[count_ - 2] < proxy);
  room_ = count_;
}

void ProxyList::fill(std::uint32_t room, std::uint32_t sentinel) {
  PLUMB_ASSERT(room >= count_);
  rows_.grow(room);
  std::fill(rows_.host() + count_, rows_.host() + room, sentinel);
  room_ = room;
}

bool ProxyLists::find(const ColliderTable& colliders, const Table<BodyMass>& mass) {
  const std::uint32_t statics_before = statics.count();
  bool same_statics = true;
  for (ProxyList* list : {&movers, &statics, &planes}) list->clear();
  types = 0;
  for (std::uint32_t proxy = 0; proxy < colliders.count; ++proxy) {
    if (!colliders.is_seen(proxy)) continue;
    const ShapeType type = colliders.type(proxy);
    types |= bit_of(type);
    if (type == ShapeType::kPlane) {
      planes.add(proxy);
    } else if ((mass[colliders.proxies[proxy].body].flags & kBodyMoves) != 0) {
      movers.add(proxy);
    } else {
      same_statics = same_statics && statics.count() < statics_before && statics[statics.count()] == proxy;
      statics.add(proxy);
    }
  }
  return !same_statics || statics.count() != statics_before;
}

Position middle_of(const ProxyList& list, const ColliderTable& colliders, BodyState& state) {
  constexpr std::uint32_t kSamples = 256;
  PLUMB_ASSERT(list.count() != 0);
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < list.count(); i += list.count() / kSamples + 1)
    some.push_back(colliders.proxies[list[i]].body);
  state.fetch(some, kPosePart);
  Position middle = {0, 0, 0};
  std::vector<double> along;
  for (int axis = 0; axis < 3; ++axis) {
    along.clear();
    for (const std::uint32_t body : some) along.push_back(state.position[body][axis]);
    const auto half = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), half, along.end());
    middle[axis] = *half;
  }
  return middle;
}

}  // namespace plumb::impulse
