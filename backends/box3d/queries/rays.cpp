// Rays and overlaps against the world as it stands.
#include <algorithm>

#include "queries/search.hpp"
#include "queries/turned_convex.hpp"

namespace plumb::box3d {

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  const auto on_hit = [](b3ShapeId shape, b3Pos point, b3Vec3 normal, float fraction, std::uint64_t, int triangle, int,
                         void* context) {
    Search& search = *static_cast<Search*>(context);
    const Body* body = search.sees(shape);
    if (body == nullptr) return kIgnored;
    search.found.add(body->handle, child_of(*body, shape, triangle), static_cast<double>(fraction), to_plumb(point),
                     to_plumb(normal));
    // 0 would end the search before those of a lower slot at the same place were seen.
    return std::max(static_cast<float>(search.found.nearest()), std::numeric_limits<float>::min());
  };
  return gather(mode, rays, [&](const PlumbRay& ray, backend::HitCollector& found) {
    Search search{*this, ray.filter, found};
    b3World_CastRay(world_, position(ray.origin, "origin"), vector(ray.translation, "translation"), all_seeing(),
                    on_hit, &search);
  });
}

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  const auto on_overlap = [](b3ShapeId shape, void* context) {
    Search& search = *static_cast<Search*>(context);
    if (const Body* body = search.sees(shape); body != nullptr)
      search.found.add_overlap(body->handle, child_of(*body, shape, -1));
    return true;
  };
  return gather(PLUMB_HIT_ALL, overlaps, [&](const PlumbOverlap& overlap, backend::HitCollector& found) {
    Search search{*this, overlap.filter, found};
    const TurnedConvex turned(shape(overlap.shape), overlap.pose.orientation);
    b3World_OverlapShape(world_, position(overlap.pose.position, "pose.position"), &turned.proxy, all_seeing(),
                         on_overlap, &search);
  });
}

}  // namespace plumb::box3d
