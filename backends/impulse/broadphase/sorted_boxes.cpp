#include "broadphase/sorted_boxes.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct GatherBoxes {
  const Box* boxes;
  const std::uint32_t *proxies, *order, *sorted_keys;
  SortedBox* to;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = proxies[order[i]];
    const Box box = sound_or_empty(boxes[proxy]);
    to[i] = {box.low, proxy, box.high, sorted_keys[i]};
  }
};

}  // namespace

void SortedBoxes::sort(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n, int bits) {
  PLUMB_ASSERT(n <= boxes_.size());
  sort_.run(executor, n, keys.data(), indices.data(), sorted_keys_.data(), order_.data(), bits);
  executor.run(n, GatherBoxes{boxes, proxies, order_.data(), sorted_keys_.data(), boxes_.data()});
}

}  // namespace plumb::impulse
