#include "narrowphase/midphase.hpp"

#include "bodies/way.hpp"
#include "geometry/shape_box.hpp"
#include "narrowphase/carried_manifold.hpp"

namespace plumb::impulse {

namespace {

/// Passes on triangles as pieces of a pair.
template <class Sink>
struct TrianglesOf {
  Pair pair;
  Sink& sink;
  PLUMB_HD void operator()(std::uint32_t triangle) const { sink(pair, triangle, 0); }
};

/// Whether what a pair with a surface touched in the last step is recycled, whole: candidates of the last step.
class LastTouches {
 public:
  PLUMB_HD explicit LastTouches(const NarrowPhaseWork& work, Pair pair) : work_(work), pair_(pair) {}

  /// Whether there are such, and all of them may be recycled.
  [[nodiscard]] PLUMB_HD bool may_be_recycled() const {
    if (is_new(pair_.a) || is_new(pair_.b)) return false;
    bool any = false, all = true;
    for_each([&](std::uint32_t p) {
      Manifold manifold;
      any = true;
      all = work_.last.collided.is_recyclable(p) && carry(work_, work_.last.collided.load(p), pair_, manifold);
      return all;
    });
    return any && all;
  }
  /// For all, in their order, as long as it is true.
  template <class Each>
  PLUMB_HD void for_each(const Each& each) const {
    const std::uint32_t owners[2] = {pair_.a, pair_.b};
    for (const std::uint32_t owner : owners) {
      const PairRange range = work_.last.ranges[owner];
      for (std::uint32_t p = range.first; p < range.first + range.count; ++p)
        if (is_same(work_.last.pairs[p], pair_) && work_.last.touching[p] != 0 && !each(p)) return;
    }
  }

 private:
  [[nodiscard]] PLUMB_HD bool is_new(std::uint32_t proxy) const {
    return work_.proxies.rows[proxy].first_step == work_.parameters->step;
  }

  const NarrowPhaseWork& work_;
  Pair pair_;
};

/// kSwept: some bodies must not pass through others however fast they are.
template <bool kSwept>
struct Search {
  Midphase::Input in;
  const Pair* pairs;
  const PairRange* ranges;

  /// sink(pair, triangle, touching) for every piece of mover i.
  template <class Sink>
  PLUMB_HD void operator()(std::uint32_t i, Sink& sink) const {
    const std::uint32_t mover = in.movers[i];
    const PairRange range = ranges[mover];
    for (std::uint32_t p = range.first; p < range.first + range.count; ++p) {
      const Pair pair = pairs[p];
      const bool surface_a = is_surface(type_of(pair.a)), surface_b = is_surface(type_of(pair.b));
      if (surface_a && surface_b) continue;
      if (!surface_a && !surface_b) {
        sink(pair, 0, 0);
        continue;
      }
      const std::uint32_t surface = surface_a ? pair.a : pair.b, other = surface_a ? pair.b : pair.a;
      if (!is_changed(surface, other) && recycle(pair, sink)) continue;
      triangles(surface, other, TrianglesOf<Sink>{pair, sink});
    }
    for (std::uint32_t k = 0; k < in.planes.count; ++k)
      if (in.filter(mover, in.planes[k]) && reaches(mover, in.planes[k])) sink({mover, in.planes[k]}, 0, 0);
  }

 private:
  [[nodiscard]] PLUMB_HD ShapeType type_of(std::uint32_t proxy) const {
    return in.work.proxies.shapes[in.work.proxies.rows[proxy].shape].type;
  }

  /// False, and does nothing, where not all that was touched may be recycled. A host that is shown contacts may have
  /// disabled some, and what must not pass through others has to look ahead.
  template <class Sink>
  PLUMB_HD bool recycle(Pair pair, Sink& sink) const {
    constexpr std::uint32_t kNever = kBodyShowsContacts | (kSwept ? kBodyContinuous : 0U);
    if (((flags_of(pair.a) | flags_of(pair.b)) & kNever) != 0) return false;
    const LastTouches touches(in.work, pair);
    if (!touches.may_be_recycled()) return false;
    touches.for_each([&](std::uint32_t p) {
      sink(pair, in.work.last.triangles[p], kCarried);
      return true;
    });
    return true;
  }
  [[nodiscard]] PLUMB_HD std::uint32_t flags_of(std::uint32_t proxy) const {
    return in.work.bodies.mass[in.work.proxies.rows[proxy].body].flags;
  }

  /// Whether the surface became another before this step where the other is.
  [[nodiscard]] PLUMB_HD bool is_changed(std::uint32_t surface, std::uint32_t other) const {
    const Proxies& proxies = in.work.proxies;
    const LastChange& change = proxies.surfaces.change(proxies.shapes[proxies.rows[surface].shape]);
    return change.before_step == in.work.parameters->step && overlap(box_on(surface, other), change.where);
  }

  /// Where the other may be, in the frame of a surface.
  [[nodiscard]] PLUMB_HD Box box_on(std::uint32_t surface, std::uint32_t other) const {
    const Proxy &a = in.work.proxies.rows[surface], &b = in.work.proxies.rows[other];
    const ShapePose pose_a = shape_pose(a, in.work.bodies.orientation[a.body]),
                    pose_b = shape_pose(b, in.work.bodies.orientation[b.body]);
    const Vec apart =
        between(in.work.bodies.position[a.body], in.work.bodies.position[b.body]) + pose_b.offset - pose_a.offset;
    const Vec place = rotate_back(pose_a.orientation, apart);
    const Shape& shape = in.work.proxies.shapes[b.shape];
    Box box = shape_box(shape, conjugate(pose_a.orientation) * pose_b.orientation, in.work.proxies.hulls);
    // Rounding must not lose a touch: a few units in the last place of the lengths that enter.
    const Real more = in.work.margins[surface] + in.work.margins[other] + 8 * kEpsilon * (length(place) + shape.reach);
    const Vec wider = {more, more, more};
    box = {place + box.low - wider, place + box.high + wider};
    if constexpr (kSwept) {
      if ((in.work.bodies.mass[b.body].flags & kBodyContinuous) != 0) cover_way(a, pose_a, in.boxes[other], box);
    }
    return box;
  }

