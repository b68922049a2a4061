// What batches of queries work in, handed from thread to thread: whoever asks keeps it until it asks again, because
// what it found lies there.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "exec/memory.hpp"
#include "plumb/collide.h"
#include "queries/pair_contacts.hpp"

namespace plumb::impulse {

template <class Batch>
class BatchPool {
 public:
  /// One that nobody keeps, kept from now on by this thread, which gives back the one that it had. One caller at a
  /// time; a thread keeps one batch of a kind in all worlds together.
  Batch& take() {
    thread_local std::shared_ptr<Batch> kept;
    kept = nullptr;
    for (const std::shared_ptr<Batch>& batch : all_)
      if (batch.use_count() == 1) {
        std::atomic_thread_fence(std::memory_order_acquire);  // after all that whoever gave it back did with it
        return *(kept = batch);
      }
    all_.push_back(std::make_shared<Batch>());
    return *(kept = all_.back());
  }

 private:
  std::vector<std::shared_ptr<Batch>> all_;
};

/// Pairs of posed shapes and the answers to them.
struct PairBatch {
  Mirror<PosedPair> pairs;
  Mirror<PairAnswer> answers;
  PieceTouches touches;
  std::vector<PlumbPairPoint> points;

  /// Room for n of each.
  void reserve(std::size_t n) {
    pairs.grow(n);
    answers.grow(n);
  }
};

}  // namespace plumb::impulse
