// Casts of shapes that turn on their way, against closed forms, against casts that do not turn, and against a walk in
// steps by the referee's distances.
#include <algorithm>
#include <cmath>
#include <optional>

#include "conform/queries/query_target.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

PlumbDegree claim(Conformance& c, PlumbShapeType type) {
  return c.backend().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_TURNING_CAST, type);
}
/// m that a place on the way may be off.
double slack(Conformance& c, PlumbShapeType type) { return claim(c, type) == PLUMB_APPROXIMATE ? 2e-3 : 2e-4; }

void require_turning(Conformance& c, PlumbShapeType type) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_TURNING_CAST, type, "casts that turn");
}

std::vector<PlumbHit> ask(Probe& in, PlumbHitMode mode, std::span<const PlumbTurningCast> casts) {
  const Hits found = in.world().queries()->turning_casts(mode, casts);
  check(in.world(), found.result);
  return {found.hits.begin(), found.hits.end()};
}
PlumbHit nearest(Probe& in, const PlumbTurningCast& cast) { return ask(in, PLUMB_HIT_CLOSEST, {&cast, 1}).at(0); }

/// A rod along y, of whose rounded ends the middles are a metre from its own.
PlumbShapeDesc rod_desc() {
  PlumbShapeDesc desc = shape_desc(PLUMB_CAPSULE);
  desc.radius = 0.25;
  desc.half_height = 1;
  return desc;
}
/// Before a rod that turns about its middle lies along a ball's direction it touches the ball; by that angle, rad.
double ahead_of(double distance, double radius) { return std::asin((0.25 + radius) / distance); }

// --- closed forms ----------------------------------------------------------------------------------------------------

/// A rod that turns on the spot meets a ball beside its path, and all round again.
void rod_meets_ball(Conformance& c) {
  require_turning(c, PLUMB_CAPSULE);
  Probe world(c, kQueryNeeds, Vec::Zero());
  const PlumbShape rod = world.shape(rod_desc());
  const double far = 1.1, radius = 0.5, ahead = ahead_of(far, radius), off = slack(c, PLUMB_CAPSULE);
  const PlumbBody ball = world.fixed(world.sphere(radius), {-far, 0, 0});
  struct Turn {
    double rotation, met;  ///< rad about z; met: where it touches
  };
  for (const Turn turn : {Turn{M_PI, M_PI / 2 - ahead}, Turn{-M_PI, M_PI / 2 - ahead}, Turn{2 * M_PI, M_PI / 2 - ahead},
                          Turn{M_PI / 2, M_PI / 2 - ahead}, Turn{M_PI / 2 - 1.1 * ahead, -1}}) {
    const PlumbHit hit = nearest(world, {rod, {{0, 0, 0}, kLevel}, {0, 0, 0}, {0, 0, turn.rotation}, kSeesAll});
    c.expect((hit.body == ball) == (turn.met >= 0), "a rod that turns by {:.3f} rad {} the ball", turn.rotation,
             hit.body == ball ? "meets" : "misses");
    if (hit.body != ball || turn.met < 0) continue;
    c.expect(std::abs(hit.fraction * std::abs(turn.rotation) - turn.met) < off, "it meets it at {:.5f} rad, not {:.5f}",
             hit.fraction * std::abs(turn.rotation), turn.met);
    // Of the rod's two ends that come to the ball this is the upper, or the lower, and its side.
    const double side = turn.rotation > 0 ? 1 : -1, angle = M_PI / 2 + side * turn.met + (side > 0 ? 0 : M_PI);
    const Vec normal(-std::sin(angle) * -side, std::cos(angle) * -side, 0);
    c.expect((vec(hit.normal) - normal).norm() < 20 * off, "the ball's normal is {:.4f} {:.4f}, not {:.4f} {:.4f}",
             hit.normal.x, hit.normal.y, normal.x(), normal.y());
    c.expect((vec(hit.position) - (Vec(-far, 0, 0) + radius * normal)).norm() < 20 * off,
             "it meets it at {:.4f} {:.4f} {:.4f}", hit.position.x, hit.position.y, hit.position.z);
  }
}

