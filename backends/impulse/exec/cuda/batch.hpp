// Steps of many worlds as one: what their executors record, each kernel launched once for all whose sequences are
// alike. Nothing is launched before somebody waits, by when all have said what they want.
#pragma once

#include <cuda_runtime_api.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "exec/cuda/launch_list.cuh"

namespace plumb::impulse {

class Batch {
 public:
  Batch();
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// On which all that its executors enqueue runs, in order.
  [[nodiscard]] cudaStream_t stream() const { return stream_; }

  /// Uploads, and then the list, when somebody waits. Both must stay as they are until then. Any thread.
  void add(const LaunchList& list, std::span<const Transfer> uploads);
  /// What was added is launched, and what is enqueued from here on comes after it.
  void launch();
  /// Something was enqueued on the stream past the batch.
  void enqueued();
  /// Returns when all is done.
  void wait();

 private:
  struct Group {
    std::uint64_t signature;
    std::vector<ListedLaunch> launches;
    std::vector<const std::byte*> blocks;
  };
  void launch_added();
  void launch_group(const Group& group, std::size_t first);

  cudaStream_t stream_ = nullptr;
  std::uint32_t multiprocessors_ = 1;
  std::mutex mutex_;
  std::vector<Group> groups_;  // of lists that are alike; those of former steps stay, empty
  std::vector<Transfer> uploads_;
  Mirror<const std::byte*> blocks_;
  Mirror<Transfer> transfers_;
  bool busy_ = false;                // since somebody waited something was enqueued
  std::atomic<bool> is_idle_{true};  // nothing was added or enqueued since: most who wait need not meet the others
};

}  // namespace plumb::impulse
