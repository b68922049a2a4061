#include "broadphase/sweep.hpp"

namespace plumb::impulse {

namespace {

struct KeyBySide {
  const Box* boxes;
  const std::uint32_t* proxies;
  const SceneExtent* extent;
  std::uint32_t *keys, *indices;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const Box& box = boxes[proxies[i]];
    keys[i] = is_sound(box) ? sweep_key(box.low[extent->longest_axis()]) : ~0U;  // no scan goes so far
    indices[i] = i;
  }
};

}  // namespace

void Sweep::build(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
                  const SceneExtent* extent) {
  count_ = n;
  extent_ = extent;
  executor.run(n, KeyBySide{boxes, proxies, extent, sorted_.keys.data(), sorted_.indices.data()});
  sorted_.sort(executor, boxes, proxies, n, 32);
}

}  // namespace plumb::impulse
