#include "narrowphase/inner_edges.hpp"

namespace plumb::impulse {

namespace {

/// A normal is one of a face where no other component is larger than this.
constexpr Real kFaceTilt = Real(1e-3);
/// Blocks are flush that differ, in height or by a gap, by less than this share of the rider's reach.
constexpr Real kFlush = Real(2e-3);

/// A static box, and how it lies.
struct Block {
  std::uint32_t proxy;
  std::uint32_t body;
  ShapePose pose;
  Vec half;
};

/// Whether one of the statics has a place in itself.
struct Cover {
  const Bodies& bodies;
  const Proxies& proxies;
  const PairFilter& filter;
  const ProxyFilter rider;
  const Block& block;
  const Vec place;  ///< from the block's centre, world axes
  bool found = false;

  PLUMB_HD void operator()(std::uint32_t other) {
    if (found || other == block.proxy || (filter.proxies[other].flags & kProxyImmovable) == 0) return;
    if (!filter(rider, filter.proxies[other])) return;
    const Proxy& proxy = proxies.rows[other];
    if (proxy.shape == kNone || proxies.shapes[proxy.shape].type != ShapeType::kBox) return;
    const ShapePose pose = shape_pose(proxy, bodies.orientation[proxy.body]);
    const Vec centre =
        between(bodies.position[block.body], bodies.position[proxy.body]) + pose.offset - block.pose.offset;
    const Vec local = rotate_back(pose.orientation, place - centre), half = proxies.shapes[proxy.shape].size;
    found = abs(local.x) <= half.x && abs(local.y) <= half.y && abs(local.z) <= half.z;
  }
};

struct DropInnerEdges {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  PairFilter filter;
  TreeView statics;
  const StepParameters* parameters;

  PLUMB_HD void operator()(std::uint32_t p) const {
    if (cache.touching[p] == 0) return;
    const Pair pair = cache.pairs[p];
    if (is_block(pair.a) && !is_box(pair.b)) return drop(p, pair.a, pair.b, true);
    if (is_block(pair.b) && !is_box(pair.a)) return drop(p, pair.b, pair.a, false);
  }

 private:
  PLUMB_HD bool is_box(std::uint32_t proxy) const {
    return proxies.shapes[proxies.rows[proxy].shape].type == ShapeType::kBox;
  }
  PLUMB_HD bool is_block(std::uint32_t proxy) const {
    return is_box(proxy) && (filter.proxies[proxy].flags & kProxyImmovable) != 0;
  }
  PLUMB_HD Block block_of(std::uint32_t proxy) const {
    const Proxy& row = proxies.rows[proxy];
    return {proxy, row.body, shape_pose(row, bodies.orientation[row.body]), proxies.shapes[row.shape].size};
  }

  PLUMB_HD void drop(std::uint32_t p, std::uint32_t proxy, std::uint32_t rider, bool is_first) const {
    Manifold& manifold = cache.found[p];
    const Block block = block_of(proxy);
    const Vec outward = is_first ? manifold.normal : -manifold.normal;
    const Vec normal = rotate_back(block.pose.orientation, outward);
    int faces = 0;
    for (int i = 0; i < 3; ++i) faces += abs(normal[i]) > kFaceTilt ? 1 : 0;
    if (faces < 2) return;
    const Vec first = is_first ? Vec{0, 0, 0} : origin_from(block, rider);
    std::uint32_t left = 0;
    for (std::uint32_t k = 0; k < manifold.count; ++k) {
      const ManifoldPoint point = manifold.points[k];
      const Vec on_block = first + point.position - (point.separation / 2) * outward;
      if (!is_inner(block, rider, normal, on_block)) manifold.points[left++] = point;
    }
    manifold.count = left;
    if (left == 0) cache.touching[p] = 0;
  }
  /// Where a shape's origin is, from the block's.
  PLUMB_HD Vec origin_from(const Block& block, std::uint32_t proxy) const {
    const Proxy& row = proxies.rows[proxy];
    const Vec offset = shape_pose(row, bodies.orientation[row.body]).offset;
    return between(bodies.position[block.body], bodies.position[row.body]) + offset - block.pose.offset;
  }
  /// Of a point on the block's surface, from its centre, world axes. normal: in the block's axes.
  PLUMB_HD bool is_inner(const Block& block, std::uint32_t rider, const Vec& normal, const Vec& on_block) const {
    const Real step = kFlush * proxies.shapes[proxies.rows[rider].shape].reach;
    for (int out = 0; out < 3; ++out) {
      if (!(abs(normal[out]) > kFaceTilt)) continue;
      Vec away = {0, 0, 0};
      for (int i = 0; i < 3; ++i)
        if (abs(normal[i]) > kFaceTilt) away[i] = (i == out) == (normal[i] > 0) ? step : -step;
      if (is_covered(block, rider, on_block + rotate(block.pose.orientation, away))) return true;
    }
    return false;
  }
  PLUMB_HD bool is_covered(const Block& block, std::uint32_t rider, const Vec& place) const {
    const Vec at = between(parameters->origin, bodies.position[block.body]) + block.pose.offset + place;
    Cover cover{bodies, proxies, filter, filter.proxies[rider], block, place};
    statics.overlaps({at, at}, statics.root(), cover);
    return cover.found;
  }
};

}  // namespace

void drop_inner_edges(Executor& executor, Count candidates, const ContactCache& cache, const Bodies& bodies,
                      const Proxies& proxies, const PairFilter& filter, const TreeView& statics,
                      const StepParameters* parameters) {
  executor.run(candidates, DropInnerEdges{cache, bodies, proxies, filter, statics, parameters});
}

}  // namespace plumb::impulse
