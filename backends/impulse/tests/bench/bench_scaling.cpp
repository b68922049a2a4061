// Whether a cost grows as its cause does: each of these is measured at four sizes, and what one item of it costs is
// held against what it costs at the smallest. A ratio of 1 is flat; the table at the end marks what is above 2, and the
// last line names it. With --strict it is exit status 1.
//
//   kinematic_targets   writing a target for each of n kinematic bodies, per body
//   step_after_destroy  the step after one joint of n, in chains of ten, was destroyed, per joint
//   read_one_pose       reading one body's pose among n, per read
//   read_all_poses      reading the poses of all n bodies after a step, per body
//   mixed_sizes         a step of n kinematic balls of radii over three decades, which is little but its broad phase,
//                       per ball
//
// usage: bench_scaling [BACKEND [KEY=CHOICE]...] [--strict] [--benchmark_...]
// BACKEND: a name or a file; by itself impulse
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "plumb/loader.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using plumb::check;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// splitmix64
class Dice {
 public:
  double unit() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
  }
  PlumbVec3 in_cube(double side) { return {side * unit(), side * unit(), side * unit()}; }

 private:
  std::uint64_t state_ = 1;
};

struct Engine {
  plumb::Backend backend;
  std::vector<std::pair<std::string, std::string>> choices;

  [[nodiscard]] bool has(PlumbNeeds needs) const {
    for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit)
      if ((needs >> bit & 1U) != 0 && backend.capability(PLUMB_CAP_NEED, bit) == PLUMB_NONE) return false;
    return true;
  }
};

/// A world without gravity and its bodies, in the order in which they were made.
class World {
 public:
  World(const Engine& engine, PlumbNeeds needs) {
    world_ = engine.backend.create_world(plumb::world_desc(needs));
    for (const auto& [name, choice] : engine.choices) {
      const PlumbSettingValue value = {PLUMB_SETTING_CHOICE, 0, 0, choice.c_str()};
      check(*world_, world_->settings()->set_setting(name.c_str(), value));
    }
  }
  plumb::IPhysicsWorld& operator*() { return *world_; }
  plumb::IPhysicsWorld* operator->() { return world_.get(); }

  PlumbShape ball(double radius) {
    PlumbShapeDesc desc = plumb::shape_desc(PLUMB_SPHERE);
    desc.radius = radius;
    PlumbShape shape = 0;
    check(*world_, world_->create_shapes({&desc, 1}, {&shape, 1}));
    return shape;
  }
  void add(const std::vector<PlumbBodyDesc>& descs) {
    bodies.resize(descs.size());
    check(*world_, world_->create_bodies(descs, bodies));
  }
  /// s
  double step() {
    PlumbStepReport report{};
    const auto start = Clock::now();
    check(*world_, world_->step(1e-3));
    check(*world_, world_->wait(report));
    return seconds_since(start);
  }

  std::vector<PlumbBody> bodies;

 private:
  std::unique_ptr<plumb::IPhysicsWorld> world_;
};

/// n balls of 0.1 m in rows, 1 m from each other.
std::vector<PlumbBodyDesc> balls(std::size_t n, PlumbShape shape, PlumbMotion motion) {
  std::vector<PlumbBodyDesc> descs(n, plumb::body_desc());
  for (std::size_t i = 0; i < n; ++i) {
    descs[i].motion = motion;
    descs[i].shape = shape;
    descs[i].density = 1000;
    descs[i].material.friction = 0;
    descs[i].pose.position = {static_cast<double>(i % 100), static_cast<double>(i / 100), 0};
  }
  return descs;
}

void kinematic_targets(benchmark::State& state, const Engine& engine) {
  const auto n = static_cast<std::size_t>(state.range(0));
  World world(engine, PLUMB_NEED_KINEMATIC);
  world.add(balls(n, world.ball(0.1), PLUMB_KINEMATIC));
  std::vector<PlumbPose> targets(n);
  check(*world, world->read(PLUMB_FIELD_POSE, {}, plumb::rows_over(std::span(targets))));
  for (auto _ : state) {
    const auto start = Clock::now();
    check(*world, world->write(PLUMB_FIELD_KINEMATIC_TARGET, world.bodies,
                               plumb::const_rows_over(std::span<const PlumbPose>(targets))));
    state.SetIterationTime(seconds_since(start));
    world.step();
  }
}