/// The flat top of a body of each kind, at y = 0.
PlumbBody add_floor(Probe& world, PlumbShapeType type) {
  static constexpr double kSquare[] = {-4, 0, -4, 4, 0, -4, -4, 0, 4, 4, 0, 4},
                          kBlock[] = {-4, 0, -4, 4, 0, -4, -4, 0, 4, 4, 0, 4, 0, -3, 0}, kHeights[9] = {};
  static constexpr std::uint32_t kTriangles[] = {0, 2, 1, 1, 2, 3};
  PlumbShapeDesc desc = shape_desc(type);
  desc.half_extents = {4, 0.5, 4};
  desc.vertices = type == PLUMB_CONVEX_HULL ? kBlock : kSquare;
  desc.vertex_count = type == PLUMB_CONVEX_HULL ? 5 : 4;
  desc.indices = kTriangles;
  desc.triangle_count = 2;
  desc.heights = kHeights;
  desc.rows = desc.columns = 3;
  desc.spacing = {4, 0, 4};
  PlumbCompoundChild child = {0, identity_pose(), 0, 0, {}};
  if (type == PLUMB_COMPOUND) {
    child.shape = world.box({4, 0.5, 4});
    child.pose.position.y = -0.5;
    desc.children = &child;
    desc.child_count = 1;
  }
  return world.fixed(world.shape(desc), {0, type == PLUMB_BOX ? -0.5 : 0, 0});
}

/// A board that tips over: its lower corner meets the floor. And a ball that comes down: its turning is nothing.
void board_meets_floor(Conformance& c) {
  require_turning(c, PLUMB_BOX);
  const double a = 1, b = 0.1, high = 0.6, tips = std::asin(high / std::hypot(a, b)) - std::atan2(b, a),
               off = slack(c, PLUMB_BOX);
  for (const PlumbShapeType type :
       {PLUMB_BOX, PLUMB_CONVEX_HULL, PLUMB_COMPOUND, PLUMB_PLANE, PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD}) {
    if (c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_STATIC) == PLUMB_NONE) continue;
    Probe world(c, kQueryNeeds, Vec::Zero());
    const PlumbBody floor = add_floor(world, type);
    const char* name = backend::shape_name(type);
    const PlumbShape board = world.box({a, b, 0.5});
    const PlumbHit tipped = nearest(world, {board, {{0.3, high, 0.2}, kLevel}, {0, 0, 0}, {0, 0, 1.5}, kSeesAll});
    c.expect(tipped.body == floor && std::abs(1.5 * tipped.fraction - tips) < off,
             "a board tips by {:.5f} rad onto a {} instead of {:.5f}", 1.5 * tipped.fraction, name, tips);
    c.expect((vec(tipped.normal) - Vec::UnitY()).norm() < 20 * off, "the normal of a {} is {:.4f} {:.4f} {:.4f}", name,
             tipped.normal.x, tipped.normal.y, tipped.normal.z);
    const double x = 0.3 - a * std::cos(tips) + b * std::sin(tips);
    c.expect(std::abs(tipped.position.x - x) < 20 * off && std::abs(tipped.position.y) < 20 * off,
             "its corner meets a {} at {:.4f} {:.4f} instead of {:.4f} 0", name, tipped.position.x, tipped.position.y,
             x);
    const PlumbHit hopped = nearest(world, {board, {{0.3, 1.1, 0.2}, kLevel}, {0.5, 0, 0}, {0, 0, 2 * M_PI}, kSeesAll});
    c.expect(hopped.body == 0, "a board that turns 1.1 m above a {} meets it at fraction {:.4f}", name,
             hopped.fraction);
    if (claim(c, PLUMB_SPHERE) == PLUMB_NONE) continue;
    const PlumbTurningCast down = {world.sphere(0.5), {{0, 3, 0}, kLevel}, {1, -5, 0.5}, {1, -2, 3}, kSeesAll};
    const PlumbHit landed = nearest(world, down);
    c.expect(landed.body == floor && std::abs(5 * landed.fraction - 2.5) < off,
             "a ball goes {:.5f} m down to a {} instead of 2.5", 5 * landed.fraction, name);
  }
}

