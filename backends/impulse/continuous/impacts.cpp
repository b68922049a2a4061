#include "continuous/impacts.hpp"

#include "narrowphase/collide.hpp"

namespace plumb::impulse {

namespace {

struct FindImpacts {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Real* margins;
  const StepParameters* parameters;
  Real* times;

  PLUMB_HD void operator()(std::uint32_t p) const {
    times[p] = 0;
    const Pair pair = cache.pairs[p];
    const Proxy &proxy_a = proxies.rows[pair.a], &proxy_b = proxies.rows[pair.b];
    if (((bodies.mass[proxy_a.body].flags | bodies.mass[proxy_b.body].flags) & kBodyContinuous) == 0) return;
    const auto is_convex = [this](const Proxy& proxy) {
      return static_cast<std::uint32_t>(proxies.shapes[proxy.shape].type) < kConvexTypes;
    };
    if (!is_convex(proxy_a) || !is_convex(proxy_b)) return;
    const StepParameters& step = *parameters;
    const MovingShape a = {&proxies.shapes[proxy_a.shape], proxy_a.frame, way_through_step(bodies, step, proxy_a.body)};
    const MovingShape b = {&proxies.shapes[proxy_b.shape], proxy_b.frame, way_through_step(bodies, step, proxy_b.body)};
    if (travel(a, step.dt) + travel(b, step.dt) <= margins[pair.a] + margins[pair.b]) return;

    constexpr Real kCloseShare = Real(0.005);  // of the smaller shape: what is nearer touches
    const Real close = kCloseShare * min(a.shape->reach, b.shape->reach);
    if (cache.touching[p] != 0 && nearest(cache.found[p]) <= close) return;
    cache.touching[p] = 0;
    const Vec apart = between(bodies.position[proxy_a.body], bodies.position[proxy_b.body]);
    Impact impact;
    if (!find_impact(a, b, apart, step.dt, close, proxies.hulls, impact)) return;
    const ShapePose pose_a = a.pose(impact.time), pose_b = b.pose(impact.time);
    const Vec d = apart + impact.time * (b.way.linear - a.way.linear) + pose_b.offset - pose_a.offset;
    Manifold manifold;
    if (!collide(*a.shape, pose_a.orientation, *b.shape, pose_b.orientation, d, 2 * impact.gap + close, proxies.hulls,
                 manifold))
      return;
    cache.found[p] = manifold;
    cache.touching[p] = 1;
    times[p] = impact.time;
  }

 private:
  PLUMB_HD static Real nearest(const Manifold& manifold) {
    Real least = manifold.points[0].separation;
    for (std::uint32_t i = 1; i < manifold.count; ++i) least = min(least, manifold.points[i].separation);
    return least;
  }
};

}  // namespace

void Impacts::find(Executor& executor, const ContactCache& cache, Count candidates, const Bodies& bodies,
                   const Proxies& proxies, const Real* margins, const StepParameters* parameters) {
  executor.run(candidates, FindImpacts{cache, bodies, proxies, margins, parameters, times_.data()});
}

}  // namespace plumb::impulse
