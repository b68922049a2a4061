#include "bvh/lbvh.hpp"

#include "bvh/radix_tree.hpp"
#include "exec/atomic.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// Sizes differ by 2^3 and more from one size class to the next.
constexpr int kClassExponents = 3;

PLUMB_HD constexpr std::uint32_t leaf_id(std::uint32_t i) { return 2 * i; }
PLUMB_HD constexpr std::uint32_t inner_id(std::uint32_t i) { return 2 * i + 1; }

template <class K>
struct CodeBoxes {
  const Box* boxes;
  const std::uint32_t* proxies;
  const SceneExtent* extent;
  K* codes;
  std::uint32_t* indices;

  PLUMB_HD void operator()(std::uint32_t i) const {
    constexpr std::uint32_t cells = 1U << Morton<K>::kAxisBits;
    const Box& box = boxes[proxies[i]];
    const SceneExtent scene = *extent;
    const SceneFrame frame = scene.frame(Morton<K>::kAxisBits / 2);  // half of the bits against strays, half within
    const float scale = frame.side > 0 ? static_cast<float>(cells) / frame.side : 0.0F;  // cubes, even if it is flat
    const Vec at = centre(box);
    std::uint32_t cell[3];
    for (int k = 0; k < 3; ++k) cell[k] = cell_of((static_cast<float>(at[k]) - frame.corner[k]) * scale, cells);
    codes[i] = static_cast<K>(size_class(box, scene)) << Morton<K>::kBits | Morton<K>::code(cell[0], cell[1], cell[2]);
    indices[i] = i;
  }

  PLUMB_HD static std::uint32_t size_class(const Box& box, const SceneExtent& scene) {
    constexpr int most = (1 << Morton<K>::kSpareBits) - 1;
    if (!is_sound(box)) return 0;
    const int above = exponent_of(longest_side(box)) - scene.mean_exponent();
    return static_cast<std::uint32_t>(clamp(above / kClassExponents, 0, most));
  }
};

/// Inner node i of the tree, without bounds; its `next` holds its last leaf until the bounds are there.
template <class K>
struct LinkNodes {
  SortedKeys<K> sorted;
  TreeNode* nodes;
  std::uint32_t *parents, *seconds, *arrivals;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const InnerNode node = inner_node(sorted, i);
    const std::uint32_t first = node.split == node.first ? leaf_id(node.split) : inner_id(node.split);
    const std::uint32_t second = node.split + 1 == node.last ? leaf_id(node.split + 1) : inner_id(node.split + 1);
    nodes[inner_id(i)].child = first;
    nodes[inner_id(i)].next = node.last;
    parents[first] = i;
    parents[second] = i;
    seconds[node.split] = second;
    arrivals[i] = 0;
  }
};

/// From leaf i up. The first that comes to a node stops there: only the second knows that both children are done.
struct BoundNodes {
  const Box* boxes;
  const std::uint32_t *proxies, *order;
  std::uint32_t leaves;
  TreeNode* nodes;
  const std::uint32_t *parents, *seconds;
  std::uint32_t* arrivals;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = proxies[order[i]];
    const Box box = sound_or_empty(boxes[proxy]);
    nodes[leaf_id(i)] = {box.low, proxy, box.high, following(i)};
    if (leaves == 1) return;
    std::uint32_t up = parents[leaf_id(i)];
    while (atomic_arrive(&arrivals[up]) == 1) {
      TreeNode& node = nodes[inner_id(up)];
      const TreeNode& first = nodes[node.child];
      const TreeNode& second = nodes[first.next];
      const Box both = merged(Box{first.low, first.high}, Box{second.low, second.high});
      const std::uint32_t last = node.next;
      node = {both.low, node.child, both.high, following(last)};
      if (up == 0) return;
      up = parents[inner_id(up)];
    }
  }

  /// What follows a subtree is the second child at the split behind the subtree's last leaf.
  [[nodiscard]] PLUMB_HD std::uint32_t following(std::uint32_t last) const {
    return last + 1 == leaves ? TreeView::kEnd : seconds[last];
  }
};

}  // namespace

template <class K>
void MortonOrder::reserve(Keys<K>& keys, std::uint32_t capacity) {
  keys.codes.grow(capacity);
  keys.sorted.grow(capacity);
  keys.sort.reserve(capacity);
}

void MortonOrder::reserve(std::uint32_t capacity, MortonBits bits) {
  bits == MortonBits::k30 ? reserve(keys_30_, capacity) : reserve(keys_63_, capacity);
  indices_.grow(capacity);
  order_.grow(capacity);
}

template <class K>
void MortonOrder::sort_by(Keys<K>& keys, Executor& executor, const Box* boxes, const std::uint32_t* proxies,
                          std::uint32_t n, const SceneExtent* extent) {
  executor.run(n, CodeBoxes<K>{boxes, proxies, extent, keys.codes.data(), indices_.data()});
  keys.sort.run(executor, n, keys.codes.data(), indices_.data(), keys.sorted.data(), order_.data(),
                Morton<K>::kBits + Morton<K>::kSpareBits);
}

void MortonOrder::sort(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
                       const SceneExtent* extent, MortonBits bits) {
  bits == MortonBits::k30 ? sort_by(keys_30_, executor, boxes, proxies, n, extent)
                          : sort_by(keys_63_, executor, boxes, proxies, n, extent);
}

void Lbvh::reserve(std::uint32_t capacity, MortonBits bits) {
  order_.reserve(capacity, bits);
  nodes_.grow(std::size_t{2} * capacity);
  parents_.grow(std::size_t{2} * capacity);
  seconds_.grow(capacity);
  arrivals_.grow(capacity);
}

void Lbvh::build(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
                 const SceneExtent* extent, MortonBits bits) {
  PLUMB_ASSERT(std::size_t{2} * n <= nodes_.size());
  leaves_ = n;
  if (n == 0) return;
  order_.sort(executor, boxes, proxies, n, extent, bits);
  order_.with_codes(bits, [&]<class K>(const K* sorted) {
    executor.run(n - 1, LinkNodes<K>{{sorted, n}, nodes_.data(), parents_.data(), seconds_.data(), arrivals_.data()});
  });
  executor.run(n, BoundNodes{boxes, proxies, order_.order(), n, nodes_.data(), parents_.data(), seconds_.data(),
                             arrivals_.data()});
}

}  // namespace plumb::impulse
