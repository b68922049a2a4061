// What a backend shows of itself (plumb.debug/1), against the referee's geometry and what the interface says elsewhere.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "conform/probe.hpp"
#include "referee/penetration.hpp"

namespace plumb::harness::conform {
namespace {

/// m: how far bodies may have moved between what is shown and what is read, and engines may be off. Some round corners.
constexpr double kSlack = 0.05;

/// The rows that one of the functions shows now. Skips where the backend cannot show them.
template <class Row>
std::span<const Row> shown(IPhysicsWorld& world, PlumbResult (IDebug::*look)(std::span<const Row>&), const char* what) {
  if (world.debug() == nullptr) throw Skipped{"no " PLUMB_EXT_DEBUG};
  std::span<const Row> rows;
  const PlumbResult result = (world.debug()->*look)(rows);
  if (result == PLUMB_E_UNSUPPORTED) throw Skipped{fmt::format("no {}: {}", what, world.error_text())};
  check(world, result);
  return rows;
}

struct Item {
  PlumbBody body;
  referee::ShapePtr shape;
};

/// Pairs of convex bodies, each far from the others: of one in two the bodies overlap a little, of the other there is a
/// gap as small.
struct Couples {
  static constexpr double kOverlap = 0.03;
  struct Couple {
    Item a, b;
    bool touches;
  };
  Probe probe;
  std::vector<Couple> couples;

  explicit Couples(Conformance& c) : probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION, Vec::Zero()) {
    std::mt19937 random(3);
    for (int i = 0; i < 24; ++i) {
      PlumbPose pose_a = somewhere(random), pose_b = somewhere(random);
      pose_a.position = {4.0 * i, 1, -2};
      PlumbShapeDesc desc_a = some_shape(random, i % 2 == 0), desc_b = some_shape(random, i % 3 == 0);
      const referee::ShapePtr a = referee::Shape::make(desc_a), b = referee::Shape::make(desc_b);
      const bool touches = i % 4 < 2;
      const Vec way = vec(pose_b.position).normalized();
      double near = 0, far = 3;  // at the one they overlap by more than is wanted, at the other they are apart
      for (int k = 0; k < 60; ++k) {
        const double middle = (near + far) / 2;
        pose_b.position = vec3(vec(pose_a.position) + middle * way);
        const double depth = referee::penetration(*a, referee::pose(pose_a), *b, referee::pose(pose_b)).depth;
        (depth > (touches ? kOverlap : -kOverlap) ? near : far) = middle;
      }
      couples.push_back({{add(desc_a, pose_a, PLUMB_DYNAMIC), a},
                         {add(desc_b, pose_b, i % 5 == 0 ? PLUMB_STATIC : PLUMB_DYNAMIC), b},
                         touches});
    }
    probe.step(1, 1e-4);
  }

  [[nodiscard]] referee::Pose pose(PlumbBody body) {
    return {probe.orientation(body).toRotationMatrix(), probe.position(body)};
  }

