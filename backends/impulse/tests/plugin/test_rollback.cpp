// Snapshots of a whole world: a game in which bodies and joints come, go and become others is taken back, and played
// again to the same bits, in the same world and in another.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <map>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kLeast = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SNAPSHOT;
constexpr PlumbNeeds kMost = kLeast | PLUMB_NEED_JOINTS | PLUMB_NEED_SLEEPING | PLUMB_NEED_CCD | PLUMB_NEED_EVENTS |
                             PLUMB_NEED_SENSORS | PLUMB_NEED_FORCES | PLUMB_NEED_KINEMATIC | PLUMB_NEED_FILTERS |
                             PLUMB_NEED_RESTITUTION | PLUMB_NEED_DAMPING | PLUMB_NEED_SURFACE_VELOCITY |
                             PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_CONTACTS;

/// What a host does with a world each step, drawn from the step's number and from what it holds: its own state is
/// copied where the world is saved.
class Game {
 public:
  struct Held {
    std::vector<PlumbBody> bodies;
    std::map<PlumbJoint, std::pair<PlumbBody, PlumbBody>> joints;
    std::uint64_t seed = 0;
    int step = 0;
  };
  struct Saved {
    Held held;
    std::vector<std::byte> world;
  };
  struct Kind {
    const char* name;
    PlumbNeeds needs;
    double dt;         ///< s
    bool even = true;  ///< steps are all of one length
  };

  explicit Game(const Kind& kind, std::uint64_t seed = 0) : kind_(kind), scene_(engine(), kind.needs, kDown, 1) {
    held_.seed = seed;
    scene_.container(3, 30);
    shapes_ = {scene_.box({0.4, 0.3, 0.5}), scene_.sphere(0.35), scene_.capsule(0.2, 0.4),
               scene_.hull({{-0.4, -0.3, -0.3}, {0.5, -0.3, -0.2}, {0, -0.3, 0.5}, {0, 0.5, 0}})};
    PlumbCompoundChild parts[3]{};
    for (int i = 0; i < 3; ++i) parts[i] = {shapes_[i % 2], identity_pose(), 0, 0, {}};
    parts[0].pose.position = {-0.5, 0, 0};
    parts[2].pose.position = {0.5, 0.2, 0};
    PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
    compound.children = parts;
    compound.child_count = 3;
    shapes_.push_back(scene_.make(compound));
    const double corners[] = {-1, 0, -1, 1, 0.4, -1, 0, 0.2, 1};
    const std::uint32_t triangle[] = {0, 2, 1};
    PlumbShapeDesc mesh = shape_desc(PLUMB_TRIANGLE_MESH);
    mesh.vertices = corners;
    mesh.vertex_count = 3;
    mesh.indices = triangle;
    mesh.triangle_count = 1;
    ramp_ = scene_.make(mesh);
  }

  /// A step, and the state after it.
  std::uint64_t play() {
    Random random(held_.seed + 77 * static_cast<std::uint64_t>(held_.step) + 1);
    meddle(random);
    PlumbStepReport report{};
    check(world(), world().step(kind_.even || held_.step % 3 != 0 ? kind_.dt : 0.6 * kind_.dt));
    check(world(), world().wait(report));
    ++held_.step;
    for (const PlumbEvent& event : needs(PLUMB_NEED_EVENTS) ? world().events() : std::span<const PlumbEvent>())
      if (event.type == PLUMB_EVENT_JOINT_BROKEN) held_.joints.erase(event.joint);
    return scene_.hash();
  }
  std::vector<std::uint64_t> play(int steps) {
    std::vector<std::uint64_t> states;
    for (int i = 0; i < steps; ++i) states.push_back(play());
    return states;
  }
  [[nodiscard]] Saved save() {
    std::span<const std::byte> bytes;
    check(world(), world().snapshot()->save_world(bytes));
    return {held_, {bytes.begin(), bytes.end()}};
  }
  void restore(const Saved& saved) {
    check(world(), world().snapshot()->restore(saved.world));
    held_ = saved.held;
  }
  [[nodiscard]] IPhysicsWorld& world() { return scene_.world(); }
  [[nodiscard]] const Held& held() const { return held_; }
  [[nodiscard]] Scene& scene() { return scene_; }

 private:
  [[nodiscard]] bool needs(PlumbNeeds bits) const { return (kind_.needs & bits) == bits; }
  template <class Handle>
  static Handle any(Random& random, const std::vector<Handle>& handles) {
    return handles[static_cast<std::size_t>(random.next() % handles.size())];
  }
  PlumbJoint any_joint(Random& random) const {
    return std::next(held_.joints.begin(), static_cast<std::ptrdiff_t>(random.next() % held_.joints.size()))->first;
  }
  [[nodiscard]] bool moves(PlumbBody body) {
    std::array<double, 11> mass{};
    check(world(), world().read(PLUMB_FIELD_MASS, {&body, 1}, rows_over(std::span(&mass, 1))));
    return mass[0] > 0;
  }

