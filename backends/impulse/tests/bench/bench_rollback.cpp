// What rollback costs: a heap of boxes in which some go and new ones come before every step. Each frame the world is
// saved, and every so often eight frames are taken back and played again; both kinds of snapshot, bytes and ms.
//
// usage: bench_impulse_rollback [BACKEND [BODIES [CHANGED [FRAMES]]]]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <string>
#include <vector>

#include "plumb/loader.hpp"

namespace {

using plumb::check;
using Bytes = std::vector<std::byte>;

double seconds_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

class Heap {
 public:
  Heap(const plumb::Backend& backend, std::uint32_t bodies, std::uint32_t changed) : changed_(changed) {
    PlumbWorldDesc desc =
        plumb::world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SNAPSHOT);
    desc.gravity = {0, -9.81, 0};
    world_ = backend.create_world(desc);
    while (side_ * side_ * 10 < bodies) ++side_;
    box_ = shape({0.5, 0.5, 0.5});
    PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
    floor.shape = shape({1.0 * side_ + 10, 0.5, 1.0 * side_ + 10});
    floor.pose.position = {0.5 * side_, -0.5, 0.5 * side_};
    PlumbBody id = 0;
    check(*world_, world_->create_bodies({&floor, 1}, {&id, 1}));
    for (std::uint32_t i = 0; i < bodies; ++i) come(0.6 + 1.1 * (i / (side_ * side_)));
  }

  void play() {
    for (std::uint32_t i = 0; i < changed_; ++i) {
      check(*world_, world_->destroy_bodies({&bodies_.front(), 1}));
      bodies_.pop_front();
      come(12);
    }
    check(*world_, world_->step(1.0 / 60));
    PlumbStepReport report{};
    check(*world_, world_->wait(report));
  }
  Bytes save(bool whole) {
    plumb::ISnapshot& snapshot = *world_->snapshot();
    std::span<const std::byte> bytes;
    check(*world_, whole ? snapshot.save_world(bytes) : snapshot.save(bytes));
    return {bytes.begin(), bytes.end()};
  }
  void restore(const Bytes& saved, const std::deque<PlumbBody>& bodies) {
    check(*world_, world_->snapshot()->restore(saved));
    bodies_ = bodies;
  }
  [[nodiscard]] const std::deque<PlumbBody>& bodies() const { return bodies_; }

 private:
  PlumbShape shape(const PlumbVec3& half_extents) {
    PlumbShapeDesc desc = plumb::shape_desc(PLUMB_BOX);
    desc.half_extents = half_extents;
    PlumbShape id = 0;
    check(*world_, world_->create_shapes({&desc, 1}, {&id, 1}));
    return id;
  }
  void come(double height) {
    const std::uint32_t column = made_++ % (side_ * side_);
    PlumbBodyDesc desc = plumb::body_desc();
    desc.shape = box_;
    desc.pose.position = {1.02 * (column % side_), height, 1.02 * (column / side_)};
    PlumbBody id = 0;
    check(*world_, world_->create_bodies({&desc, 1}, {&id, 1}));
    bodies_.push_back(id);
  }

  std::unique_ptr<plumb::IPhysicsWorld> world_;
  std::uint32_t side_ = 1, changed_, made_ = 0;
  PlumbShape box_ = 0;
  std::deque<PlumbBody> bodies_;
};

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int at, std::uint32_t usual) {
    return argc > at ? static_cast<std::uint32_t>(std::strtoul(argv[at], nullptr, 10)) : usual;
  };
  const plumb::Backend backend = plumb::open_backend(argc > 1 ? argv[1] : IMPULSE_LIBRARY);
  const std::uint32_t bodies = number(2, 1000), frames = number(4, 120);
  for (const std::uint32_t changed : {number(3, 4), 0U}) {
    Heap heap(backend, bodies, changed);
    for (int i = 0; i < 60; ++i) heap.play();  // all lie
    double steps = 0, saves = 0, small_saves = 0, restores = 0, replays = 0;
    std::size_t bytes = 0, small_bytes = 0;
    std::uint32_t rollbacks = 0;
    std::deque<std::pair<Bytes, std::deque<PlumbBody>>> last;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      Bytes saved;
      saves += seconds_of([&] { saved = heap.save(true); });
      small_saves += seconds_of([&] { small_bytes = heap.save(false).size(); });
      bytes = saved.size();
      last.emplace_back(std::move(saved), heap.bodies());
      steps += seconds_of([&] { heap.play(); });
      if (last.size() < 8) continue;
      ++rollbacks;
      restores += seconds_of([&] { heap.restore(last.front().first, last.front().second); });
      replays += seconds_of([&] {
        for (int i = 0; i < 8; ++i) heap.play();
      });
      last.clear();
    }
    std::printf(
        "%u boxes, %u come and %u go a frame: a step %.3f ms; save_world %.3f ms, %.0f bytes a body; save %.3f "
        "ms, %.0f bytes a body; restore %.3f ms; eight frames taken back and played again %.2f ms\n",
        bodies, changed, changed, steps / frames * 1e3, saves / frames * 1e3, static_cast<double>(bytes) / bodies,
        small_saves / frames * 1e3, static_cast<double>(small_bytes) / bodies, restores / rollbacks * 1e3,
        (restores + replays) / rollbacks * 1e3);
  }
}