 private:
  template <class Random>
  static PlumbPose somewhere(Random& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const Vec at(unit(random), unit(random), unit(random));
    const auto q = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
    return {vec3(at), {q.x(), q.y(), q.z(), q.w()}};
  }
  template <class Random>
  static PlumbShapeDesc some_shape(Random& random, bool box) {
    std::uniform_real_distribution<double> size(0.3, 0.6);
    PlumbShapeDesc desc = shape_desc(box ? PLUMB_BOX : PLUMB_SPHERE);
    desc.radius = size(random);
    desc.half_extents = {size(random), size(random), size(random)};
    return desc;
  }
  PlumbBody add(const PlumbShapeDesc& shape, const PlumbPose& pose, PlumbMotion motion) {
    PlumbBodyDesc desc = body_desc(motion);
    desc.material.friction = 0;
    desc.shape = probe.shape(shape);
    desc.pose = pose;
    return probe.body(desc);
  }
};

bool is_inside(const PlumbDebugBox& box, const PlumbDebugBox& outer, double slack) {
  return ((vec(box.lower) - vec(outer.lower)).array() >= -slack).all() &&
         ((vec(outer.upper) - vec(box.upper)).array() >= -slack).all();
}

/// Every body is within its leaves.
void boxes(Conformance& c) {
  Couples scene(c);
  std::map<PlumbBody, referee::Aabb> leaves;
  for (const PlumbDebugBox& row : shown(scene.probe.world(), &IDebug::tree_boxes, "boxes")) {
    c.expect((vec(row.lower).array() <= vec(row.upper).array()).all(), "a box at depth {} is inside out", row.depth);
    if (row.body == 0) continue;
    leaves[row.body].include(vec(row.lower));
    leaves[row.body].include(vec(row.upper));
  }
  for (const auto& couple : scene.couples)
    for (const Item& item : {couple.a, couple.b}) {
      c.expect(leaves.contains(item.body), "body {} has no box", slot_of(item.body));
      const referee::Aabb bounds = item.shape->bounds(scene.pose(item.body)), box = leaves[item.body];
      c.expect((box.low.array() <= bounds.low.array() + kSlack).all() &&
                   (box.high.array() >= bounds.high.array() - kSlack).all(),
               "body {} is not within its box", slot_of(item.body));
    }
}

/// Every tree has one root, and inner boxes hold what is below them.
void trees(Conformance& c) {
  Couples scene(c);
  const auto rows = shown(scene.probe.world(), &IDebug::tree_boxes, "boxes");
  std::map<std::uint32_t, int> roots;
  std::map<std::pair<std::uint32_t, std::int32_t>, std::vector<const PlumbDebugBox*>> inner;  // by tree and depth
  for (const PlumbDebugBox& row : rows) {
    c.expect(row.depth >= (row.body == 0 ? 0 : -1), "a box has depth {}", row.depth);
    if (row.depth >= 0) roots[row.tree] += row.depth == 0;
    if (row.body == 0) inner[{row.tree, row.depth}].push_back(&row);
  }
  if (roots.empty()) throw Skipped{"no boxes of a tree"};
  for (const auto& [tree, count] : roots) c.expect(count == 1, "tree {} has {} roots", tree, count);
  for (const PlumbDebugBox& row : rows) {
    if (row.depth <= 0) continue;
    const auto& above = inner[{row.tree, row.depth - 1}];
    c.expect(std::any_of(above.begin(), above.end(), [&](const auto* box) { return is_inside(row, *box, 1e-6); }),
             "a box of tree {} at depth {} is in none at depth {}", row.tree, row.depth, row.depth - 1);
  }
}

/// How far apart two shapes are along an axis; below 0: how far they overlap.
double separation_along(const Vec& axis, const referee::Shape& a, const referee::Pose& pose_a, const referee::Shape& b,
                        const referee::Pose& pose_b) {
  const Vec end_a = pose_a * a.support(pose_a.rotation.transpose() * axis);
  const Vec end_b = pose_b * b.support(-(pose_b.rotation.transpose() * axis));
  return axis.dot(end_b - end_a);
}

/// Axes are those along which the referee finds the same overlap or gap; those who touch have one, of least overlap.
void axes(Conformance& c) {
  Couples scene(c);
  const auto rows = shown(scene.probe.world(), &IDebug::separating_axes, "axes");
  std::map<PlumbBody, std::size_t> couple_of;
  for (std::size_t i = 0; i < scene.couples.size(); ++i)
    couple_of[scene.couples[i].a.body] = couple_of[scene.couples[i].b.body] = i;
  std::set<std::size_t> told;
  for (const PlumbDebugAxis& row : rows) {
    const bool known = couple_of.contains(row.body_a) && couple_of.contains(row.body_b) &&
                       couple_of[row.body_a] == couple_of[row.body_b] && row.body_a != row.body_b;
    c.expect(known, "an axis is told of bodies {} and {}, which are far apart", slot_of(row.body_a),
             slot_of(row.body_b));
    if (!known) continue;
    const std::size_t i = couple_of[row.body_a];
    const Couples::Couple& couple = scene.couples[i];
    const bool in_order = couple.a.body == row.body_a;
    const Item &a = in_order ? couple.a : couple.b, &b = in_order ? couple.b : couple.a;
    c.expect(std::abs(vec(row.axis).norm() - 1) < 1e-3, "the axis of couple {} is {:.4f} long", i,
             vec(row.axis).norm());
    const double along = separation_along(vec(row.axis), *a.shape, scene.pose(a.body), *b.shape, scene.pose(b.body));
    c.expect(std::abs(along - row.separation) < kSlack,
             "couple {} is told to be {:.4f} m apart along an axis along "
             "which it is {:.4f}",
             i, row.separation, along);
    c.expect(row.separation > -Couples::kOverlap - kSlack, "couple {} overlaps by {} m along another axis than {:.4f}",
             i, Couples::kOverlap, -row.separation);
    told.insert(i);
  }
  for (std::size_t i = 0; i < scene.couples.size(); ++i)
    c.expect(!scene.couples[i].touches || told.contains(i), "couple {} touches, and no axis is told of it", i);
}

/// Two piles, a lone cube, and two cubes in the air with a joint between them where the backend has joints.
struct Piles {
  Probe probe;
  std::vector<std::vector<PlumbBody>> islands;
  PlumbJoint joint = 0;
  PlumbBody floor = 0;