/// Bodies 1 m apart in chains of ten ball joints, whose first end hangs on the world.
class Chains {
 public:
  Chains(const Engine& engine, std::size_t n)
      : world(engine, PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS), joints(n), descs_(n) {
    world.add(balls(n, world.ball(0.1), PLUMB_DYNAMIC));
    for (std::size_t i = 0; i < n; ++i) {
      descs_[i] = plumb::joint_desc(PLUMB_JOINT_BALL);
      descs_[i].body_b = world.bodies[i];
      descs_[i].frame_b.position = {-0.5, 0, 0};
      if (i % 10 == 0)
        descs_[i].frame_a.position = {static_cast<double>(i % 100) - 0.5, static_cast<double>(i / 100), 0};
      else
        descs_[i].body_a = world.bodies[i - 1];
      if (i % 10 != 0) descs_[i].frame_a.position = {0.5, 0, 0};
    }
    check(*world, world->joints()->create_joints(descs_, joints));
  }
  void destroy(std::size_t i) { check(*world, world->joints()->destroy_joints({&joints[i], 1})); }
  void make_again(std::size_t i) { check(*world, world->joints()->create_joints({&descs_[i], 1}, {&joints[i], 1})); }

  World world;
  std::vector<PlumbJoint> joints;

 private:
  std::vector<PlumbJointDesc> descs_;
};

void step_after_destroy(benchmark::State& state, const Engine& engine) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Chains chains(engine, n);
  chains.world.step();
  double plain = 0;
  for (auto _ : state) {
    plain += chains.world.step();
    chains.destroy(n / 2);
    state.SetIterationTime(chains.world.step());
    chains.make_again(n / 2);
    chains.world.step();
  }
  state.counters["ms_of_other_steps"] = 1e3 * plain / static_cast<double>(state.iterations());
}

void read_one_pose(benchmark::State& state, const Engine& engine) {
  const auto n = static_cast<std::size_t>(state.range(0));
  World world(engine, PLUMB_NEED_ROTATION);
  world.add(balls(n, world.ball(0.1), PLUMB_DYNAMIC));
  world.step();
  PlumbPose pose{};
  std::size_t i = 0;
  for (auto _ : state) {  // a few, from all over them: what the machine's caches make of the others is not the point
    check(*world, world->read(PLUMB_FIELD_POSE, {&world.bodies[i], 1}, plumb::rows_over(std::span(&pose, 1))));
    benchmark::DoNotOptimize(pose);
    i = (i + n / 64) % n;
  }
}

void read_all_poses(benchmark::State& state, const Engine& engine) {
  const auto n = static_cast<std::size_t>(state.range(0));
  World world(engine, PLUMB_NEED_ROTATION);
  world.add(balls(n, world.ball(0.1), PLUMB_DYNAMIC));
  std::vector<PlumbPose> poses(n);
  const auto read = [&] { check(*world, world->read(PLUMB_FIELD_POSE, {}, plumb::rows_over(std::span(poses)))); };
  for (int warm = 0; warm < 3; ++warm) {
    world.step();
    read();
  }
  for (auto _ : state) {
    world.step();
    const auto start = Clock::now();
    read();
    state.SetIterationTime(seconds_since(start));
  }
}

/// Radii from 1 cm to 10 m, most of them small, in a cube with 64 m3 for each.
void mixed_sizes(benchmark::State& state, const Engine& engine) {
  const auto n = static_cast<std::size_t>(state.range(0));
  World world(engine, PLUMB_NEED_COLLISION | PLUMB_NEED_KINEMATIC);
  std::vector<PlumbShape> shapes;
  for (int k = 0; k < 64; ++k) shapes.push_back(world.ball(0.01 * std::pow(1000, std::pow(k / 63.0, 4))));
  std::vector<PlumbBodyDesc> descs(n, plumb::body_desc());
  Dice dice;
  const double side = std::cbrt(64.0 * static_cast<double>(n));
  for (PlumbBodyDesc& desc : descs) {
    desc.motion = PLUMB_KINEMATIC;
    desc.material.friction = 0;
    desc.shape = shapes[static_cast<std::size_t>(64 * dice.unit())];
    desc.pose.position = dice.in_cube(side);
  }
  world.add(descs);
  world.step();
  for (auto _ : state) state.SetIterationTime(world.step());
}

