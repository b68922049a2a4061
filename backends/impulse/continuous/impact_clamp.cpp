#include "continuous/impact_clamp.hpp"

#include "continuous/impact.hpp"
#include "continuous/inner_points.hpp"
#include "exec/atomic.hpp"
#include "math/ordered_bits.hpp"

namespace plumb::impulse {

namespace {

constexpr std::uint64_t kNever = ~std::uint64_t{0};

/// The convex shape, plane or triangle that a point may come to, in its shape's frame.
struct Obstacle {
  const Shape& shape;
  const Proxies& proxies;
  std::uint32_t triangle;

  [[nodiscard]] PLUMB_HD PartingPlane plane_before(const Vec& point) const {
    if (shape.type == ShapeType::kPlane) return {max(point.y, Real(0)), {0, 1, 0}};
    Shape dot_shape{};  // a ball of no size
    dot_shape.type = ShapeType::kSphere;
    Simplex<Real> simplex;
    const PlacedPair<Real> pair = {shape, dot_shape, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, point, proxies.hulls};
    if (!is_surface(shape.type)) return plane_of(core_gap(pair, simplex, kHuge), core_radius(shape));
    const Triangle seen = triangle_of(shape, proxies.surfaces, triangle);
    return plane_of(core_gap(TrianglePair<Real>(seen, pair, seen.at[0]), simplex, kHuge), 0);
  }

 private:
  PLUMB_HD static PartingPlane plane_of(const CoreGap<Real>& gap, Real radius) {
    if (gap.overlap) return {0, {0, 0, 0}};
    return {max(gap.distance - radius, Real(0)), gap.normal};
  }
};

struct Forget {
  std::uint64_t* first;
  std::uint32_t* stays;
  PLUMB_HD void operator()(std::uint32_t body) const {
    first[body] = kNever;
    stays[body] = ordered_bits(1);
  }
};

/// How much of its way a flagged body may go without leaving the box of a shape on it, where it comes to what was not
/// seen from there.
struct FindSight {
  ImpactClamp::Input in;
  Bodies bodies;
  const Displacement* displacements;
  std::uint32_t* stays;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t index = in.movers[i];
    const Proxy& proxy = in.proxies.rows[index];
    if (proxy.shape == kNone || (bodies.mass[proxy.body].flags & kBodyContinuous) == 0) return;
    if (is_undone(*in.counters, in.pair_capacity)) return;
    const Vec& way = displacements[proxy.body].linear;
    const Real inside = in.proxies.shapes[proxy.shape].reach / 2;
    if (!(length_squared(way) > inside * inside)) return;
    const Vec now = between(in.parameters->origin, bodies.position[proxy.body]) +
                    rotate(bodies.orientation[proxy.body], proxy.frame.position);
    const Box& box = in.boxes[index];
    Real share = 1;
    for (int k = 0; k < 3; ++k) {
      const Real beyond = max(now[k] + inside - box.high[k], box.low[k] - (now[k] - inside));
      if (beyond > 0) share = min(share, max(Real(1) - beyond / abs(way[k]), Real(0)));
    }
    if (!(share < 1) || !is_barred(index, now, (share - 1) * way)) return;
    atomic_min(&stays[proxy.body], ordered_bits(share));
  }

 private:
  /// Convex shapes that the box touches were seen whole.
  struct Unseen {
    const FindSight& sight;
    std::uint32_t index;
    bool found = false;
    PLUMB_HD void operator()(std::uint32_t other) {
      const Proxy& proxy = sight.in.proxies.rows[other];
      const bool whole = !is_surface(sight.in.proxies.shapes[proxy.shape].type);
      found = found || !(whole && overlap(sight.in.boxes[other], sight.in.boxes[index]));
    }
  };
  /// Whether something that does not move was not seen between a place of the shape and the way back from there.
  PLUMB_HD bool is_barred(std::uint32_t index, const Vec& place, const Vec& back) const {
    const Real reach = in.proxies.shapes[in.proxies.rows[index].shape].reach;
    const Vec ball = {reach, reach, reach};
    Unseen unseen{*this, index};
    in.statics.overlaps(Box{min(place, place + back) - ball, max(place, place + back) + ball}, in.statics.root(),
                        unseen);
    for (std::uint32_t k = 0; k < in.planes.count && !unseen.found; ++k) {
      const Proxy& plane = in.proxies.rows[in.planes[k]];
      const ShapePose pose = shape_pose(plane, bodies.orientation[plane.body]);
      const Vec at = between(in.parameters->origin, bodies.position[plane.body]) + pose.offset;
      unseen.found = dot(rotate(pose.orientation, Vec{0, 1, 0}), place - at) < reach;
    }
    return unseen.found;
  }
};

struct StayInSight {
  Position* position;
  Displacement* displacements;
  const std::uint32_t* stays;
  PLUMB_HD void operator()(std::uint32_t body) const {
    if (stays[body] == ordered_bits(1)) return;
    Vec& way = displacements[body].linear;
    const Vec back = (number_of(stays[body]) - 1) * way;
    if (!is_finite(back)) return;
    position[body] = moved(position[body], back);
    way += back;
  }
};

/// The way of a body through the step as it came out: straight, and turning evenly.
struct Passage {
  Quat before;
  Vec way, turn;  ///< of the whole step, m and rad