  Piles(Conformance& c, PlumbNeeds more) : probe(c, kPlainNeeds | more) {
    floor = probe.ground();
    const PlumbShape cube = probe.box({0.5, 0.5, 0.5});
    islands.resize(3);
    for (int k = 0; k < 3; ++k) islands[0].push_back(probe.dynamic(cube, {0, 0.5 + k, 0}));
    for (int k = 0; k < 4; ++k) islands[1].push_back(probe.dynamic(cube, {10 + 0.2 * k, 0.5 + k, 0}));
    islands[2].push_back(probe.dynamic(cube, {20, 0.5, 0}));
    if ((more & PLUMB_NEED_JOINTS) == 0 || c.backend().capability(PLUMB_CAP_JOINT, PLUMB_JOINT_BALL) == PLUMB_NONE)
      return;
    islands.push_back({probe.dynamic(cube, {30, 0.5, 0}), probe.dynamic(cube, {33, 0.5, 0})});
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
    desc.body_a = islands[3][0];
    desc.body_b = islands[3][1];
    desc.frame_a.position = {1.5, 0, 0};
    desc.frame_b.position = {-1.5, 0, 0};
    joint = probe.joint(desc);
  }
};

/// Every body is told once: in an island with whom it is bound to and with nobody else, and asleep where it is.
void bodies(Conformance& c) {
  const PlumbNeeds more = c.available(PLUMB_NEED_JOINTS | PLUMB_NEED_SLEEPING);
  Piles scene(c, more);
  const auto look = [&](bool expect_islands) {
    const auto rows = shown(scene.probe.world(), &IDebug::body_states, "islands");
    const auto living = scene.probe.world().bodies();
    std::map<PlumbBody, PlumbDebugBody> by_body;
    for (const PlumbDebugBody& row : rows) by_body[row.body] = row;
    c.expect(rows.size() == living.size() && by_body.size() == living.size(), "{} rows of {} bodies, where {} live",
             rows.size(), by_body.size(), living.size());
    int sleepers = 0;
    for (const PlumbBody body : std::vector<PlumbBody>(living.begin(), living.end())) {
      const bool asleep = body != scene.floor && scene.probe.read(PLUMB_FIELD_AWAKE, body)[0] == 0;
      c.expect(by_body.contains(body), "body {} is not told", slot_of(body));
      c.expect(by_body[body].asleep == (asleep ? 1U : 0U), "body {} is told asleep: {}, and its field says awake: {}",
               slot_of(body), by_body[body].asleep, asleep ? 0 : 1);
      sleepers += asleep;
    }
    c.expect(by_body[scene.floor].island == -1, "a static body is of island {}", by_body[scene.floor].island);
    std::set<std::int32_t> told;
    for (const auto& island : scene.islands) {
      const std::int32_t first = by_body[island.front()].island;
      if (expect_islands)
        c.expect(first >= 0 && told.insert(first).second, "an island of {} has the number {}", island.size(), first);
      for (const PlumbBody body : island)
        c.expect(!expect_islands || by_body[body].island == first, "who is bound to island {} is told in {}", first,
                 by_body[body].island);
    }
    return sleepers;
  };
  scene.probe.step(10);
  (void)look(true);
  if ((more & PLUMB_NEED_SLEEPING) == 0) return;
  int sleepers = 0;
  for (int second = 0; second < 15 && sleepers == 0; ++second) {
    scene.probe.step(60);
    sleepers = look(false);
  }
  c.expect(sleepers != 0, "nobody of three piles at rest is told asleep in 15 s");
}

/// Who touches or is joined is told, and no two of a colour push the same body.
void constraints(Conformance& c) {
  const PlumbNeeds more = c.available(PLUMB_NEED_JOINTS);
  Piles scene(c, more | PLUMB_NEED_CONTACTS);
  scene.probe.step(10);
  const auto rows = shown(scene.probe.world(), &IDebug::solved_constraints, "constraints");
  std::set<std::pair<PlumbBody, PlumbBody>> contacts;
  std::set<std::pair<std::int32_t, PlumbBody>> pushed;
  bool joined = scene.joint == 0;
  for (const PlumbDebugConstraint& row : rows) {
    joined = joined || row.joint == scene.joint;
    if (row.joint == 0) contacts.insert(std::minmax(row.body_a, row.body_b));
    c.expect(row.colour >= -1, "a colour is {}", row.colour);
    if (row.colour < 0) continue;
    for (const PlumbBody body : {row.body_a, row.body_b})
      if (body != 0 && body != scene.floor)
        c.expect(pushed.emplace(row.colour, body).second, "two constraints of colour {} push body {}", row.colour,
                 slot_of(body));
  }
  c.expect(joined, "the joint is not told");
  for (const PlumbContact& contact : scene.probe.contacts())
    c.expect(contacts.contains(std::minmax(contact.body_a, contact.body_b)),
             "bodies {} and {} have contacts, and no constraint is told of them", slot_of(contact.body_a),
             slot_of(contact.body_b));
}

/// A world through the bare table, for what the C++ face hides: arrays that are too short.
class BareWorld {
 public:
  explicit BareWorld(Conformance& c) : table_(c.backend().table()) {
    c.require_needs(PLUMB_NEED_COLLISION);
    const PlumbWorldDesc desc = world_desc(PLUMB_NEED_COLLISION | c.available(PLUMB_NEED_ROTATION));
    done(table_.create_world(&desc, &world_));
    PlumbShapeDesc sphere = shape_desc(PLUMB_SPHERE);
    sphere.radius = 0.5;
    PlumbBodyDesc body = body_desc();
    body.material.friction = 0;
    done(table_.create_shapes(world_, &sphere, sizeof sphere, 1, &body.shape));
    for (int i = 0; i < 4; ++i) {
      body.pose.position.x = 0.95 * i;
      PlumbBody id = 0;
      done(table_.create_bodies(world_, &body, sizeof body, 1, &id));
    }
    const PlumbStepDesc step = {sizeof step, 0, 1e-3};
    done(table_.step(world_, &step));
    done(table_.wait(world_, nullptr));
  }
  BareWorld(const BareWorld&) = delete;
  BareWorld& operator=(const BareWorld&) = delete;
  ~BareWorld() { table_.destroy_world(world_); }