// --- against other answers -------------------------------------------------------------------------------------------

/// The first place on a way where the referee sees a target touched; nothing where that is not sure.
struct Walk {
  bool is_sure = true;
  std::optional<double> met;  ///< fraction
};

PlumbPose pose_at(const PlumbTurningCast& cast, double fraction) {
  const Vec r = vec(cast.rotation);
  const double angle = r.norm();
  const PlumbQuat& q = cast.pose.orientation;
  const Eigen::Quaterniond turned =
      Eigen::AngleAxisd(fraction * angle, angle > 0 ? Vec(r / angle) : Vec(Vec::UnitX())) *
      Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  return {vec3(vec(cast.pose.position) + fraction * vec(cast.translation)),
          {turned.x(), turned.y(), turned.z(), turned.w()}};
}

/// m that the fastest point goes all along the way, at most.
double speed_of(const PlumbTurningCast& cast, double reach) {
  return vec(cast.translation).norm() + reach * vec(cast.rotation).norm();
}

/// In steps so long that the furthest point cannot have met what is nearest, and no shorter than a share of the way.
Walk walk(const Target& target, const referee::Shape& shape, double reach, const PlumbTurningCast& cast,
          double margin) {
  const double speed = speed_of(cast, reach);
  Walk result;
  for (double fraction = 0; fraction <= 1;) {
    const double gap = target.distance(shape, referee::pose(pose_at(cast, fraction)));
    if (gap < margin / 100) {
      result.met = fraction;
      // A glance that is over at once is seen by one and not by another.
      const double later = target.distance(shape, referee::pose(pose_at(cast, fraction + 2 * margin / speed)));
      result.is_sure = result.is_sure && fraction > 0 && later < -margin / 10;
      return result;
    }
    if (gap < margin && fraction + 4 * margin / speed > 1) result.is_sure = false;
    fraction += std::max(gap - margin / 200, margin / 100) / speed;
  }
  return result;
}

void compare_turning(Conformance& c, PlumbShapeType type, PlumbShapeType at) {
  Target target(c, at);
  const PlumbShapeDesc desc = convex_desc(type);
  const PlumbShape shape = target.probe.shape(desc);
  const referee::ShapePtr known = referee::Shape::make(desc);
  constexpr double kReach = 0.75;  // of all of convex_desc
  const double off = slack(c, type), margin = 5 * off;
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  int compared = 0, late = 0, early = 0, beside = 0;
  std::vector<PlumbTurningCast> casts;
  while (casts.size() < 24) {
    const Vec from = target.place_about(random, 2.5), to = target.place_about(random, 1.5);
    const Vec rotation = 3 * Vec(unit(random), unit(random), unit(random));
    const PlumbTurningCast cast = {
        shape, {vec3(from), any_turn(random)}, vec3(1.2 * (to - from)), vec3(rotation), kSeesAll};
    if (target.is_before(from) && target.distance(*known, referee::pose(cast.pose)) > margin) casts.push_back(cast);
  }
  const std::vector<PlumbHit> hits = ask(target.probe, PLUMB_HIT_CLOSEST, casts);
  for (std::size_t i = 0; i < casts.size() && i < hits.size(); ++i) {
    const Walk truth = walk(target, *known, kReach, casts[i], margin);
    if (!truth.is_sure) continue;
    ++compared;
    const bool met = hits[i].body == target.body;
    if (truth.met.has_value() != met) {
      ++(met ? early : late);
      continue;
    }
    if (!met) continue;
    // A little before it touches it is as little away: how deep it is after that engines and referee measure otherwise.
    const double before = std::max(0.0, hits[i].fraction - 2 * off / speed_of(casts[i], kReach)),
                 gap = target.distance(*known, referee::pose(pose_at(casts[i], before)));
    if (gap < -off / 2) ++late;
    if (gap > 3 * off) ++early;
    // The place told is on both.
    if (std::abs(target.distance(vec(hits[i].position))) > 10 * off) ++beside;
  }
  const char *name = backend::shape_name(type), *of = backend::shape_name(at);
  c.expect(compared >= 12, "only {} turning casts of a {} at a {} are sure", compared, name, of);
  const int allowed = claim(c, type) == PLUMB_APPROXIMATE ? compared / 10 : 0;
  c.expect(late <= allowed, "{} of {} turning casts of a {} end in a {}", late, compared, name, of);
  c.expect(early <= allowed, "{} of {} turning casts of a {} end before a {}", early, compared, name, of);
  c.expect(beside == 0, "{} of {} places told of a {} are beside a {}", beside, compared, name, of);
}

