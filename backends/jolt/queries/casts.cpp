// Shape casts. What Jolt finds is brought to where the shapes touch.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/ShapeCast.h>

#include <algorithm>
#include <optional>

#include "queries/exact.hpp"
#include "queries/search.hpp"

namespace plumb::jolt {
namespace {

/// Where a shape on its way touches a part of a body.
class Touch {
 public:
  /// normal: from the moved shape to the other, nearly.
  Touch(const JPH::Shape& moved, const JPH::Mat44& start, JPH::Vec3Arg along, const Leaf& target, JPH::Vec3Arg normal)
      : moved_(moved), start_(start), along_(along), target_(target) {
    gap.normal = normal;
  }

  /// Newton's method on the gap, which is a convex function of the way where both are convex: from where they are apart
  /// it comes no further than to the touch. False: they pass.
  [[nodiscard]] bool find(float guess) {
    constexpr int most_steps = 32;
    constexpr double near = 1e-5;
    back_out(guess);
    for (int i = 0; i < most_steps; ++i) {
      if (std::abs(gap.distance) < near || (gap.distance < 0 && fraction == 0)) return true;
      const double rate = -static_cast<double>(gap.normal.Dot(along_));
      if (rate >= 0) return false;
      look_at(std::max(fraction - gap.distance / rate, 0.0));
      if (fraction > 1) return false;
    }
    return true;
  }

  double fraction = 0;
  Between gap;  ///< from the moved shape to the other

 private:
  /// A millimetre before the guess, or further, to where they are apart and a normal can be told, or to the start.
  void back_out(float guess) {
    double step = 1e-3 / static_cast<double>(along_.Length());
    fraction = static_cast<double>(guess);
    do {
      look_at(std::max(fraction - step, 0.0));
      step *= 2;
    } while (gap.distance < kTelling && fraction > 0);
  }
  /// The normal stays that of before where the two are too near to tell one.
  void look_at(double at) {
    fraction = at;
    const JPH::Mat44 there = start_.PostTranslated(static_cast<float>(at) * along_);
    const JPH::Vec3 before = gap.normal;
    gap = between(Leaf(moved_, there, {}), target_);
    if (std::abs(gap.distance) < kTelling) gap.normal = before;
  }

  static constexpr double kTelling = 2e-4;  ///< m

  const JPH::Shape& moved_;
  const JPH::Mat44& start_;
  JPH::Vec3 along_;
  const Leaf& target_;
};

/// m: of hits that Jolt has this far behind the nearest one none is left out.
constexpr double kSlack = 0.05;

}  // namespace

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  return gather(mode, casts, [&](const PlumbCast& cast, backend::HitCollector& found) {
    const JPH::Shape& moved = *shape(cast.shape).jolt;
    const JPH::RVec3 base = position(cast.pose.position, "pose.position");
    const JPH::Mat44 start = centre_transform(moved, cast.pose, cast.pose.position);
    const JPH::Vec3 along = vector(cast.translation, "translation");
    const JPH::RShapeCast sweep(&moved, JPH::Vec3::sOne(), JPH::RMat44::sTranslation(base) * start, along);
    auto how = exactly<JPH::ShapeCastSettings>();
    how.mBackFaceModeTriangles = how.mBackFaceModeConvex = JPH::EBackFaceMode::CollideWithBackFaces;
    auto collector = each<JPH::CastShapeCollector>([&](auto& search, const JPH::ShapeCastResult& hit) {
      const Part part(system_, hit.mBodyID2, hit.mSubShapeID2);
      const Leaf leaf = part.leaf(hit.mSubShapeID2, base);
      Touch touch(moved, start, along, leaf, hit.mPenetrationAxis.NormalizedOr(along.Normalized()));
      if (!touch.find(hit.mFraction)) return;
      found.add(part.body.handle, part.child, touch.fraction,
                backend::add(cast.pose.position, to_plumb(touch.gap.on_b)), to_plumb(-touch.gap.normal));
      search.UpdateEarlyOutFraction(early_out(found, kSlack / backend::length(cast.translation)));
    });
    system_.GetNarrowPhaseQueryNoLock().CastShape(sweep, how, base, collector, {}, {}, Seen(cast.filter));
  });
}

}  // namespace plumb::jolt
