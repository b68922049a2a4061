// Collision without a step: temporary geoms of two shapes, and ODE's colliders between them.
#include <algorithm>
#include <array>
#include <limits>

#include "world.hpp"

namespace plumb::ode {
namespace {

/// Of one pair of geoms.
constexpr int most_points = 64;

thread_local std::vector<PlumbPairPoint> points_found;

/// The geoms of a shape at a pose, in no space, for as long as this lives.
class PosedGeoms {
 public:
  PosedGeoms(const Shape& shape, const PlumbPose& pose) {
    make_geoms(shape, nullptr, geoms_);
    for (const PlacedGeom& geom : geoms_) place_geom(geom, pose);
  }
  PosedGeoms(const PosedGeoms&) = delete;
  PosedGeoms& operator=(const PosedGeoms&) = delete;
  ~PosedGeoms() {
    for (const PlacedGeom& geom : geoms_) dGeomDestroy(geom.geom);
  }
  [[nodiscard]] std::span<const PlacedGeom> geoms() const { return geoms_; }

 private:
  std::vector<PlacedGeom> geoms_;
};

void append_points(dGeomID a, dGeomID b) {
  std::array<dContactGeom, most_points> points;
  const int count = dCollide(a, b, most_points, points.data(), sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) {
    const dContactGeom& point = points[static_cast<std::size_t>(i)];
    points_found.push_back({vec(point.pos), scale(-1, vec(point.normal)), point.depth, 0});
  }
}

}  // namespace

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  const std::scoped_lock lock(query_mutex_);
  return inside_ode([&] {
    points_found.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const PlumbPosedPair& pair = pairs[i];
      const std::size_t first = points_found.size();
      const PosedGeoms a(*slots_.shapes[slot_of(pair.shape_a)], pair.pose_a),
          b(*slots_.shapes[slot_of(pair.shape_b)], pair.pose_b);
      for (const PlacedGeom& one : a.geoms())
        for (const PlacedGeom& two : b.geoms()) append_points(one.geom, two.geom);
      double deepest = -std::numeric_limits<double>::infinity();
      for (std::size_t k = first; k < points_found.size(); ++k) deepest = std::max(deepest, points_found[k].depth);
      const std::size_t count = points_found.size() - first;
      results[i] = {count == 0 ? std::numeric_limits<double>::quiet_NaN() : -deepest, static_cast<std::uint32_t>(first),
                    static_cast<std::uint32_t>(count)};
    }
    points = points_found;
    return PLUMB_OK;
  });
}

}  // namespace plumb::ode
