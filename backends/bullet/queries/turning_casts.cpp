// Casts of shapes that turn on their way. Bullet's own sweeps turn shapes at convex ones alone; here the way is gone in
// steps so long that nothing nearer than the nearest body can be met (Mirtich, "Impulse-based dynamic simulation of
// rigid body systems", 1996, section 2.3, with the bound of the furthest point).
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "plumb/backend/hit_collector.hpp"
#include "plumb/backend/small_math.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

/// The pose at a fraction of the way.
PlumbPose pose_at(const PlumbTurningCast& cast, double fraction) {
  const PlumbVec3 &p = cast.pose.position, &t = cast.translation;
  const double angle = backend::length(cast.rotation), half = fraction * angle / 2;
  PlumbPose pose = cast.pose;
  pose.position = {p.x + fraction * t.x, p.y + fraction * t.y, p.z + fraction * t.z};
  if (angle > 0) {
    const double k = std::sin(half) / angle;
    const PlumbVec3& r = cast.rotation;
    pose.orientation = backend::multiply({k * r.x, k * r.y, k * r.z, std::cos(half)}, cast.pose.orientation);
  }
  return pose;
}

/// How far any point of the shape is from its origin, m.
double reach_of(const btCollisionShape& shape) {
  btVector3 middle;
  btScalar radius = 0;
  shape.getBoundingSphere(middle, radius);
  return static_cast<double>(middle.length() + radius);
}

/// One way, and what it has met so far.
class TurningWalk {
 public:
  TurningWalk(World& world, const PlumbTurningCast& cast, double reach, backend::HitCollector& hits)
      : world_(world),
        cast_(cast),
        hits_(hits),
        close_(std::max(1e-4 * reach, 1e-5)),
        speed_(backend::length(cast.translation) + backend::length(cast.rotation) * reach) {}

  void run() {
    meet_at_start();
    // Along what is nearly touched steps are short; after so many, what is no further than a few of them is met.
    constexpr int kMostSteps = 10'000;
    double fraction = 0;
    for (int step = 0; step < kMostSteps && !is_done(); ++step) {
      const double nearest = look(fraction, step + 1 == kMostSteps ? 10 * close_ : close_);
      if (is_done() || !(nearest < kLargest)) return;
      fraction += (nearest - close_ / 2) / speed_;
    }
  }

 private:
  [[nodiscard]] bool is_done() const { return hits_.mode() == PLUMB_HIT_CLOSEST && hits_.any(); }

  void meet_at_start() {
    const PlumbOverlap overlap = {cast_.shape, cast_.pose, cast_.filter};
    for (const PlumbPenetration& row : world_.penetrations({&overlap, 1}).rows)
      add(row.body, row.child, 0, row.position, row.normal);
  }

  /// Notes who is close there; gives the distance of the nearest other, m.
  double look(double fraction, double close) {
    const double left = (1 - fraction) * speed_ + close_;
    if (!(left > 0)) return kLargest;
    const PlumbProbe probe = {cast_.shape, pose_at(cast_, fraction), std::min(left, kLargest), cast_.filter};
    double nearest = kLargest;
    for (const PlumbClosest& row : world_.closest_bodies(hits_.mode(), {&probe, 1}).rows) {
      if (row.body == 0 || met_.contains(row.body)) continue;
      const bool told = row.distance > 0;
      if (told) last_[row.body] = row;
      if (row.distance > close) {
        nearest = std::min(nearest, row.distance);
        continue;
      }
      const auto before = last_.find(row.body);
      const PlumbClosest& known = told || before == last_.end() ? row : before->second;
      const PlumbVec3& n = known.normal;
      add(row.body, row.child, std::min(fraction, 1.0), known.on_body, {-n.x, -n.y, -n.z});
    }
    return nearest;
  }

  void add(PlumbBody body, std::uint32_t child, double fraction, const PlumbVec3& position, const PlumbVec3& normal) {
    if (met_.insert(body).second) hits_.add(body, child, fraction, position, normal);
  }

  World& world_;
  const PlumbTurningCast& cast_;
  backend::HitCollector& hits_;
  double close_;  ///< m: what is nearer is met
  double speed_;  ///< of the fastest point, m along the whole way
  std::set<PlumbBody> met_;
  std::map<PlumbBody, PlumbClosest> last_;  ///< the closest points before they touched
};

}  // namespace

Hits World::turning_casts(PlumbHitMode mode, std::span<const PlumbTurningCast> casts) {
  thread_local std::vector<PlumbHit> found;
  found.clear();
  for (std::uint32_t i = 0; i < casts.size(); ++i) {
    backend::HitCollector collector(found, i, mode);
    TurningWalk(*this, casts[i], reach_of(*shape(casts[i].shape)->bullet), collector).run();
    collector.finish();
  }
  return {PLUMB_OK, found};
}

}  // namespace plumb::bullet