  PLUMB_HD Passage(const Bodies& bodies, const Displacement* displacements, std::uint32_t body) {
    const Displacement& displacement = displacements[body];
    before = normalized(conjugate(displacement.rotation) * bodies.orientation[body]);
    way = displacement.linear;
    const Vec axis = vector_part(displacement.rotation);
    const Real sine = length(axis), w = displacement.rotation.w;
    const Real angle = 2 * angle_of(sine, abs(w)) * (w < 0 ? Real(-1) : Real(1));
    turn = sine > 0 ? (angle / sine) * axis : Vec{0, 0, 0};
  }
  [[nodiscard]] PLUMB_HD Quat at(Real share) const { return normalized(turn_by(share * turn) * before); }
};

/// The passage of a body as another sees it.
struct Meeting {
  Passage own, other;
  Vec before;  ///< from the other's centre of mass to its own

  PLUMB_HD Meeting(const Bodies& bodies, const Displacement* displacements, std::uint32_t body, std::uint32_t on)
      : own(bodies, displacements, body), other(bodies, displacements, on) {
    before = between(bodies.position[on], bodies.position[body]) - own.way + other.way;
  }
  [[nodiscard]] PLUMB_HD Vec apart(Real share) const { return before + share * (own.way - other.way); }
};

struct FindPassed {
  ImpactClamp::Input in;
  Bodies bodies;
  const Displacement* displacements;
  std::uint64_t* first;

  PLUMB_HD void operator()(std::uint32_t p) const {
    if (is_undone(*in.counters, in.pair_capacity) || in.changes.disables(p)) return;
    const Pair pair = in.cache.pairs[p];
    const auto is_guarded = [this](std::uint32_t proxy) {  // not asleep
      constexpr std::uint32_t kBoth = kBodyContinuous | kBodyDynamic;
      return (bodies.mass[in.proxies.rows[proxy].body].flags & kBoth) == kBoth;
    };
    if (is_guarded(pair.b))
      look(p, in.proxies.rows[pair.b], in.proxies.rows[pair.a]);
    else if (is_guarded(pair.a))
      look(p, in.proxies.rows[pair.a], in.proxies.rows[pair.b]);
  }

 private:
  PLUMB_HD void look(std::uint32_t p, const Proxy& own, const Proxy& wall) const {
    const InnerPoints points(in.proxies.shapes[own.shape], in.proxies.hulls);
    const Meeting meeting(bodies, displacements, own.body, wall.body);
    const Obstacle obstacle = {in.proxies.shapes[wall.shape], in.proxies,
                               in.cache.triangles == nullptr ? 0U : in.cache.triangles[p]};
    Real earliest = 1;
    for (int i = 0; i < points.count; ++i) {
      const Vec arm = own.frame.position + rotate(own.frame.orientation, points.at[i]);
      earliest = min(earliest, time_of_passing({meeting, wall.frame, arm}, obstacle, points.depth));
    }
    if (earliest < 1) atomic_min(&first[own.body], std::uint64_t{ordered_bits(earliest)} << 32 | p);
  }

  /// A point of a body, as a shape on another sees it.
  struct PointWay {
    const Meeting& meeting;
    const Frame& frame;  ///< of the shape in its body's
    Vec arm;             ///< of the point in its own