  template <class Found>
  PLUMB_HD void triangles(std::uint32_t surface, std::uint32_t other, const Found& found) const {
    const Box box = box_on(surface, other);
    const Shape& on = in.work.proxies.shapes[in.work.proxies.rows[surface].shape];
    if (!overlap(box, Box{-on.size, on.size})) return;
    if (on.type == ShapeType::kMesh)
      in.work.proxies.surfaces.meshes[on.hull].overlaps(box, found);
    else
      in.work.proxies.surfaces.fields[on.hull].overlaps(box, found);
  }

  /// Adds to a box in the frame of a surface where others may be in the step whose box in the world is `swept`.
  PLUMB_HD void cover_way(const Proxy& a, const ShapePose& pose_a, const Box& swept, Box& box) const {
    const StepParameters& step = *in.work.parameters;
    const Way way = way_through_step(in.work.bodies, step, a.body);
    const Vec middle = Real(.5) * (swept.low + swept.high), half = Real(.5) * (swept.high - swept.low);
    const Vec at = middle - between(step.origin, in.work.bodies.position[a.body]) - pose_a.offset;
    const Mat axes = to_matrix(pose_a.orientation);
    // As a surface that moves sees it, they move the other way; where it turns, about the centre of its body.
    const Vec place = multiply_transposed(axes, at), back = multiply_transposed(axes, -step.dt * way.linear);
    const Real furthest = length(at) + length(half) + length(back) + length(a.frame.position);
    const Real turned = min(step.dt * length(way.angular), Real(2)) * furthest + 8 * kEpsilon * length(middle);
    const Vec reach = {dot(abs(axes.x), half) + turned, dot(abs(axes.y), half) + turned,
                       dot(abs(axes.z), half) + turned};
    box.low = min(box.low, min(place, place + back) - reach);
    box.high = max(box.high, max(place, place + back) + reach);
  }

  /// Whether the mover's box comes below the plane.
  [[nodiscard]] PLUMB_HD bool reaches(std::uint32_t mover, std::uint32_t plane) const {
    const Proxy& proxy = in.work.proxies.rows[plane];
    const ShapePose pose = shape_pose(proxy, in.work.bodies.orientation[proxy.body]);
    const Vec n = rotate(pose.orientation, Vec{0, 1, 0});
    const Vec at = between(in.work.parameters->origin, in.work.bodies.position[proxy.body]) + pose.offset;
    const Box& box = in.boxes[mover];
    const Vec middle = Real(.5) * (box.low + box.high), half = Real(.5) * (box.high - box.low);
    const Real reach = dot(abs(n), half);
    return dot(n, middle - at) - reach <= 8 * kEpsilon * (reach + length(middle - at));
  }
};

struct CountSink {
  std::uint32_t count;
  PLUMB_HD void operator()(const Pair&, std::uint32_t, std::uint32_t) { ++count; }
};
template <bool kSwept>
struct CountTriangles {
  Search<kSwept> search;
  std::uint32_t* counts;
  PLUMB_HD void operator()(std::uint32_t i) const {
    CountSink sink{0};
    search(i, sink);
    counts[i] = sink.count;
  }
};

struct WriteSink {
  ContactCache cache;
  std::uint32_t at, end;
  PLUMB_HD void operator()(const Pair& pair, std::uint32_t triangle, std::uint32_t touching) {
    if (at >= end) return;
    cache.pairs[at] = pair;
    cache.touching[at] = touching;
    cache.triangles[at++] = triangle;
  }
};
template <bool kSwept>
struct WriteTriangles {
  Search<kSwept> search;
  const std::uint32_t *counts, *offsets;
  std::uint32_t capacity;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t first = min(offsets[i], capacity), count = min(counts[i], capacity - first);
    const ContactCache& cache = search.in.work.cache;
    cache.ranges[search.in.movers[i]] = {first, count};
    WriteSink sink{cache, first, first + count};
    search(i, sink);
  }
};

/// The step is repeated where the pairs were more than there is room for.
struct CountAsPairs {
  StepCounters* counters;
  std::uint32_t capacity;
  PLUMB_HD void operator()(std::uint32_t) const {
    if (counters->midphase_pairs > capacity) counters->pairs = max(counters->pairs, counters->midphase_pairs);
  }
};

}  // namespace

void Midphase::reserve(std::uint32_t proxies, std::uint32_t pairs) {
  capacity_ = max(capacity_, pairs);
  pairs_.grow(capacity_);
  ranges_.grow(proxies);
  counts_.grow(proxies);
  offsets_.grow(proxies);
  scan_.reserve(proxies);
}

void Midphase::find(Executor& executor, const Input& input, StepCounters* counters, bool swept) {
  const auto find = [&]<bool kSwept>() {
    const Search<kSwept> search{input, pairs_.data(), ranges_.data()};
    executor.run(input.movers.count, CountTriangles<kSwept>{search, counts_.data()});
    scan_.run(executor, input.movers.count, counts_.data(), offsets_.data(), &counters->midphase_pairs);
    executor.run(input.movers.count, WriteTriangles<kSwept>{search, counts_.data(), offsets_.data(), capacity_});
  };
  swept ? find.operator()<true>() : find.operator()<false>();
  executor.run(1U, CountAsPairs{counters, capacity_});
}

}  // namespace plumb::impulse
