#include "narrowphase/manifold_reduction.hpp"

#include "narrowphase/contact_material.hpp"
#include "narrowphase/convex/face_overlap.hpp"

namespace plumb::impulse {

namespace {

/// So many candidates that face another way, one after the other, end the search for those that face the same:
/// neighbours in the tree of a surface lie beside each other, and a body on thousands of bumps must not compare each
/// with all.
constexpr std::uint32_t kMostOthers = 64;

/// Squared length of the difference between two normals within which they are one.
constexpr Real kSameNormal = Real(1e-6);

PLUMB_HD Part part_of(std::uint32_t half) { return static_cast<Part>(half >> 14U & 3U); }

/// A feature of a triangle and a shape upon it.
class SurfaceFeature {
 public:
  PLUMB_HD SurfaceFeature(std::uint32_t id, bool surface_first)
      : surface_(surface_first ? id >> 16U : id & 0xffffU),
        shape_(surface_first ? id & 0xffffU : id >> 16U),
        surface_first_(surface_first) {}

  /// Whether it is a corner or an edge of the shape on the triangle's face: it goes on to the next triangle with the
  /// shape, and is the same point there.
  [[nodiscard]] PLUMB_HD bool lasts() const {
    return part_of(surface_) == Part::kFace && part_of(shape_) != Part::kFace;
  }
  /// Its id, told apart from those of other triangles if it is one of this triangle's own.
  [[nodiscard]] PLUMB_HD std::uint32_t id_on(std::uint32_t triangle) const {
    const std::uint32_t surface = lasts() ? surface_ : feature_half(part_of(surface_), surface_ ^ triangle * 0x9e5U);
    return surface_first_ ? surface << 16U | shape_ : shape_ << 16U | surface;
  }

 private:
  std::uint32_t surface_, shape_;
  bool surface_first_;
};

/// Points of several manifolds of one normal.
class PointsOfAll {
 public:
  /// tie, same_place: lengths within which separations and places are equal.
  PLUMB_HD PointsOfAll(const Vec& normal, Real tie, Real same_place)
      : plane_(normal), tie_(tie), same_place_(same_place) {}

  /// lasts: the point goes on to the next triangle with its body. Such points come before the others, and where two
  /// serve equally well it is one of them, lest a corner that passes an edge be another point for a step.
  PLUMB_HD void add(const ManifoldPoint& point, std::uint32_t triangle, bool lasts) {
    const Vec flat = plane_.flatten(point.position);
    int i = 0;
    while (i < count_ && !(abs(at_[i].x - flat.x) <= same_place_ && abs(at_[i].y - flat.y) <= same_place_) &&
           points_[i].point.feature != point.feature)
      ++i;
    const bool is_new = i == count_;
    if (!is_new && !serves_better(point.separation, lasts, i)) return;
    if (is_new) {
      if (count_ == kMost) keep_outermost();
      i = count_++;
    }
    if (lasts && i >= lasting_) {
      move(lasting_, i);
      i = lasting_++;
    }
    at_[i] = {flat.x, flat.y, point.separation, static_cast<std::uint32_t>(i)};
    points_[i] = {point, triangle};
  }
  /// The four that matter, of those that were added.
  PLUMB_HD void write(Manifold& out, PointTriangles& triangles) {
    if (!few_last()) put_outermost_first();
    out.count = static_cast<std::uint32_t>(choose_points(at_, count_, tie_, few_last() ? lasting_ : 1));
    for (std::uint32_t i = 0; i < out.count; ++i) {
      const PointOn& chosen = points_[at_[i].feature];
      out.points[i] = chosen.point;
      triangles.of[i] = chosen.triangle;
    }
  }

 private:
  /// Than point i, in the same place or of the same name.
  [[nodiscard]] PLUMB_HD bool serves_better(Real separation, bool lasts, int i) const {
    const bool replaced_lasts = i < lasting_;
    if (lasts && !replaced_lasts) return true;
    return separation < at_[i].separation - (replaced_lasts && !lasts ? same_place_ : tie_);
  }
  static constexpr int kMost = 24;
  struct PointOn {
    ManifoldPoint point;
    std::uint32_t triangle;
  };

  /// Whether those that last are points that the body rests on, as on a plane.
  [[nodiscard]] PLUMB_HD bool few_last() const { return lasting_ >= 1 && lasting_ <= kManifoldPoints; }
  PLUMB_HD void move(int from, int to) {
    at_[to] = at_[from];
    at_[to].feature = static_cast<std::uint32_t>(to);
    points_[to] = points_[from];
  }
  [[nodiscard]] PLUMB_HD int deepest() const {
    int deepest = 0;
    for (int i = 1; i < count_; ++i)
      if (at_[i].separation < at_[deepest].separation) deepest = i;
    return deepest;
  }
  /// Those that last, the foremost in eight directions and the deepest, in their order: the corners of a face are among
  /// these, which the four best of a part of all points need not be. What hovers counts for less, as in tip_weight.
  PLUMB_HD void keep_outermost() {
    constexpr Real kAlong[8][2] = {{1, 0},  {Real(.7), Real(.7)},   {0, 1},  {-Real(.7), Real(.7)},
                                   {-1, 0}, {-Real(.7), -Real(.7)}, {0, -1}, {Real(.7), -Real(.7)}};
    std::uint32_t kept = 1U << deepest() | (few_last() ? (1U << lasting_) - 1 : 0U);
    for (const auto& along : kAlong) {
      const auto place = [&](int i) { return along[0] * at_[i].x + along[1] * at_[i].y - at_[i].separation / kTip; };
      int foremost = 0;
      for (int i = 1; i < count_; ++i)
        if (place(i) > place(foremost) + same_place_) foremost = i;
      kept |= 1U << foremost;
    }
    int left = 0, lasting = 0;
    for (int i = 0; i < count_; ++i) {
      if ((kept >> i & 1U) == 0) continue;
      move(i, left++);
      if (i < lasting_) lasting = left;
    }
    count_ = left;
    lasting_ = lasting;
  }
  /// Of points that are level the first is taken as it is: so it must not lie between the others.
  PLUMB_HD void put_outermost_first() {
    int outermost = 0;
    for (int i = 1; i < count_; ++i)
      if (at_[i].x > at_[outermost].x + same_place_) outermost = i;
    const Candidate first = at_[0];
    at_[0] = at_[outermost];
    at_[outermost] = first;
  }