  /// How many rows there are, where they can be shown at all, is told whatever the room for them.
  template <class Row>
  void count(Conformance& c, const char* name,
             PlumbResult (*look)(PlumbWorld*, Row*, std::uint32_t, std::uint32_t*)) const {
    std::uint32_t all = 0, told = 0;
    const PlumbResult result = look(world_, nullptr, 0, &all);
    if (result == PLUMB_E_UNSUPPORTED) return;
    c.expect(result == PLUMB_TRUNCATED && all > 0, "{} of spheres that touch: {} rows, result {}", name, all, result);
    std::vector<Row> rows(all + 1);
    const PlumbResult whole = look(world_, rows.data(), all + 1, &told);
    c.expect(whole == PLUMB_OK && told == all, "{}: {} rows in a long array, result {}", name, told, whole);
    const PlumbResult exact = look(world_, rows.data(), all, &told);
    c.expect(exact == PLUMB_OK && told == all, "{}: {} rows in an array that just fits, result {}", name, told, exact);
    const PlumbResult less = look(world_, rows.data(), all - 1, &told);
    c.expect(less == PLUMB_TRUNCATED && told == all, "{}: {} rows told of {}, of which {} fit, result {}", name, told,
             all, all - 1, less);
  }

 private:
  void done(PlumbResult result) const {
    if (result < 0) throw Error(result, table_.error_text(world_));
  }