struct Family {
  const char* name;
  void (*run)(benchmark::State&, const Engine&);
  PlumbNeeds needs;
  std::vector<std::int64_t> sizes;
  bool per_call;     ///< an item is a call, not one of n
  bool manual_time;  ///< only part of an iteration counts
};
const Family kFamilies[] = {
    {"kinematic_targets", &kinematic_targets, PLUMB_NEED_KINEMATIC, {4000, 8000, 16000, 32000}, false, true},
    {"step_after_destroy",
     &step_after_destroy,
     PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS,
     {500, 2000, 4000, 16000},
     false,
     true},
    {"read_one_pose", &read_one_pose, PLUMB_NEED_ROTATION, {1000, 4000, 16000, 64000}, true, false},
    {"read_all_poses", &read_all_poses, PLUMB_NEED_ROTATION, {8000, 64000, 256000, 901120}, false, true},
    {"mixed_sizes",
     &mixed_sizes,
     PLUMB_NEED_COLLISION | PLUMB_NEED_KINEMATIC,
     {1 << 11, 1 << 13, 1 << 15, 1 << 17},
     false,
     true}};

/// The console's table, and after it the cost of an item at each size.
class Costs : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      const double seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
      for (const Family& family : kFamilies)
        for (const std::int64_t size : family.sizes)
          if (run.run_name.function_name == family.name && run.run_name.args == "n:" + std::to_string(size))
            costs_[&family].push_back(1e9 * seconds / (family.per_call ? 1.0 : static_cast<double>(size)));
    }
  }
  void Finalize() override {
    std::printf("\ncost of an item, ns                                                    last / first\n");
    for (const auto& [family, costs] : costs_) {
      std::printf("%-20s", family->name);
      for (const double cost : costs) std::printf(" %11.1f", cost);
      const bool steep = growth(costs) > kFlat;
      std::printf("  %6.2f%s\n", growth(costs), steep ? "  above 2" : "");
      if (steep) steep_ += std::string(" ") + family->name;
    }
    const bool compares =
        std::any_of(costs_.begin(), costs_.end(), [](const auto& entry) { return entry.second.size() > 1; });
    if (!is_flat())
      std::printf("not within 2x of flat:%s\n", steep_.c_str());
    else
      std::printf(compares ? "all are within 2x of flat\n" : "nothing was measured at two sizes\n");
  }
  [[nodiscard]] bool is_flat() const { return steep_.empty(); }

 private:
  static constexpr double kFlat = 2;
  static double growth(const std::vector<double>& costs) { return costs.back() / costs.front(); }

  std::string steep_;  // names of those that are not flat
  std::map<const Family*, std::vector<double>> costs_;
};

/// Whether the word is among the arguments, of which it is none any more.
bool take(const char* word, int& argc, char** argv) {
  char** const end =
      std::remove_if(argv + 1, argv + argc, [&](const char* argument) { return std::strcmp(argument, word) == 0; });
  const bool found = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const bool strict = take("--strict", argc, argv);
  try {
    Engine engine{plumb::open_backend(argc > 1 ? argv[1] : IMPULSE_LIBRARY), {}};
    for (int i = 2; i < argc; ++i) {
      const char* equals = std::strchr(argv[i], '=');
      if (equals == nullptr) {
        std::fprintf(stderr, "bench_scaling: \"%s\" is no KEY=CHOICE\n", argv[i]);
        return 2;
      }
      engine.choices.emplace_back(std::string(static_cast<const char*>(argv[i]), equals), equals + 1);
    }
    for (const Family& family : kFamilies) {
      if (!engine.has(family.needs)) {
        std::printf("%s is left out: %s lacks what it needs\n", family.name, engine.backend.info().name);
        continue;
      }
      auto* registered = benchmark::RegisterBenchmark(
          family.name, [&family, &engine](benchmark::State& state) { family.run(state, engine); });
      registered->ArgName("n")->Unit(benchmark::kMicrosecond);
      for (const std::int64_t size : family.sizes) registered->Arg(size);
      if (family.manual_time) registered->UseManualTime();
    }
    Costs costs;
    benchmark::RunSpecifiedBenchmarks(&costs);
    return strict && !costs.is_flat() ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_scaling: %s\n", error.what());
    return 1;
  }
}