  void meddle(Random& random) {
    const auto chance = [&random](double p) { return random.uniform() < p; };
    if (held_.bodies.size() < 45) come(random);
    if (held_.bodies.size() > 6 && chance(0.5)) go(any(random, held_.bodies));
    if (held_.bodies.size() > 6 && chance(0.1)) become_another(random, any(random, held_.bodies));
    if (needs(PLUMB_NEED_JOINTS) && held_.bodies.size() > 6) {
      if (chance(0.25)) join(random);
      if (!held_.joints.empty() && chance(0.05)) part(any_joint(random));
      if (!held_.joints.empty() && chance(0.1)) change(random, any_joint(random));
    }
    if (held_.bodies.size() < 2) return;
    const PlumbBody one = any(random, held_.bodies), other = any(random, held_.bodies);
    if (chance(0.1)) scene_.write(PLUMB_FIELD_MATERIAL, one, {random.uniform(), 0});
    if (moves(one) && chance(0.1)) scene_.write(PLUMB_FIELD_GRAVITY_SCALE, one, {random.uniform()});
    if (moves(one) && chance(0.1)) scene_.write(PLUMB_FIELD_VELOCITY, one, {random.between(-3, 3), 4, 0, 0, 5, 0});
    if (needs(PLUMB_NEED_FILTERS) && chance(0.05)) scene_.write(PLUMB_FIELD_FILTER, one, {3, 0xfffffffe, 0});
    if (needs(PLUMB_NEED_ROLLING_FRICTION) && chance(0.2))
      scene_.write(PLUMB_FIELD_ROLLING_FRICTION, one, {0.2 * random.uniform(), 0.1 * random.uniform()});
    if (needs(PLUMB_NEED_FORCES) && moves(one) && chance(0.2)) scene_.write(PLUMB_FIELD_FORCE, one, {0, 9000, 500});
    if (one != other && chance(0.1)) {
      const PlumbBodyPair pair{one, other};
      check(world(), world().exceptions()->set_exceptions({&pair, 1}, chance(0.5)));
    }
  }

  void come(Random& random) {
    PlumbBodyDesc desc = body_desc(PLUMB_DYNAMIC);
    desc.shape = any(random, shapes_);
    desc.pose.position = {random.between(-2, 2), random.between(3, 8), random.between(-2, 2)};
    desc.pose.orientation = random.turn();
    desc.density = random.between(200, 900);
    desc.material.friction = 0.25 * static_cast<double>(random.next() % 4);
    if (needs(PLUMB_NEED_ROLLING_FRICTION)) desc.rolling_friction = 0.1 * random.uniform();
    desc.user_data = random.next();
    const double what = random.uniform();
    if (what < 0.06) {
      desc.motion = PLUMB_STATIC;
      desc.shape = ramp_;
    } else if (what < 0.1 && needs(PLUMB_NEED_KINEMATIC)) {
      desc.motion = PLUMB_KINEMATIC;
      desc.angular_velocity = {0, 1, 0};
    } else if (what < 0.15 && needs(PLUMB_NEED_CCD)) {
      desc.flags |= PLUMB_BODY_CCD;
      desc.linear_velocity = {0, -60, 0};
    } else if (what < 0.2 && needs(PLUMB_NEED_SENSORS)) {
      desc.motion = PLUMB_STATIC;
      desc.flags |= PLUMB_BODY_SENSOR;
    }
    PlumbBody id = 0;
    check(world(), world().create_bodies({&desc, 1}, {&id, 1}));
    held_.bodies.push_back(id);
  }

  void go(PlumbBody body) {
    for (const auto& [joint, ends] : std::map(held_.joints))
      if (ends.first == body || ends.second == body) part(joint);
    scene_.remove(body);
    std::erase(held_.bodies, body);
  }

  void become_another(Random& random, PlumbBody body) {
    if (!moves(body)) return;
    PlumbBodyChange change{};
    change.body = body;
    change.what = PLUMB_MODIFY_SHAPE | PLUMB_MODIFY_MASS;
    change.shape = any(random, shapes_);
    change.mass_mode = PLUMB_MASS_FROM_DENSITY;
    change.density = random.between(200, 900);
    scene_.modify(change);
  }

