// Shape casts. What PhysX finds is brought to where the shapes touch.
#include <algorithm>
#include <optional>

#include "queries/search.hpp"

namespace plumb::px {
namespace {

/// m: PhysX's sweeps end this near to where the shapes touch.
constexpr double kSlack = 0.01;

/// Where a shape on its way touches a leaf.
class Touch {
 public:
  Touch(const PxGeometry& moved, const PxTransform& start, const PxVec3& way, const Leaf& target)
      : moved_(moved), start_(start), way_(way), target_(target) {}

  /// Newton's method on the gap, which is a convex function of the way where both are convex: from where they are apart
  /// it comes no further than to the touch. False: they pass.
  [[nodiscard]] bool find() {
    constexpr int most_steps = 64;
    constexpr double near = 1e-6;
    look_at(0);
    for (int i = 0; i < most_steps; ++i) {
      if (gap.distance <= near) return true;
      const double rate = -static_cast<double>(gap.normal.dot(way_));
      if (rate >= 0) return false;
      look_at(fraction - gap.distance / rate);
      if (!(fraction <= 1)) return false;
    }
    return gap.distance < 1e-3;
  }

  double fraction = 0;
  Between gap;  ///< from the moved shape to the other

 private:
  /// The normal stays that of before where the two are too near to tell one.
  void look_at(double at) {
    constexpr double telling = 1e-5;
    fraction = at;
    const PxVec3 before = gap.normal;
    gap = between(Leaf(moved_, PxTransform(start_.p + static_cast<float>(at) * way_, start_.q)), target_);
    if (at > 0 && gap.distance < telling) gap.normal = before;
  }

  const PxGeometry& moved_;
  const PxTransform& start_;
  PxVec3 way_;
  const Leaf& target_;
};

/// The bounds of a shape on all of its way.
PxBounds3 swept(const PxGeometry& moved, const PxTransform& start, const PxVec3& way) {
  PxBounds3 bounds, end;
  PxGeometryQuery::computeGeomBounds(bounds, moved, start);
  end = PxBounds3(bounds.minimum + way, bounds.maximum + way);
  bounds.include(end);
  return bounds;
}

}  // namespace

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  return gather(mode, casts, [&](const PlumbCast& cast, backend::HitCollector& found) {
    const Piece& piece = shape(cast.shape).pieces.front();
    const PxGeometry& moved = piece.geometry.any();
    const PxTransform start = transform(cast.pose, "pose.position") * piece.at;
    const PxVec3 way = vector(cast.translation, "translation");
    const PxTransform near_start(PxVec3(0), start.q);
    const auto sees = seen_by(cast.filter);
    const auto touch = [&](const Part& part, const PxShape& other, const PxRigidActor& actor) {
      const PxTransform at = PxShapeExt::getGlobalPose(other, actor);
      for_leaves(other.getGeometry(), at, swept(moved, start, way), start.p, [&](const Leaf& leaf, PxU32 face) {
        Touch on_way(moved, near_start, way, leaf);
        if (!on_way.find()) return;
        found.add(part.body->handle, child_of(part, face), on_way.fraction,
                  backend::add(to_plumb(start.p), to_plumb(on_way.gap.on_b)), to_plumb(-on_way.gap.normal));
      });
    };
    if (piece.is(PxGeometryType::eCUSTOM) || piece.is(PxGeometryType::eCONVEXCORE)) {  // PhysX sweeps none, or not well
      find_near(*scene_, swept(moved, start, way), sees, touch);
      return;
    }
    SightOf sight(sees);
    auto hits = each<PxSweepHit>([&](const PxSweepHit& hit) { touch(part_of(*hit.shape), *hit.shape, *hit.actor); });
    (void)scene_->sweep(moved, start, way.getNormalized(), way.magnitude(), hits, PxHitFlag::eMESH_BOTH_SIDES,
                        look_at_all(), &sight, nullptr, static_cast<float>(kSlack));
  });
}

}  // namespace plumb::px
