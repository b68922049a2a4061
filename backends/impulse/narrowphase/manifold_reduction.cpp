#include "narrowphase/manifold_reduction.hpp"

#include "narrowphase/contact_material.hpp"
#include "narrowphase/contact_recycling.hpp"
#include "narrowphase/convex/face_overlap.hpp"

namespace plumb::impulse {

namespace {

/// Squared length of the difference between two normals within which they are one.
constexpr Real kSameNormal = Real(1e-6);

/// Which manifolds become one.
struct Likeness {
  Real normals;  ///< up to this squared length of the difference
  /// So many that face another way, one after the other, end the search for those that face the same: neighbours in the
  /// tree of a surface lie beside each other, and a ball on thousands of bumps must not compare each with all.
  std::uint32_t most_others;
};
constexpr Likeness kOnePlane = {kSameNormal, 64};
constexpr Likeness kWithin5Degrees = {Real(7.6e-3), 0xffffffffU};

/// Of a shape's reach: up to this separation a bump bears.
constexpr Real kBears = Real(5e-4);
/// Cosine of the angle between a cylinder's axis and a normal above which it stands: one that lies may roll, and goes
/// by the normal of the very triangle that it is on.
constexpr Real kStands = Real(0.7);

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

/// Points of several manifolds whose normals are near one, and of which candidates they are.
class PointsOfAll {
 public:
  /// tie, same_place: lengths within which separations and places are equal.
  PLUMB_HD PointsOfAll(const Vec& normal, Real tie, Real same_place)
      : plane_(normal), tie_(tie), same_place_(same_place) {}

  /// lasts: the point goes on to the next triangle with its body. Such points come before the others, and where two
  /// serve equally well it is one of them, lest a corner that passes an edge be another point for a step.
  PLUMB_HD void add(const ManifoldPoint& point, const Vec& normal, std::uint32_t candidate, bool lasts) {
    const Vec flat = plane_.flatten(point.position);
    int i = 0;
    while (i < count_ && !(abs(at_[i].x - flat.x) <= same_place_ && abs(at_[i].y - flat.y) <= same_place_) &&
           points_[i].point.feature != point.feature)
      ++i;
    const bool is_new = i == count_;
    if (!is_new) points_[i].normals += normal;
    if (!is_new && !serves_better(point.separation, lasts, i)) return;
    const Vec normals = is_new ? normal : points_[i].normals;
    if (is_new) {
      if (count_ == kMost) keep_outermost();
      i = count_++;
    }
    if (lasts && i >= lasting_) {
      move(lasting_, i);
      i = lasting_++;
    }
    at_[i] = {flat.x, flat.y, point.separation, static_cast<std::uint32_t>(i)};
    points_[i] = {point, candidate, normals};
  }
  struct PointOn {
    ManifoldPoint point;
    std::uint32_t candidate;
    Vec normals;  ///< of all manifolds that have it, summed
  };
  /// Chooses the four that matter, of those that were added, and returns how many there are. flat: all lie on one
  /// plane, so that none need be looked for between the body's corners.
  PLUMB_HD std::uint32_t choose(bool flat) {
    const bool on_corners = flat && few_last();
    if (!on_corners) put_outermost_first();
    return static_cast<std::uint32_t>(choose_points(at_, count_, tie_, on_corners ? lasting_ : 1));
  }
  /// Those that bear besides those that were chosen, which are behind these from now on.
  PLUMB_HD std::uint32_t choose_bearing(std::uint32_t chosen, Real most) {
    int bearing = static_cast<int>(chosen);
    for (int i = bearing; i < count_; ++i) {
      if (at_[i].separation > most) continue;
      const Candidate other = at_[bearing];
      at_[bearing++] = at_[i];
      at_[i] = other;
    }
    return static_cast<std::uint32_t>(bearing);
  }
  [[nodiscard]] PLUMB_HD const PointOn& chosen(std::uint32_t i) const { return points_[at_[i].feature]; }

 private:
  /// Than point i, in the same place or of the same name.
  [[nodiscard]] PLUMB_HD bool serves_better(Real separation, bool lasts, int i) const {
    const bool replaced_lasts = i < lasting_;
    if (lasts && !replaced_lasts) return true;
    return separation < at_[i].separation - (replaced_lasts && !lasts ? same_place_ : tie_);
  }
  static constexpr int kMost = 24;
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
  NarrowPhaseWork work;
  Count candidates;
  const PairTime* impacts;