  ContactPlane plane_;
  Real tie_, same_place_;
  Candidate at_[kMost] = {};  ///< their features: where the point is in points_
  PointOn points_[kMost];
  int count_ = 0, lasting_ = 0;
};

struct ReduceManifolds {
  ContactCache cache, last;
  Count candidates;
  Bodies bodies;
  Proxies proxies;
  const Real* impacts;

  /// The first candidate of a pair works for all of them, which follow each other.
  PLUMB_HD void operator()(std::uint32_t first) const {
    const Pair pair = cache.pairs[first];
    if (!has_surface(proxies, pair)) return;
    const bool surface_first = is_surface(shape(pair.a).type);
    if (first != 0 && is_same(cache.pairs[first - 1], pair)) return;
    const std::uint32_t count = min(*candidates.value, candidates.capacity);
    std::uint32_t end = first;
    for (; end < count && is_same(cache.pairs[end], pair); ++end)
      if (cache.touching[end] != 0) name_triangle(end, surface_first);
    if (end == first + 1 || is_shown(pair.a) || is_shown(pair.b)) return;
    const Real reach = shape(surface_first ? pair.b : pair.a).reach;
    for (std::uint32_t p = first; p < end; ++p)
      if (is_open(p)) reduce(p, end, reach, surface_first);
    for (std::uint32_t p = first; p < end; ++p)
      if (cache.touching[p] == kLeads) cache.touching[p] = 1;
  }

 private:
  static constexpr std::uint32_t kLeads = 2;  ///< of cache.touching, while a pair is worked on

  [[nodiscard]] PLUMB_HD const Shape& shape(std::uint32_t proxy) const {
    return proxies.shapes[proxies.rows[proxy].shape];
  }
  [[nodiscard]] PLUMB_HD bool is_shown(std::uint32_t proxy) const {
    return (bodies.mass[proxies.rows[proxy].body].flags & kBodyShowsContacts) != 0;
  }
  PLUMB_HD void name_triangle(std::uint32_t p, bool surface_first) const {
    Manifold& found = cache.found[p];
    for (std::uint32_t i = 0; i < found.count; ++i) {
      found.points[i].feature = SurfaceFeature(found.points[i].feature, surface_first).id_on(cache.triangles[p]);
      cache.point_triangles[p].of[i] = cache.triangles[p];
    }
  }
  /// Whether a candidate touches, now, and has not been made one with others.
  [[nodiscard]] PLUMB_HD bool is_open(std::uint32_t p) const {
    return cache.touching[p] == 1 && (impacts == nullptr || impacts[p] == 0);
  }
  [[nodiscard]] PLUMB_HD bool led_before(std::uint32_t p) const {
    const std::uint32_t previous = cache.previous[p];
    return previous != kNone && last.touching[previous] != 0;
  }

  [[nodiscard]] PLUMB_HD std::uint32_t material_of(const Shape& surface, std::uint32_t p) const {
    return materials_of(surface, proxies.surfaces).row(cache.triangles[p]);
  }
  /// Makes one of the manifolds of p and of those behind it that face the same way and are of one material. Who led
  /// goes on to lead, for the sake of its colour.
  PLUMB_HD void reduce(std::uint32_t p, std::uint32_t end, Real reach, bool surface_first) const {
    const Pair pair = cache.pairs[p];
    const Shape& surface = shape(surface_first ? pair.a : pair.b);
    const std::uint32_t material = material_of(surface, p);
    const Vec normal = cache.found[p].normal;
    PointsOfAll points(normal, kTie * (reach + length(cache.found[p].points[0].position)), kClipSlack * reach);
    std::uint32_t leader = kNone, manifolds = 0;
    for (std::uint32_t q = p, others = 0; q < end && others < kMostOthers; ++q) {
      if (!is_open(q)) continue;
      const Manifold& found = cache.found[q];
      if (length_squared(found.normal - normal) > kSameNormal || material_of(surface, q) != material) {
        ++others;
        continue;
      }
      others = 0;
      for (std::uint32_t i = 0; i < found.count; ++i)
        points.add(found.points[i], cache.triangles[q], SurfaceFeature(found.points[i].feature, surface_first).lasts());
      if (leader == kNone && led_before(q)) leader = q;
      cache.touching[q] = 0;
      ++manifolds;
    }
    if (leader == kNone) leader = p;
    cache.touching[leader] = kLeads;
    if (manifolds == 1) return;
    cache.found[leader].normal = normal;
    points.write(cache.found[leader], cache.point_triangles[leader]);
  }
};

}  // namespace

void reduce_manifolds(Executor& executor, Count candidates, const ContactCache& cache, const ContactCache& last,
                      const Bodies& bodies, const Proxies& proxies, const Real* impacts) {
  executor.run(candidates, ReduceManifolds{cache, last, candidates, bodies, proxies, impacts});
}

}  // namespace plumb::impulse
