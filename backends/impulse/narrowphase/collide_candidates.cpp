// On a CPU: a branch a pair, which is what it does best.
#include "narrowphase/collide_candidates.hpp"

#include "narrowphase/collide_any.hpp"

namespace plumb::impulse {

namespace {

/// Any two convex shapes without cylinders.
struct WithoutCylinders {
  static constexpr bool kOnSheets = false;
  static bool collide(const ShapePair& pair, const Proxies& proxies, std::uint32_t, Manifold& manifold) {
    if (pair.a.type <= pair.b.type) return collide_ordered(pair, proxies.hulls, manifold);
    const bool touch = collide_ordered(pair.swapped(), proxies.hulls, manifold);
    if (touch) swap_sides(pair.d, manifold);
    return touch;
  }
};

/// Any two shapes.
struct AnyShapes {
  static constexpr bool kOnSheets = true;
  static bool collide(const ShapePair& pair, const Proxies& proxies, std::uint32_t triangle, Manifold& manifold) {
    if (!is_convex(pair.b.type)) return collide_with_piece(pair, proxies, triangle, manifold);
    if (is_convex(pair.a.type)) return impulse::collide(pair, proxies.hulls, manifold);
    const bool touch = collide_with_piece(pair.swapped(), proxies, triangle, manifold);
    if (touch) swap_sides(pair.d, manifold);
    return touch;
  }
};

template <class Kind>
struct Collide {
  CollideInput input;
  void operator()(std::uint32_t p) const { collide_candidate<Kind>(input, p); }
};

}  // namespace

void collide_candidates(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types) {
  if (input.work.cache.triangles != nullptr || (shape_types & bit_of(ShapeType::kCylinder)) != 0)
    executor.run(candidates, Collide<AnyShapes>{input});
  else
    executor.run(candidates, Collide<WithoutCylinders>{input});
}

}  // namespace plumb::impulse