  const PlumbBackendTable& table_;
  PlumbWorld* world_ = nullptr;
};

void counts(Conformance& c) {
  const auto* debug = static_cast<const PlumbDebugTable*>(c.backend().table().extension(PLUMB_EXT_DEBUG));
  if (debug == nullptr) throw Skipped{"no " PLUMB_EXT_DEBUG};
  const BareWorld world(c);
  world.count(c, "pairs", debug->pairs);
  world.count(c, "boxes", debug->boxes);
  world.count(c, "axes", debug->axes);
  if (has(*debug, &PlumbDebugTable::bodies)) world.count(c, "bodies", debug->bodies);
  if (has(*debug, &PlumbDebugTable::constraints)) world.count(c, "constraints", debug->constraints);
}

/// A world that is asked for all of it after each step goes the way of one that is not.
void silence(Conformance& c) {
  if (c.backend().info().determinism < PLUMB_DETERMINISM_RUN) throw Skipped{"no determinism is claimed"};
  const PlumbNeeds more = c.available(PLUMB_NEED_JOINTS | PLUMB_NEED_SLEEPING);
  Piles asked(c, more), left(c, more);
  if (asked.probe.world().debug() == nullptr) throw Skipped{"no " PLUMB_EXT_DEBUG};
  IDebug& debug = *asked.probe.world().debug();
  for (int step = 1; step <= 90; ++step) {
    asked.probe.step();
    left.probe.step();
    const auto ask = [&]<class Row>(PlumbResult (IDebug::*look)(std::span<const Row>&)) {
      std::span<const Row> rows;
      c.expect((debug.*look)(rows) != PLUMB_E_INTERNAL, "step {}: {}", step, asked.probe.world().error_text());
    };
    ask(&IDebug::candidate_pairs);
    ask(&IDebug::tree_boxes);
    ask(&IDebug::separating_axes);
    ask(&IDebug::body_states);
    ask(&IDebug::solved_constraints);
  }
  c.expect(asked.probe.hash() == left.probe.hash(),
           "after 90 steps a world that was asked differs from one that was not");
}

}  // namespace

std::span<const Check> debug_checks() {
  static constexpr Check checks[] = {
      {"debug.boxes", "boxes hold their bodies", &boxes},
      {"debug.trees", "inner boxes hold what is below them", &trees},
      {"debug.axes", "axes against the referee, one for each touch", &axes},
      {"debug.bodies", "islands are who is bound, sleepers who sleeps", &bodies},
      {"debug.constraints", "constraints of a colour share no body, and none is missing", &constraints},
      {"debug.silence", "asking changes nothing", &silence},
      {"debug.counts", "short arrays are filled, and told to be short", &counts},
  };
  return checks;
}

}  // namespace plumb::harness::conform
