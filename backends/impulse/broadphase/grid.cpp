#include "broadphase/grid.hpp"

namespace plumb::impulse {

namespace {

PLUMB_HD bool is_common(const Box& box, const SceneExtent& scene) {
  return is_sound(box) && exponent_of(longest_side(box)) <= CommonSide::most_exponent(scene);
}

struct LoadCommonSide {
  const Box* boxes;
  const std::uint32_t* proxies;
  const SceneExtent* extent;
  PLUMB_HD CommonSide operator()(std::uint32_t i) const {
    const Box& box = boxes[proxies[i]];
    return {is_common(box, *extent) ? __builtin_bit_cast(std::uint32_t, longest_side(box)) : 0U};
  }
};

struct KeyByCell {
  const Box* boxes;
  const std::uint32_t* proxies;
  const SceneExtent* extent;
  const CommonSide* side;
  std::uint32_t *keys, *indices;
  PLUMB_HD void operator()(std::uint32_t i) const {
    // Wider than a box by far more than all roundings here together.
    constexpr float margin = 1.0F + 1.0F / 64.0F;
    const Box& box = boxes[proxies[i]];
    const SceneExtent scene = *extent;
    const SceneFrame frame = scene.frame(GridCells::kAxisBits / 2);
    const float width =
        max(margin * __builtin_bit_cast(float, side->bits), frame.side / static_cast<float>(GridCells::kAcross - 1));
    const float scale = width > 0 ? 1.0F / width : 0.0F;
    std::uint32_t cell[3];
    for (int k = 0; k < 3; ++k) {
      const auto from_corner = static_cast<float>(box.low[k] - static_cast<Real>(frame.corner[k]));
      cell[k] = cell_of(from_corner * scale, GridCells::kAcross);
    }
    keys[i] = is_common(box, scene) ? GridCells::key(cell[0], cell[1], cell[2]) : GridCells::kLarge;
    indices[i] = i;
  }
};

struct CountCommon {
  const SortedBox* boxes;
  std::uint32_t count;
  std::uint32_t* common_count;
  PLUMB_HD void operator()(std::uint32_t) const { *common_count = first_from(boxes, 0, count, GridCells::kLarge); }
};

}  // namespace

void Grid::reserve(std::uint32_t capacity) {
  reduce_.reserve(capacity);
  side_.grow(1);
  common_count_.grow(1);
  sorted_.reserve(capacity);
}

void Grid::build(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
                 const SceneExtent* extent) {
  count_ = n;
  reduce_.run(executor, n, LoadCommonSide{boxes, proxies, extent}, side_.data());
  executor.run(n, KeyByCell{boxes, proxies, extent, side_.data(), sorted_.keys.data(), sorted_.indices.data()});
  sorted_.sort(executor, boxes, proxies, n, GridCells::kKeyBits);
  executor.run(1U, CountCommon{sorted_.data(), n, common_count_.data()});
}

}  // namespace plumb::impulse