  /// The first candidate of a pair works for all of them, which follow each other.
  PLUMB_HD void operator()(std::uint32_t first) const {
    const ContactCache& cache = work.cache;
    const Pair pair = cache.pairs[first];
    if (!has_surface(work.proxies, pair)) return;
    const bool surface_first = is_surface(shape(pair.a).type);
    if (first != 0 && is_same(cache.pairs[first - 1], pair)) return;
    const std::uint32_t count = min(*candidates.value, candidates.capacity);
    Span all = {first, first};
    while (all.end < count && is_same(cache.pairs[all.end], pair)) ++all.end;
    if (cache.touching[first] == kCarried) {
      for (std::uint32_t p = first; p < all.end; ++p) cache.touching[p] = 1;
      return;
    }
    for (std::uint32_t p = first; p < all.end; ++p)
      if (cache.touching[p] != 0) name_triangle(p, surface_first);
    if (is_shown(pair.a) || is_shown(pair.b)) return;
    if (all.end != first + 1) reduce_all(all, surface_first);
    keep(all);
  }

 private:
  static constexpr std::uint32_t kLeads = 2;  ///< of cache.touching, while a pair is worked on
  struct Span {
    std::uint32_t begin, end;  ///< of candidates
  };

  PLUMB_HD void reduce_all(Span all, bool surface_first) const {
    if (lies_on_bumps(all, surface_first)) {
      for (const bool led : {true, false})
        for (std::uint32_t p = all.begin; p < all.end; ++p)
          if (is_open(p) && led_before(p) == led) reduce(p, all, kWithin5Degrees, surface_first);
      reopen(all);
    }
    for (std::uint32_t p = all.begin; p < all.end; ++p)
      if (is_open(p)) reduce(p, {p, all.end}, kOnePlane, surface_first);
    reopen(all);
  }
  PLUMB_HD void reopen(Span all) const {
    for (std::uint32_t p = all.begin; p < all.end; ++p)
      if (work.cache.touching[p] == kLeads) work.cache.touching[p] = 1;
  }
  /// Lets what touches be recycled as it is now, if all of it may.
  PLUMB_HD void keep(Span all) const {
    const ContactCache& cache = work.cache;
    const Pair pair = cache.pairs[all.begin];
    for (std::uint32_t p = all.begin; p < all.end; ++p)
      if (cache.touching[p] != 0 &&
          (is_of_another_time(p) || !may_recycle(shape(pair.a).type, shape(pair.b).type, cache.found[p])))
        return;
    const std::uint32_t a = work.proxies.rows[pair.a].body, b = work.proxies.rows[pair.b].body;
    const Bodies& bodies = work.bodies;
    for (std::uint32_t p = all.begin; p < all.end; ++p)
      if (cache.touching[p] != 0)
        cache.collided.store(p, {cache.found[p], work.margin(pair), bodies.orientation[a], bodies.orientation[b],
                                 bodies.position[b] - bodies.position[a]});
  }

  /// Whether a face of the shape lies on more sides of the surface than two.
  [[nodiscard]] PLUMB_HD bool lies_on_bumps(Span all, bool surface_first) const {
    constexpr int kMost = 2;
    Vec sides[kMost];
    int count = 0;
    for (std::uint32_t p = all.begin; p < all.end; ++p) {
      if (!is_open(p)) continue;
      const Vec& normal = work.cache.found[p].normal;
      int i = 0;
      while (i < count && length_squared(normal - sides[i]) > kSameNormal) ++i;
      if (i < count) continue;
      if (count == kMost) return rests_on_a_face(p, surface_first);
      sides[count++] = normal;
    }
    return false;
  }
  [[nodiscard]] PLUMB_HD bool rests_on_a_face(std::uint32_t p, bool surface_first) const {
    const Proxy& row = work.proxies.rows[surface_first ? work.cache.pairs[p].b : work.cache.pairs[p].a];
    const ShapeType type = work.proxies.shapes[row.shape].type;
    if (type != ShapeType::kCylinder) return type == ShapeType::kBox || type == ShapeType::kHull;
    const Vec axis = rotate(shape_pose(row, work.bodies.orientation[row.body]).orientation, Vec{0, 1, 0});
    return abs(dot(axis, work.cache.found[p].normal)) > kStands;
  }

