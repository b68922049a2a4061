// broad_phase: each of its ways finds the same pairs in the same order, so that no bit of the state depends on it.
#include <gtest/gtest.h>

#include <memory>
#include <string_view>

#include "plugin/world.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

void choose(Scene& scene, const char* method) {
  const PlumbSettingValue value = {PLUMB_SETTING_CHOICE, 0, 0, method};
  check(scene.world(), scene.world().settings()->set_setting("broad_phase", value));
}

/// Balls, boxes and capsules of a centimetre to ten metres that rain on a plane, a mesh and boxes. Some go and others
/// come all the time; those that rest fall asleep; one is moved by the host.
void decades(Scene& scene) {
  scene.add_static(scene.make(shape_desc(PLUMB_PLANE)), {0, -3, 0});
  const double vertices[] = {-9, 0, -9, -9, 0, 9, 9, 0, -9, 9, 0, 9};
  const std::uint32_t indices[] = {0, 1, 2, 2, 1, 3};
  PlumbShapeDesc mesh = shape_desc(PLUMB_TRIANGLE_MESH);
  mesh.vertices = vertices;
  mesh.vertex_count = 4;
  mesh.indices = indices;
  mesh.triangle_count = 2;
  scene.add_static(scene.make(mesh), {0, 0, 0});
  for (int i = 0; i < 30; ++i) scene.add_static(scene.box({0.4, 0.2, 0.4}), {-8.0 + 0.5 * i, 0.2, 3});
  const PlumbBody lift = scene.add_kinematic(scene.box({1, 0.1, 1}), {0, 0.5, 0});
  const auto rain = std::make_shared<std::vector<PlumbBody>>();
  const auto drop = [rain](Scene& to, int i) {
    Random random(static_cast<std::uint64_t>(i));
    const double size = 0.005 * static_cast<double>(1 << i % 11);
    const PlumbShape shape = i % 3 == 0   ? to.sphere(size)
                             : i % 3 == 1 ? to.box({size, size / 2, size})
                                          : to.capsule(size / 2, size / 2);
    rain->push_back(to.add(shape, {random.between(-8, 8), random.between(0.5, 6) + 1.5 * size, random.between(-8, 8)},
                           random.turn()));
  };
  for (int i = 0; i < 350; ++i) drop(scene, i);
  scene.before_step = [rain, drop, lift](Scene& at, int step) {
    at.target(lift, {0, 0.5 + 0.02 * step, 0});
    for (int k = 0; step % 4 == 3 && k < 5; ++k) {
      const std::size_t goes = static_cast<std::size_t>(step * 31 + k * 17) % rain->size();
      at.remove((*rain)[goes]);
      rain->erase(rain->begin() + static_cast<std::ptrdiff_t>(goes));
      drop(at, 1000 + 5 * step + k);
    }
  };
}

struct BroadPhases : ::testing::TestWithParam<NamedScene> {};

bool is_offered(const char* method) {
  for (const PlumbSettingInfo* info : engine().settings())
    for (std::uint32_t i = 0; i < info->choice_count; ++i)
      if (std::string_view(info->name) == "broad_phase" && std::string_view(info->choices[i]) == method) return true;
  return false;
}

TEST_P(BroadPhases, GiveTheSameBits) {
  for (const char* method : {"sweep", "grid"})
    if (!is_offered(method)) GTEST_SKIP() << "this library does not offer " << method;
  constexpr int kSteps = 60;
  const auto tree = build(engine(), GetParam(), 1);
  tree->run(kSteps);
  const std::uint64_t hash = tree->hash();
  for (const char* method : {"sweep", "grid"}) {
    const auto scene = build(engine(), GetParam(), 3);
    choose(*scene, method);
    scene->run(kSteps);
    EXPECT_EQ(scene->hash(), hash) << method;
  }
  const auto in_turns = build(engine(), GetParam(), 1);
  for (int step = 0; step < kSteps; step += 5) {
    choose(*in_turns, step % 3 == 0 ? "grid" : step % 3 == 1 ? "sweep" : "lbvh");
    in_turns->run(5);
  }
  EXPECT_EQ(in_turns->hash(), hash) << "in turns";
}

/// 300 balls that touch their neighbours, in a world that is stepped.
class Balls {
 public:
  Balls() : world_(world_init()) {
    PlumbShapeDesc ball = shape_desc(PLUMB_SPHERE);
    ball.radius = 0.6;
    PlumbShape shape = 1;
    (void)world_.create_shapes({&ball, 1}, {&shape, 1});
    std::vector<PlumbBodyDesc> descs(300, body_desc());
    std::vector<PlumbBody> ids(descs.size());
    for (std::size_t i = 0; i < descs.size(); ++i) {
      descs[i].shape = shape;
      descs[i].mass_mode = PLUMB_MASS_EXPLICIT;
      descs[i].mass = 1;
      descs[i].inertia = {1, 1, 1};
      descs[i].pose.position = {static_cast<double>(i % 20), static_cast<double>(i / 20), 0};
      ids[i] = i;
    }
    (void)world_.create_bodies(descs, ids);
  }
  BroadPhase::Parts parts_after_steps_with(const char* method) {
    (void)world_.settings()->set_setting("broad_phase", {PLUMB_SETTING_CHOICE, 0, 0, method});
    for (int step = 0; step < 3; ++step) {
      PlumbStepReport report{};
      (void)world_.step(1.0 / 60);
      (void)world_.wait(report);
    }
    EXPECT_GT(world_.counters().pairs, 300U) << method;
    return world_.broad_phase().parts();
  }

 private:
  static WorldInit world_init() {
    static const std::vector<PlumbSettingInfo> infos(World::setting_infos().begin(), World::setting_infos().end());
    WorldInit init{world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION), nullptr, infos, {}};
    for (const PlumbSettingInfo& info : infos) init.values.push_back(info.default_value);
    return init;
  }

  World world_;
};

TEST(BroadPhaseSetting, OnlyWhatIsChosenHoldsMemory) {
  const std::pair<const char*, BroadPhase::Parts> methods[] = {
      {"lbvh", {.tree = true}}, {"sweep", {.sweep = true, .order = true}}, {"grid", {.grid = true, .order = true}}};
  Balls in_turns;
  for (const auto& [method, parts] : methods) {
    if (!is_offered(method)) continue;
    EXPECT_EQ(Balls().parts_after_steps_with(method), parts) << method;
    EXPECT_EQ(in_turns.parts_after_steps_with(method), parts) << method << ", after others";
  }
}

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> all = {{"decades",
                                  {},
                                  PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                      PLUMB_NEED_SLEEPING | PLUMB_NEED_KINEMATIC | PLUMB_NEED_EVENTS,
                                  {0, -9.81, 0},
                                  &decades}};
  for (const NamedScene& scene : named_scenes())
    if (std::string_view(scene.name) != "pile-1000") all.push_back(scene);  // that takes long
  return all;
}
INSTANTIATE_TEST_SUITE_P(Of, BroadPhases, ::testing::ValuesIn(scenes()), [](const auto& scene) {
  std::string name = scene.param.name;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace plumb::impulse::test
