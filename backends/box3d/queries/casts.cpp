// Shape casts. Box3D ends a cast short of the surface by its linear slop of 5 mm, or beyond it where shapes are round:
// what it finds is brought to where they touch.
#include <algorithm>
#include <optional>

#include "queries/search.hpp"
#include "queries/turned_convex.hpp"

namespace plumb::box3d {
namespace {

/// What was hit, as a convex shape in the frame of its body.
struct Target {
  Target(const Shape& shape, b3ShapeId id, int triangle) {
    switch (b3Shape_GetType(id)) {
      case b3_sphereShape:
        convex.sphere = b3Shape_GetSphere(id);
        proxy = convex.proxy();
        return;
      case b3_capsuleShape:
        convex.kind = Convex::Kind::capsule;
        convex.capsule = b3Shape_GetCapsule(id);
        proxy = convex.proxy();
        return;
      case b3_hullShape:
        convex.kind = Convex::Kind::hull;
        convex.hull = b3Shape_GetHull(id);
        proxy = convex.proxy();
        return;
      default: {
        const b3MeshTriangle& at = b3GetMeshTriangles(shape.mesh.get())[triangle];
        const b3Vec3* vertices = b3GetMeshVertices(shape.mesh.get());
        corners[0] = vertices[at.index1];
        corners[1] = vertices[at.index2];
        corners[2] = vertices[at.index3];
        proxy = {corners, 3, 0};
      }
    }
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  Convex convex;
  b3Vec3 corners[3]{};
  b3ShapeProxy proxy{};
};

/// Where the two touch, from near there.
class Touch {
 public:
  /// Both proxies in the target's frame but for the mover's place; along: the whole way.
  Touch(const b3ShapeProxy& target, const b3ShapeProxy& mover, const b3Transform& start, const b3Vec3& along)
      : along_(along), start_(start.p) {
    input_.proxyA = target;
    input_.proxyB = mover;
    input_.transform = start;
    radii_ = target.radius + mover.radius;
    normal = b3MulSV(-1 / b3Length(along), along);
  }

  /// Newton's method on the gap, which is a convex function of the way where both are convex: from where they are apart
  /// it comes no further than to the touch. False: they pass.
  [[nodiscard]] bool find(float guess) {
    constexpr int most_steps = 32;
    constexpr float near = 1e-5f;
    back_out(guess);
    for (int i = 0; i < most_steps; ++i) {
      const float gap = gap_at(fraction);
      if (!separated_ || std::abs(gap) < near || (gap < 0 && fraction == 0)) return true;
      const float rate = b3Dot(normal, along_);
      if (rate >= 0) return false;
      fraction = std::max(fraction - gap / rate, 0.0f);
      if (fraction > 1) return false;
    }
    return true;
  }

  /// At the start.
  void stay() { (void)gap_at(0); }

  float fraction = 0;
  b3Vec3 normal{}, point{};  ///< of the target's surface, in its frame

 private:
  /// To where their cores do not overlap, or to the start.
  void back_out(float guess) {
    float step = B3_LINEAR_SLOP / b3Length(along_);
    fraction = guess;
    for (gap_at(fraction); !separated_ && fraction > 0; gap_at(fraction)) {
      fraction = std::max(fraction - step, 0.0f);
      step *= 2;
    }
  }

  /// Below 0 where round surfaces overlap. The normal stays that of before where cores are too near to tell one.
  float gap_at(float at) {
    constexpr float telling = 2e-4f;
    b3SimplexCache cache{};
    input_.transform.p = b3MulAdd(start_, at, along_);
    const b3DistanceOutput out = b3ShapeDistance(&input_, &cache, nullptr, 0);
    separated_ = out.distance > 0;
    if (out.distance > telling) normal = out.normal;
    point = b3MulAdd(out.pointA, input_.proxyA.radius, normal);
    return out.distance - radii_;
  }

  b3DistanceInput input_{};
  b3Vec3 along_, start_;
  float radii_ = 0;
  bool separated_ = true;
};

/// m: casts that Box3D ends further than this behind the nearest are not looked at.
constexpr double kSlack = 0.05;

bool overlaps_at_start(const Body& body, const PlumbCast& cast, const b3ShapeProxy& mover) {
  return b3Body_OverlapShape(body.id, position(cast.pose.position, "pose.position"), &mover, b3DefaultQueryFilter(),
                             b3Body_GetTransform(body.id));
}

/// Of a shape that Box3D has hit at a fraction of the way.
std::optional<Touch> touch_of(const Body& body, b3ShapeId id, int triangle, float fraction, const PlumbCast& cast,
                              const b3ShapeProxy& mover) {
  const PlumbPose at = body.pose();
  const b3Quat back = b3Conjugate(quaternion(at.orientation));
  const auto inward = [&](const PlumbVec3& v) { return b3RotateVector(back, vector(v, "cast")); };
  const Target target(*body.shape, id, triangle);
  Touch touch(target.proxy, mover, {inward(backend::sub(cast.pose.position, at.position)), back},
              inward(cast.translation));
  // Of a surface Box3D may tell a triangle further on than those that overlap at the start.
  if (b3Shape_GetType(id) == b3_meshShape && overlaps_at_start(body, cast, mover)) {
    touch.stay();
    return touch;
  }
  if (!touch.find(fraction)) return std::nullopt;
  return touch;
}

}  // namespace

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  struct Sweep {
    Search search;
    const PlumbCast& cast;
    const b3ShapeProxy& mover;
  };
  const auto on_hit = [](b3ShapeId id, b3Pos, b3Vec3, float fraction, std::uint64_t, int triangle, int, void* context) {
    Sweep& sweep = *static_cast<Sweep*>(context);
    const Body* body = sweep.search.sees(id);
    if (body == nullptr) return kIgnored;
    if (const auto touch = touch_of(*body, id, triangle, fraction, sweep.cast, sweep.mover)) {
      const PlumbPose at = body->pose();
      sweep.search.found.add(body->handle, child_of(*body, id, triangle), static_cast<double>(touch->fraction),
                             backend::compose(at, {to_plumb(touch->point), {0, 0, 0, 1}}).position,
                             backend::rotate(at.orientation, to_plumb(touch->normal)));
    }
    const double slack = kSlack / backend::length(sweep.cast.translation);
    return static_cast<float>(std::min(sweep.search.found.nearest() + slack, 1.0));
  };
  return gather(mode, casts, [&](const PlumbCast& cast, backend::HitCollector& found) {
    const TurnedConvex mover(shape(cast.shape), cast.pose.orientation);
    Sweep sweep{{*this, cast.filter, found}, cast, mover.proxy};
    b3World_CastShape(world_, position(cast.pose.position, "pose.position"), &mover.proxy,
                      vector(cast.translation, "translation"), all_seeing(), on_hit, &sweep);
  });
}

}  // namespace plumb::box3d
