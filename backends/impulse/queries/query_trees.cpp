#include "queries/query_trees.hpp"

#include <algorithm>

#include "geometry/shape_box.hpp"

namespace plumb::impulse {

namespace {

template <class Row>
void bring(Executor& executor, std::span<const Row> rows, Mirror<Row>& to) {
  if (to.size() < rows.size()) to.grow(rows.size() + rows.size() / 2);
  std::copy(rows.begin(), rows.end(), to.host());
  executor.to_device(to, rows.size());
}

struct PlaceTargets {
  Bodies bodies;
  Proxies proxies;
  const std::uint32_t* list;
  Position origin;
  const std::uint32_t* children;
  std::uint32_t child_count;
  Target* targets;
  Box* boxes;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t index = list[i];
    const Proxy& proxy = proxies.rows[index];
    const Shape& shape = proxies.shapes[proxy.shape];
    const Quat orientation = bodies.orientation[proxy.body];
    const Quat64 turn = normalized(to_numbers<double>(orientation));
    Target target;
    target.place = bodies.position[proxy.body] + rotate(turn, to_numbers<double>(proxy.frame.position));
    target.turn = normalized(turn * to_numbers<double>(proxy.frame.orientation));
    target.shape = shape;
    target.body = proxy.body;
    target.child = index < child_count ? children[index] : 0U;
    targets[index] = target;

    const Box local = shape_box(shape, to_numbers<Real>(target.turn), proxies.hulls);
    const Vec centre = between(origin, target.place);
    boxes[index] = {outward(centre, local.low, Real(-1)), outward(centre, local.high, Real(1))};
  }

 private:
  /// Rounding of either term must not make the box too small.
  PLUMB_HD static Vec outward(const Vec& centre, const Vec& corner, Real side) {
    const Vec size = abs(centre) + abs(corner);
    return centre + corner + (side * (16 * kEpsilon)) * size;
  }
};

}  // namespace

void QueryTrees::update(Executor& executor, const PlacedProxies& placed, const HitNames& names) {
  if (names.version != names_version_) {
    bring(executor, names.bodies, ids_);
    bring(executor, names.children, children_);
    child_count_ = static_cast<std::uint32_t>(names.children.size());
    names_version_ = names.version;
  }
  if (fresh(placed.version)) return;
  boxes_.grow(placed.rows);
  targets_.grow(placed.rows);
  extent_.grow(1);
  reduce_.reserve(placed.rows);
  const bool moved_origin = !(origin_ == placed.origin);
  origin_ = placed.origin;
  if (static_version_ != placed.static_version || moved_origin) {
    build(executor, placed, placed.statics, statics_);
    place(executor, placed, placed.planes);
  }
  static_version_ = placed.static_version;
  build(executor, placed, placed.movers, movers_);
  version_ = placed.version;
}

void QueryTrees::place(Executor& executor, const PlacedProxies& placed, const ProxyRows& list) {
  executor.run(list.count, PlaceTargets{placed.bodies, placed.proxies, list.rows, placed.origin, children_.device(),
                                        child_count_, targets_.data(), boxes_.data()});
}

void QueryTrees::build(Executor& executor, const PlacedProxies& placed, const ProxyRows& list, Lbvh& tree) {
  tree.reserve(placed.rows);
  place(executor, placed, list);
  reduce_.run(executor, list.count, LoadExtent{boxes_.data(), list.rows}, extent_.data());
  tree.build(executor, boxes_.data(), list.rows, list.count, extent_.data());
}

QueryScene QueryTrees::scene(const PlacedProxies& placed) {
  return {movers_.view(),          statics_.view(),      origin_,
          targets_.data(),         placed.filters,       ids_.device(),
          placed.proxies.shapes,   placed.proxies.hulls, placed.several,
          placed.proxies.surfaces, placed.planes,        placed.types};
}

}  // namespace plumb::impulse