    [[nodiscard]] PLUMB_HD Vec at(Real share, const Quat& on) const {
      const Vec place = meeting.apart(share) + rotate(meeting.own.at(share), arm) - rotate(on, frame.position);
      return rotate_back(on * frame.orientation, place);
    }
    /// Of the speed with which the two turn past each other, per share.
    [[nodiscard]] PLUMB_HD Real turning() const {
      const Real own = length(arm), way = length(meeting.own.way - meeting.other.way);
      return length(meeting.own.turn) * own + length(meeting.other.turn) * (length(meeting.before) + way + own);
    }
  };

  /// As a share of the way; 1: it does not pass. What would comes no nearer than half its depth.
  PLUMB_HD static Real time_of_passing(const PointWay& point, const Obstacle& obstacle, Real depth) {
    const Meeting& meeting = point.meeting;
    if (!(2 * (length(meeting.own.way - meeting.other.way) + point.turning()) > depth)) return 1;
    const Real gap = obstacle.plane_before(point.at(0, meeting.other.at(0))).gap;
    if (!(gap > Real(1e-3) * depth)) return 1;  // it begins in there: the narrow phase brings it out
    const Real passing = Real(0.1) * min(depth, gap);
    if (!(time_of_coming(point, obstacle, passing, passing / 10) < 1)) return 1;
    const Real near = min(Real(0.6) * depth, Real(0.99) * gap);
    return time_of_coming(point, obstacle, near, min(near / 10, (gap - near) / 2));
  }
  /// Within `close` of so near.
  PLUMB_HD static Real time_of_coming(const PointWay& point, const Obstacle& obstacle, Real near, Real close) {
    const Meeting& meeting = point.meeting;
    const auto part = [&](Real share) {
      const Quat on = meeting.other.at(share);
      const PartingPlane plane = obstacle.plane_before(point.at(share, on));
      return PartingPlane{max(plane.gap - near, Real(0)), rotate(on * point.frame.orientation, plane.normal)};
    };
    Impact impact;
    const Course course = advance(meeting.other.way - meeting.own.way, point.turning(), Real(1), close, part, impact);
    return course == Course::kImpact ? impact.time : Real(1);
  }
};

struct PutBack {
  ImpactClamp::Input in;
  MovableBodies bodies;
  Displacement* displacements;
  const std::uint64_t* first;

  PLUMB_HD void operator()(std::uint32_t body) const {
    if (first[body] == kNever) return;
    const Real share = number_of(static_cast<std::uint32_t>(first[body] >> 32));
    const Pair pair = in.cache.pairs[static_cast<std::uint32_t>(first[body])];
    const std::uint32_t a = in.proxies.rows[pair.a].body, b = in.proxies.rows[pair.b].body, on = a == body ? b : a;
    const Passage own(bodies, displacements, body);
    Quat orientation = own.at(share);
    Vec back = (share - 1) * own.way;
    const bool goes_on = is_kinematic(bodies.mass[on]);
    if (goes_on && (bodies.mass[body].flags & kBodyLocked) == 0) {
      const Meeting meeting(bodies, displacements, body, on);
      const Quat since = bodies.orientation[on] * conjugate(meeting.other.at(share));
      back = rotate(since, meeting.apart(share)) - meeting.apart(1);
      orientation = normalized(since * orientation);
    }
    if (!is_finite(back) || !is_finite(orientation.w)) return;
    bodies.position[body] = moved(bodies.position[body], back);
    displacements[body].linear += back;
    if ((bodies.mass[body].flags & kBodyTurns) == 0) return;
    bodies.orientation[body] = orientation;
    displacements[body].rotation = normalized(orientation * conjugate(own.before));
  }
};

}  // namespace

void ImpactClamp::reserve(std::uint32_t bodies) {
  stays_.grow(bodies);
  first_.grow(bodies);
}

void ImpactClamp::clamp(Executor& executor, const Input& input, const MovableBodies& bodies, std::uint32_t body_count,
                        Displacement* displacements) {
  executor.run(body_count, Forget{first_.data(), stays_.data()});
  executor.run(input.movers.count, FindSight{input, bodies, displacements, stays_.data()});
  executor.run(body_count, StayInSight{bodies.position, displacements, stays_.data()});
  executor.run(input.candidates, FindPassed{input, bodies, displacements, first_.data()});
  executor.run(body_count, PutBack{input, bodies, displacements, first_.data()});
}

}  // namespace plumb::impulse