void shapes_that_turn(Conformance& c) {
  require_turning(c, PLUMB_SPHERE);
  for (const PlumbShapeType type : kConvex)
    for (const PlumbShapeType at : kTargets)
      if (claim(c, type) != PLUMB_NONE && c.backend().capability(PLUMB_CAP_SHAPE, at, PLUMB_STATIC) != PLUMB_NONE &&
          c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_DYNAMIC) != PLUMB_NONE)
        compare_turning(c, type, at);
}

/// What does not turn, and a ball however it turns, does what it does in a cast.
void straight(Conformance& c) {
  require_turning(c, PLUMB_SPHERE);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SPHERE, "sphere casts");
  Probe world(c, kQueryNeeds, Vec::Zero());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60; ++i)
    world.fixed(i % 2 == 0 ? world.sphere(0.4) : world.box({0.5, 0.3, 0.4}),
                4 * Vec(unit(random), unit(random), unit(random)));
  const PlumbShape ball = world.sphere(0.3);
  std::vector<PlumbCast> casts;
  std::vector<PlumbTurningCast> turning;
  for (int i = 0; i < 60; ++i) {
    const PlumbVec3 from = {6 * unit(random), 6 * unit(random), 6 * unit(random)},
                    way = {-1.5 * from.x, -1.5 * from.y, -1.5 * from.z};
    casts.push_back({ball, {from, kLevel}, way, kSeesAll});
    const double turn = i % 2 == 0 ? 0 : 1;
    turning.push_back({ball, {from, kLevel}, way, {turn, 2 * turn, -turn}, kSeesAll});
  }
  const double off = slack(c, PLUMB_SPHERE) + (c.is_exact(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SPHERE) ? 0 : 0.02);
  const Hits found = world.world().queries()->cast_shapes(PLUMB_HIT_ALL, casts);
  const std::vector<PlumbHit> wanted(found.hits.begin(), found.hits.end());
  const std::vector<PlumbHit> got = ask(world, PLUMB_HIT_ALL, turning);
  const auto of = [](const std::vector<PlumbHit>& hits, const PlumbHit& hit) {
    return std::find_if(hits.begin(), hits.end(),
                        [&](const PlumbHit& other) { return other.query == hit.query && other.body == hit.body; });
  };
  int unlike = 0, unpaired = 0;
  for (const PlumbHit& hit : wanted)
    if (const auto other = of(got, hit); other == got.end())
      ++unpaired;
    else if (std::abs(other->fraction - hit.fraction) * vec(casts[hit.query].translation).norm() > 20 * off)
      ++unlike;
  for (const PlumbHit& hit : got)
    if (of(wanted, hit) == wanted.end()) ++unpaired;
  c.expect(wanted.size() > 40, "only {} hits", wanted.size());
  c.expect(unlike == 0, "{} of {} hits of a ball are elsewhere when it turns", unlike, wanted.size());
  c.expect(unpaired <= 2, "{} of {} hits of a ball are of one kind of cast alone", unpaired, wanted.size());  // grazed
}

