// Memory that the host lends: the guard's own part, what an opening refuses, and hosts of before.
#include <gtest/gtest.h>

#include <map>

#include "fake_world.hpp"
#include "plumb/backend/host_memory.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

struct Lender {
  PlumbHost host{};
  std::map<void*, std::size_t> held;  ///< and their alignments
  bool gives = true;

  Lender() {
    host.struct_size = sizeof host;
    host.user = this;
    host.allocate = [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
      auto& self = *static_cast<Lender*>(user);
      if (!self.gives) return nullptr;
      void* memory = ::operator new (bytes, std::align_val_t{alignment});
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % alignment, 0U);
      self.held[memory] = alignment;
      return memory;
    };
    host.release = [](void* user, void* memory) {
      auto& self = *static_cast<Lender*>(user);
      const auto block = self.held.find(memory);
      ASSERT_NE(block, self.held.end()) << "what was not lent is given back";
      ::operator delete (memory, std::align_val_t{block->second});
      self.held.erase(block);
    };
  }
};

/// No two tests of a process may lend to the same class: what was lent first is kept.
template <int>
class LentWorld final : public FakeWorld {
 public:
  using FakeWorld::FakeWorld;
};

class GuardMemory : public ::testing::Test {
 protected:
  ~GuardMemory() override { backend::use_memory_of(nullptr); }
};

TEST_F(GuardMemory, HandlesAndRecordsAreInTheHosts) {
  static Lender lender;
  const Backend backend(negotiate(&backend::open<LentWorld<0>>, "fake", &lender.host));
  {
    const auto world = backend.create_world(world_desc(PLUMB_NEED_FRICTION));
    PlumbShapeDesc ball = shape_desc(PLUMB_SPHERE);
    ball.radius = 1;
    PlumbShape shape = 0;
    check(*world, world->create_shapes({&ball, 1}, {&shape, 1}));
    std::vector<PlumbBodyDesc> descs(50, body_desc(PLUMB_STATIC));
    std::vector<PlumbBody> ids(50);
    check(*world, world->create_bodies(descs, ids));
    EXPECT_GT(lender.held.size(), 2U);

    lender.gives = false;
    EXPECT_EQ(world->create_bodies(descs, ids), PLUMB_E_OUT_OF_MEMORY);
    EXPECT_EQ(world->bodies().size(), 50U) << "nothing is half done";
    check(*world, world->destroy_bodies(std::span(ids).first(20)));  // which needs none
    EXPECT_EQ(world->bodies().size(), 30U);
    lender.gives = true;
    std::vector<PlumbBody> others(50);
    EXPECT_EQ(world->create_bodies(descs, others), PLUMB_OK) << world->error_text();
    EXPECT_EQ(world->bodies().size(), 80U);
  }
  EXPECT_TRUE(lender.held.empty()) << lender.held.size() << " blocks are kept";
}

TEST_F(GuardMemory, BothFunctionsOrNeither) {
  static Lender lender;
  lender.host.release = nullptr;
  const PlumbOpenRequest request = {sizeof request, PLUMB_VERSION, PLUMB_VERSION, 0, &lender.host};
  PlumbOpenReply reply{};
  reply.struct_size = sizeof reply;
  EXPECT_EQ(backend::open<LentWorld<1>>(&request, &reply), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_STREQ(reply.message, "the host lends only one of allocate and release; lend both, or leave both null");
  EXPECT_EQ(reply.table, nullptr);
}

/// The struct of 1.1 ended before; what is behind it is not looked at.
TEST_F(GuardMemory, OfAHostOfBeforeNoneIsTaken) {
  static Lender lender;
  lender.host.struct_size = offsetof(PlumbHost, allocate);
  const Backend backend(negotiate(&backend::open<LentWorld<2>>, "fake", &lender.host));
  const auto world = backend.create_world(world_desc(PLUMB_NEED_FRICTION));
  std::vector<PlumbBodyDesc> descs(50, body_desc(PLUMB_STATIC));
  std::vector<PlumbBody> ids(50);
  check(*world, world->create_bodies(descs, ids));
  EXPECT_TRUE(lender.held.empty());
}

TEST_F(GuardMemory, IsForContainersToo) {
  static Lender lender;
  backend::use_memory_of(&lender.host);
  {
    struct alignas(64) Wide {
      char bytes[64];
    };
    backend::HostVector<Wide> wide(3);
    EXPECT_EQ(lender.held.size(), 1U);
    EXPECT_EQ(lender.held.begin()->second, 64U);
    lender.gives = false;
    EXPECT_THROW(wide.resize(100), std::bad_alloc);
    EXPECT_EQ(wide.size(), 3U);
    EXPECT_THROW((void)backend::HostAllocator<Wide>().allocate(std::size_t(-1) / 2), std::bad_alloc);
  }
  EXPECT_TRUE(lender.held.empty());
  EXPECT_EQ(backend::take_memory(8, 8), nullptr);
}

TEST_F(GuardMemory, EveryBackendClaimsTheGuardsPart) {
  const backend::BackendFacts facts = [] {
    backend::BackendFacts none = backend::Tables<FakeWorld>::facts();
    none.capability = [](PlumbCapability, std::uint32_t, std::uint32_t, const char*& note) -> PlumbDegree {
      note = "";
      return PLUMB_NONE;
    };
    return none;
  }();
  const char* note = nullptr;
  EXPECT_EQ(backend::answer_capability(facts, PLUMB_CAP_HOST_MEMORY, 0, 0, &note), PLUMB_APPROXIMATE);
  EXPECT_NE(std::string(note).find("handles"), std::string::npos) << note;
  EXPECT_EQ(backend::answer_capability(backend::Tables<FakeWorld>::facts(), PLUMB_CAP_HOST_MEMORY, 0, 0, &note),
            PLUMB_NATIVE)
      << "as the class says";
}

}  // namespace
}  // namespace plumb::test
