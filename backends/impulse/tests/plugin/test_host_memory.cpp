// Memory of the host: what a world is made of is there, and a step that was refused some is as if it had not been.
#include <gtest/gtest.h>

#include <atomic>
#include <new>

#include "plumb/backend/host_memory.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

struct CountingHost {
  PlumbHost host{};
  std::atomic<std::int64_t> bytes = 0, left = -1;  ///< left: allocations until none is given; below 0: all are

  CountingHost() {
    host.struct_size = sizeof host;
    host.user = this;
    host.allocate = [](void* user, std::size_t size, std::size_t) -> void* {
      auto& self = *static_cast<CountingHost*>(user);
      if (self.left == 0) return nullptr;
      if (self.left > 0) --self.left;
      auto* memory = static_cast<std::byte*>(::operator new (size + 256, std::align_val_t{256}));
      *reinterpret_cast<std::size_t*>(memory) = size;
      self.bytes += static_cast<std::int64_t>(size);
      return memory + 256;
    };
    host.release = [](void* user, void* memory) {
      std::byte* const begin = static_cast<std::byte*>(memory) - 256;
      static_cast<CountingHost*>(user)->bytes -= static_cast<std::int64_t>(*reinterpret_cast<std::size_t*>(begin));
      ::operator delete (begin, std::align_val_t{256});
    };
    backend::use_memory_of(&host);
  }
  ~CountingHost() { backend::use_memory_of(nullptr); }
  CountingHost(const CountingHost&) = delete;
  CountingHost& operator=(const CountingHost&) = delete;
};

constexpr PlumbNeeds kHeapNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;

/// Balls closer than they are wide: many pairs from the first step on, and more with each.
void heap(Scene& scene, int balls) {
  scene.ground();
  const PlumbShape ball = scene.sphere(0.5);
  for (int i = 0; i < balls; ++i)
    scene.add(ball, {0.8 * (i % 8) + 0.01 * (i % 3), 0.5 + 0.8 * (i / 64), 0.8 * (i / 8 % 8)});
}
PlumbResult try_step(Scene& scene) {
  PlumbStepReport report{};
  const PlumbResult begun = scene.world().step(1.0 / 60);
  return begun < 0 ? begun : scene.world().wait(report);
}

TEST(HostMemory, IsWhatAWorldIsMadeOf) {
  CountingHost host;
  {
    Scene scene(engine(), kHeapNeeds, kDown, 1);
    const std::int64_t empty = host.bytes;
    heap(scene, 2000);
    scene.run(3);
    EXPECT_GT(host.bytes - empty, 2000 * 500) << "bytes a body";
  }
  EXPECT_EQ(host.bytes, 0);
}

/// The first steps ask for more room over and over; each is refused at every one of its requests, and taken again.
TEST(HostMemory, RefusedStepsLeaveNoTrace) {
  CountingHost host;
  Scene spared(engine(), kHeapNeeds, kDown, 1), spoilt(engine(), kHeapNeeds, kDown, 1);
  heap(spared, 700);
  heap(spoilt, 700);
  int times = 0;
  for (int step = 0; step < 4; ++step) {
    for (std::int64_t next = 0;; ++next) {
      host.left = next;
      const PlumbResult result = try_step(spoilt);
      host.left = -1;
      if (result >= 0) break;
      ASSERT_EQ(result, PLUMB_E_OUT_OF_MEMORY) << spoilt.world().error_text();
      ++times;
      ASSERT_LT(next, 1000);
    }
    ASSERT_GE(try_step(spared), 0);
    EXPECT_EQ(spoilt.hash(), spared.hash()) << "step " << step;
  }
  EXPECT_GT(times, 5);
}

}  // namespace
}  // namespace plumb::impulse::test