/// A rod that swings through a ring of balls meets them in turn, each once; those it may not see, and sensors, never.
void ring(Conformance& c) {
  require_turning(c, PLUMB_CAPSULE);
  c.require_needs(PLUMB_NEED_FILTERS | PLUMB_NEED_SENSORS);
  Probe world(c, kQueryNeeds | PLUMB_NEED_FILTERS | PLUMB_NEED_SENSORS, Vec::Zero());
  const PlumbShape rod = world.shape(rod_desc()), small = world.sphere(0.1);
  const double far = 0.9, ahead = ahead_of(far, 0.1), off = slack(c, PLUMB_CAPSULE);
  std::vector<PlumbBody> met;
  for (int i = 0; i < 8; ++i) {
    const double angle = M_PI / 2 + 0.6 + 0.3 * i;  // the rod's upper end comes there
    PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
    desc.material.friction = 0;
    desc.shape = small;
    desc.pose.position = {far * std::cos(angle), far * std::sin(angle), 0};
    if (i == 2) desc.filter.category = 4;
    if (i == 5) desc.flags |= PLUMB_BODY_SENSOR;
    met.push_back(world.body(desc));
  }
  const double whole = 2.9;
  const PlumbTurningCast swing = {rod, {{0, 0, 0}, kLevel}, {0, 0, 0}, {0, 0, whole}, {1, 1, 0, 0}};
  const std::vector<PlumbHit> all = ask(world, PLUMB_HIT_ALL, {&swing, 1});
  std::size_t next = 0;
  for (int i = 0; i < 8; ++i) {
    if (i == 2 || i == 5) continue;
    const double angle = 0.6 + 0.3 * i - ahead;
    if (next >= all.size()) break;
    c.expect(all[next].body == met[static_cast<std::size_t>(i)] && std::abs(all[next].fraction * whole - angle) < off,
             "hit {} is at {:.5f} rad instead of {:.5f} of ball {}", next, all[next].fraction * whole, angle, i);
    ++next;
  }
  c.expect(all.size() == 6, "{} hits of 6 balls of 8 that it may see", all.size());
  const PlumbHit first = nearest(world, swing);
  c.expect(first.body == met[0], "the closest hit is not that of the first ball");
  PlumbTurningCast from_within = swing;
  from_within.pose.position = {far * std::cos(M_PI / 2 + 0.6), far * std::sin(M_PI / 2 + 0.6), 0};
  const PlumbHit start = nearest(world, from_within);
  c.expect(start.body == met[0] && start.fraction == 0, "what is overlapped at the start is met at fraction {:.4f}",
           start.fraction);
}

/// What may not be asked is refused, and nothing is written.
void bad_turning_casts(Conformance& c) {
  require_turning(c, PLUMB_SPHERE);
  Probe world(c, kQueryNeeds, Vec::Zero());
  const PlumbShape ball = world.sphere(0.5);
  const double nan = std::nan("");
  const PlumbTurningCast good = {ball, identity_pose(), {1, 0, 0}, {0, 0, 1}, kSeesAll};
  std::vector<PlumbTurningCast> bad(5, good);
  bad[0].rotation = {0, 5, 5};
  bad[1].rotation = bad[1].translation = {0, 0, 0};
  bad[2].rotation.x = nan;
  bad[3].translation.y = nan;
  bad[4].shape = ball + 77;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const PlumbTurningCast both[2] = {good, bad[i]};
    const PlumbResult result = world.world().queries()->turning_casts(PLUMB_HIT_CLOSEST, both).result;
    c.expect(result == (i == 4 ? PLUMB_E_STALE_HANDLE : PLUMB_E_INVALID_ARGUMENT), "bad cast {} is answered {}", i,
             result);
  }
  PlumbTurningCast whole = good;
  whole.rotation = {0, 2 * M_PI, 0};
  c.expect(world.world().queries()->turning_casts(PLUMB_HIT_CLOSEST, {&whole, 1}).result >= 0,
           "a whole turn is refused");
}

}  // namespace

std::span<const Check> turning_cast_checks() {
  static constexpr Check checks[] = {
      {"turning.rod", "a rod that turns on the spot meets a ball at the angle of its closed form", &rod_meets_ball},
      {"turning.board", "a board tips onto floors of every kind at the angle of its closed form", &board_meets_floor},
      {"turning.shapes", "every shape at every shape, against a walk by the referee", &shapes_that_turn},
      {"turning.straight", "a ball that turns, and one that does not, against casts", &straight},
      {"turning.all", "all hits of a swing, in their order, by the filters' rule, without sensors", &ring},
      {"turning.refusals", "more than a whole turn, no way, and what is no number are refused", &bad_turning_casts},
  };
  return checks;
}

}  // namespace plumb::harness::conform
