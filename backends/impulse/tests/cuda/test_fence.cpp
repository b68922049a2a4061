// plumb.state/1 on the device: rows that the user's own stream reads behind the fence.
#include <cuda_runtime_api.h>
#include <gtest/gtest.h>

#include "exec/executor.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

TEST(Fence, LetsTheUsersStreamReadRowsOnTheDevice) {
  if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
  Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, {0, -9.81, 0}, 1);
  scene.container(4, 40);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 500; ++i) scene.add(cube, {1.3 * (i % 5) - 2.6, 1 + 1.1 * (i / 25), 1.3 * (i / 5 % 5) - 2.6});
  cudaStream_t mine = nullptr;
  ASSERT_EQ(cudaStreamCreateWithFlags(&mine, cudaStreamNonBlocking), cudaSuccess);
  for (int round = 0; round < 40; ++round) {
    scene.run(1);
    const PlumbStateRequest request = {sizeof request, PLUMB_FIELD_POSE, 2, 0};
    PlumbDLManagedTensor* lent = nullptr;
    PlumbFence fence = {};
    ASSERT_EQ(scene.world().state()->borrow(request, lent, &fence), PLUMB_OK);
    ASSERT_NE(fence.stream, nullptr);
    ASSERT_NE(fence.event, nullptr);
    const PlumbDLTensor& tensor = lent->dl_tensor;
    cudaPointerAttributes where{};
    ASSERT_EQ(cudaPointerGetAttributes(&where, tensor.data), cudaSuccess);
    EXPECT_EQ(where.type, cudaMemoryTypeDevice);
    EXPECT_EQ(where.device, tensor.device.device_id);
    std::vector<PlumbPose> rows(static_cast<std::size_t>(tensor.shape[0]));
    ASSERT_EQ(cudaStreamWaitEvent(mine, static_cast<cudaEvent_t>(fence.event), 0), cudaSuccess);
    ASSERT_EQ(cudaMemcpyAsync(rows.data(), tensor.data, rows.size() * sizeof(PlumbPose), cudaMemcpyDeviceToHost, mine),
              cudaSuccess);
    ASSERT_EQ(cudaStreamSynchronize(mine), cudaSuccess);
    lent->deleter(lent);
    const std::vector<PlumbPose> read = scene.poses();
    ASSERT_EQ(rows.size(), read.size());
    ASSERT_EQ(std::memcmp(rows.data(), read.data(), rows.size() * sizeof(PlumbPose)), 0) << "round " << round;
  }
  EXPECT_EQ(cudaStreamDestroy(mine), cudaSuccess);
}

}  // namespace
}  // namespace plumb::impulse::test