  void join(Random& random) {
    const PlumbBody a = any(random, held_.bodies), b = any(random, held_.bodies);
    if (a == b || !moves(b)) return;
    PlumbJointDesc desc = joint_desc(random.uniform() < 0.5 ? PLUMB_JOINT_BALL : PLUMB_JOINT_HINGE);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a.position = {0, 0.8, 0};
    desc.frame_b.position = {0, -0.8, 0};
    if (desc.type == PLUMB_JOINT_HINGE) desc.motors[3] = {2, 50, 1, 0};
    if (needs(PLUMB_NEED_EVENTS) && random.uniform() < 0.5) desc.break_force = 3e4;
    PlumbJoint id = 0;
    check(world(), world().joints()->create_joints({&desc, 1}, {&id, 1}));
    held_.joints[id] = {a, b};
  }
  void part(PlumbJoint joint) {
    check(world(), world().joints()->destroy_joints({&joint, 1}));
    held_.joints.erase(joint);
  }
  void change(Random& random, PlumbJoint joint) {
    PlumbJointChange change{};
    change.joint = joint;
    change.what = PLUMB_MODIFY_ENABLED;
    change.enabled = random.uniform() < 0.5 ? 0 : 1;
    scene_.modify(change);
    const std::array<double, 12> motors = {0, 0, 0, 0, 0, 0, random.between(-3, 3), 40, 0, 0, 0, 0};
    // Which a ball joint has not.
    (void)world().joints()->write_joints(PLUMB_JOINT_MOTOR, {&joint, 1}, const_rows_over(std::span(&motors, 1)));
  }

  Kind kind_;
  Scene scene_;
  std::vector<PlumbShape> shapes_;
  PlumbShape ramp_ = 0;
  Held held_;
};

void PrintTo(const Game::Kind& kind, std::ostream* out) { *out << kind.name; }

struct Rollback : ::testing::TestWithParam<Game::Kind> {};

TEST_P(Rollback, APlayedGameIsPlayedAgain) {
  Game game(GetParam());
  for (const int begin : {0, 25}) {
    game.play(begin);
    const Game::Saved saved = game.save();
    const std::vector<std::uint64_t> first = game.play(40);
    const std::vector<PlumbBody> alive = game.held().bodies;
    game.restore(saved);
    EXPECT_EQ(game.play(40), first) << "from " << begin;
    EXPECT_EQ(game.held().bodies, alive) << "other handles";
  }
}

/// The other one has had a life of its own, in which more bodies lived and others died.
TEST_P(Rollback, AGameIsPlayedOnInAnotherWorld) {
  Game game(GetParam());
  game.play(60);
  const Game::Saved saved = game.save();
  const std::vector<std::uint64_t> first = game.play(40);
  Game fresh(GetParam()), other(GetParam(), 4711);
  other.play(70);
  for (Game* another : {&fresh, &other}) {
    another->restore(saved);
    EXPECT_EQ(another->play(40), first);
  }
}

/// As a game does it that plays over a network: each frame the last eight anew.
TEST_P(Rollback, EightFramesAreTakenBackEachFrame) {
  Game straight(GetParam()), game(GetParam());
  std::deque<Game::Saved> last;
  for (int frame = 0; frame < 40; ++frame) {
    last.push_back(game.save());
    const std::uint64_t state = game.play();
    ASSERT_EQ(state, straight.play()) << "frame " << frame;
    if (last.size() < 8) continue;
    game.restore(last.front());
    last.pop_front();
    game.play(7);
    ASSERT_EQ(game.play(), state) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Rollback,
    ::testing::Values(Game::Kind{"LeastNeeds", kLeast, 1.0 / 60}, Game::Kind{"MostNeeds", kMost, 1.0 / 60},
                      Game::Kind{"LongSteps", kMost, 1.0 / 30}, Game::Kind{"UnevenSteps", kMost, 1.0 / 60, false},
                      Game::Kind{"RollingFriction", kMost | PLUMB_NEED_ROLLING_FRICTION, 1.0 / 60}),
    [](const auto& kind) { return std::string(kind.param.name); });

/// Shapes are the host's to keep.
TEST(Rollback, NeedsTheShapesThatTheBodiesHad) {
  const Game::Kind kind{"", kLeast, 1.0 / 60};
  Game game(kind);
  const PlumbShape ball = game.scene().sphere(0.2);
  const PlumbBody body = game.scene().add(ball, {0, 5, 0});
  const Game::Saved saved = game.save();
  game.play(10);
  game.scene().remove(body);
  check(game.world(), game.world().destroy_shapes({&ball, 1}));
  const std::uint64_t before = game.scene().hash();
  EXPECT_EQ(game.world().snapshot()->restore(saved.world), PLUMB_E_CORRUPT);
  EXPECT_NE(game.world().error_text().find("shape"), std::string::npos) << game.world().error_text();
  EXPECT_EQ(game.scene().hash(), before);
  (void)game.scene().sphere(0.3);  // in its slot, and of another size
  EXPECT_EQ(game.world().snapshot()->restore(saved.world), PLUMB_E_CORRUPT);
  EXPECT_EQ(game.scene().hash(), before);
}

}  // namespace
}  // namespace plumb::impulse::test
