// What it costs to make and destroy bodies while a large scene runs: the steps of a rain of boxes, of which some go
// and new ones come before every step, beside the same steps without. The worst step tells of stalls.
//
// usage: bench_impulse_come_and_go [BACKEND [BODIES [CHANGED [STEPS]]]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "plumb/loader.hpp"

namespace {

using Clock = std::chrono::steady_clock;

/// Of this process, MB.
double resident() {
  std::ifstream file("/proc/self/statm");
  long pages = 0, resident_pages = 0;
  file >> pages >> resident_pages;
  return static_cast<double>(resident_pages) * 4096e-6;
}

class Rain {
 public:
  Rain(const plumb::Backend& backend, std::uint32_t bodies) {
    PlumbWorldDesc desc = plumb::world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION);
    desc.gravity = {0, -9.81, 0};
    world_ = backend.create_world(desc);
    side_ = 1;
    while (side_ * side_ * 10 < bodies) ++side_;
    PlumbShapeDesc box = plumb::shape_desc(PLUMB_BOX);
    box.half_extents = {0.5, 0.5, 0.5};
    plumb::check(*world_, world_->create_shapes({&box, 1}, {&shape_, 1}));
    PlumbShapeDesc ground = box;
    ground.half_extents = {2.0 * side_, 0.5, 2.0 * side_};
    PlumbShape slab = 0;
    plumb::check(*world_, world_->create_shapes({&ground, 1}, {&slab, 1}));
    PlumbBodyDesc floor = plumb::body_desc();
    floor.motion = PLUMB_STATIC;
    floor.shape = slab;
    floor.pose.position = {0, -0.5, 0};
    PlumbBody id = 0;
    plumb::check(*world_, world_->create_bodies({&floor, 1}, {&id, 1}));
    add(bodies, 1.0, 0);
  }

  /// Over the columns in turn, layer on layer from this height, on the way down.
  void add(std::uint32_t count, double height, double speed) {
    std::vector<PlumbBodyDesc> descs(count, plumb::body_desc());
    std::vector<PlumbBody> ids(count);
    const std::uint32_t columns = side_ * side_, first = made_ / columns;
    for (PlumbBodyDesc& desc : descs) {
      const std::uint32_t column = made_ % columns, layer = made_ / columns - first;
      desc.shape = shape_;
      desc.density = 1000;
      desc.pose.position = {1.3 * (column % side_) - 0.65 * side_, height + 1.3 * layer,
                            1.3 * (column / side_) - 0.65 * side_};
      desc.linear_velocity = {0, -speed, 0};
      ++made_;
    }
    plumb::check(*world_, world_->create_bodies(descs, ids));
    alive_.insert(alive_.end(), ids.begin(), ids.end());
  }
  /// From all over the heap.
  void remove(std::uint32_t count) {
    std::vector<PlumbBody> going;
    for (std::uint32_t i = 0; i < count; ++i) {
      seed_ = seed_ * 6364136223846793005U + 1442695040888963407U;  // Knuth's MMIX generator
      std::swap(alive_[(seed_ >> 33) % alive_.size()], alive_.back());
      going.push_back(alive_.back());
      alive_.pop_back();
    }
    plumb::check(*world_, world_->destroy_bodies(going));
    gone_ = going.front();
  }
  /// Until the poses are here, s.
  void step() {
    PlumbStepReport report{};
    plumb::check(*world_, world_->step(1.0 / 60));
    plumb::check(*world_, world_->wait(report));
    poses_.resize(world_->bodies().size());
    plumb::check(*world_, world_->read(PLUMB_FIELD_POSE, {}, plumb::rows_over(std::span<PlumbPose>(poses_))));
    if (report.nonfinite != 0 || report.dropped != 0) throw std::runtime_error("bodies or contacts were lost");
  }
  /// Whether the handle of a body that is gone is refused.
  [[nodiscard]] bool stale_is_refused() {
    PlumbPose pose{};
    return world_->read(PLUMB_FIELD_POSE, {&gone_, 1}, plumb::rows_over(std::span<PlumbPose>(&pose, 1))) < 0;
  }

 private:
  std::unique_ptr<plumb::IPhysicsWorld> world_;
  PlumbShape shape_ = 0;
  std::uint32_t side_ = 1, made_ = 0;
  std::vector<PlumbBody> alive_;
  PlumbBody gone_ = 0;
  std::uint64_t seed_ = 1;
  std::vector<PlumbPose> poses_;
};

struct Steps {
  double median, worst;  ///< ms
};
template <class F>
Steps time_steps(int steps, const F& f) {
  std::vector<double> ms;
  for (int i = 0; i < steps; ++i) {
    const auto start = Clock::now();
    f();
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(ms.begin(), ms.end());
  return {ms[ms.size() / 2], ms.back()};
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, int standard) { return argc > i ? std::atoi(argv[i]) : standard; };
  const auto bodies = static_cast<std::uint32_t>(number(2, 8000)), changed = static_cast<std::uint32_t>(number(3, 250));
  const int steps = number(4, 200);
  try {
    const plumb::Backend backend = plumb::open_backend(argc > 1 ? argv[1] : IMPULSE_LIBRARY);
    Rain rain(backend, bodies);
    for (int i = 0; i < 60; ++i) rain.step();
    const Steps still = time_steps(100, [&] { rain.step(); });
    const auto change = [&] {
      rain.remove(changed);
      rain.add(changed, 40, 30);
      rain.step();
    };
    for (int i = 0; i < 60; ++i) change();
    const double before = resident();
    const Steps busy = time_steps(steps, change);
    double parts[3] = {0, 0, 0};  // gone, come, step; ms each
    for (int i = 0; i < 50; ++i) {
      const auto part = [&, last = Clock::now()](int which) mutable {
        parts[which] += std::chrono::duration<double, std::milli>(Clock::now() - last).count() / 50;
        last = Clock::now();
      };
      auto timer = part;
      rain.remove(changed);
      timer(0);
      rain.add(changed, 40, 30);
      timer(1);
      rain.step();
      timer(2);
    }
    std::printf(
        "%s, %u bodies: a step %.3f ms (worst %.3f); with %u gone and %u come %.3f ms (worst %.3f, %.1f times the "
        "median); memory grew by %.1f MB in %d steps; of a change going takes %.3f ms, coming %.3f, the step %.3f\n",
        backend.info().name, bodies, still.median, still.worst, changed, changed, busy.median, busy.worst,
        busy.worst / busy.median, resident() - before, steps, parts[0], parts[1], parts[2]);
    if (!rain.stale_is_refused()) {
      std::fprintf(stderr, "the handle of a body that is gone still works\n");
      return 1;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