  [[nodiscard]] PLUMB_HD const Shape& shape(std::uint32_t proxy) const {
    return work.proxies.shapes[work.proxies.rows[proxy].shape];
  }
  [[nodiscard]] PLUMB_HD bool is_shown(std::uint32_t proxy) const {
    return (work.bodies.mass[work.proxies.rows[proxy].body].flags & kBodyShowsContacts) != 0;
  }
  PLUMB_HD void name_triangle(std::uint32_t p, bool surface_first) const {
    Manifold& found = work.cache.found[p];
    for (std::uint32_t i = 0; i < found.count; ++i) {
      found.points[i].feature = SurfaceFeature(found.points[i].feature, surface_first).id_on(work.cache.triangles[p]);
      work.cache.point_triangles[p].of[i] = work.cache.triangles[p];
    }
  }
  /// Whether a candidate touches, now, and has not been made one with others.
  [[nodiscard]] PLUMB_HD bool is_open(std::uint32_t p) const {
    return work.cache.touching[p] == 1 && !is_of_another_time(p);
  }
  [[nodiscard]] PLUMB_HD bool is_of_another_time(std::uint32_t p) const {
    return impacts != nullptr && impacts[p].time != 0;
  }
  [[nodiscard]] PLUMB_HD bool led_before(std::uint32_t p) const {
    const std::uint32_t previous = work.cache.previous[p];
    return previous != kNone && work.last.touching[previous] != 0;
  }

  [[nodiscard]] PLUMB_HD std::uint32_t material_of(const Shape& surface, std::uint32_t p) const {
    return materials_of(surface, work.proxies.surfaces).row(work.cache.triangles[p]);
  }
  /// Of those manifolds of a pair that are like p's and of its material, leaves the points that matter: on one plane in
  /// one manifold, else each where it is.
  PLUMB_HD void reduce(std::uint32_t p, Span among, Likeness like, bool surface_first) const {
    const Pair pair = work.cache.pairs[p];
    const Shape& surface = shape(surface_first ? pair.a : pair.b);
    const Real reach = shape(surface_first ? pair.b : pair.a).reach;
    const std::uint32_t material = material_of(surface, p);
    const Vec normal = work.cache.found[p].normal;
    PointsOfAll points(normal, kTie * (reach + length(work.cache.found[p].points[0].position)), kClipSlack * reach);
    std::uint32_t leader = kNone, manifolds = 0;
    bool flat = true;
    for (std::uint32_t q = among.begin, others = 0; q < among.end && others < like.most_others; ++q) {
      if (!is_open(q)) continue;
      const Manifold& found = work.cache.found[q];
      const Real difference = length_squared(found.normal - normal);
      if (difference > like.normals || material_of(surface, q) != material) {
        ++others;
        continue;
      }
      others = 0;
      flat = flat && difference <= kSameNormal;
      for (std::uint32_t i = 0; i < found.count; ++i)
        points.add(found.points[i], found.normal, q, SurfaceFeature(found.points[i].feature, surface_first).lasts());
      if (leader == kNone && led_before(q)) leader = q;
      work.cache.touching[q] = 0;
      ++manifolds;
    }
    if (!flat) return leave(points, reach);
    if (leader == kNone) leader = p;
    work.cache.touching[leader] = kLeads;
    if (manifolds > 1) put(points, leader, normal);
  }
  /// All of the chosen points into one manifold: that of who led, for the sake of its colour.
  PLUMB_HD void put(PointsOfAll& points, std::uint32_t leader, const Vec& normal) const {
    Manifold& led = work.cache.found[leader];
    led.normal = normal;
    led.count = points.choose(true);
    for (std::uint32_t i = 0; i < led.count; ++i) {
      led.points[i] = points.chosen(i).point;
      work.cache.point_triangles[leader].of[i] = work.cache.triangles[points.chosen(i).candidate];
    }
  }
  /// The chosen points where they are. Bumps bear along the mean of the normals of all triangles that meet there.
  PLUMB_HD void leave(PointsOfAll& points, Real reach) const {
    const std::uint32_t count = points.choose_bearing(points.choose(false), kBears * reach);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t candidate = points.chosen(i).candidate;
      if (work.cache.touching[candidate] == kLeads) continue;
      Manifold& left = work.cache.found[candidate];
      Vec normals = {0, 0, 0};
      left.count = 0;
      for (std::uint32_t k = i; k < count; ++k) {
        if (points.chosen(k).candidate != candidate) continue;
        left.points[left.count++] = points.chosen(k).point;
        normals += normalized_or(points.chosen(k).normals, left.normal);
      }
      left.normal = normalized_or(normals, left.normal);
      work.cache.touching[candidate] = kLeads;
    }
  }
};

}  // namespace

void reduce_manifolds(Executor& executor, Count candidates, const NarrowPhaseWork& work, const PairTime* impacts) {
  executor.run(candidates, ReduceManifolds{work, candidates, impacts});
}

}  // namespace plumb::impulse
