// From candidate pairs to manifolds: collide, and keep what touches.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "exec/archive.hpp"
#include "exec/sort.hpp"
#include "narrowphase/narrow_phase_work.hpp"

namespace plumb::impulse {

class NarrowPhase {
 public:
  void reserve(Executor& executor, std::uint32_t proxies, std::uint32_t pairs);
  /// From now on candidates have parts (midphase.hpp), and counters->midphase_pairs is how many there are. Reserve
  /// after this.
  void use_midphase(bool uses) { uses_midphase_ = uses; }
  [[nodiscard]] std::uint32_t capacity() const { return capacity_; }

  /// This step's contacts and the last one's, for a step of the given parity.
  [[nodiscard]] ContactCache cache(std::uint32_t parity) { return caches_[parity % 2].view(); }

  /// These proxies found no pairs: they are statics now. What they found when they were not must not be looked at.
  void forget_found(Executor& executor, const std::uint32_t* statics, std::uint32_t n);

  /// What the next step remembers of a step, to or from a snapshot.
  void exchange(Archive& archive, std::uint32_t parity, std::uint32_t proxies, const StepCounters& counters);
  /// How many candidates a step has, pieces and all: where kernels run, and when it is done.
  [[nodiscard]] Count candidates(StepCounters* counters) const {
    return {uses_midphase_ ? &counters->midphase_pairs : &counters->pairs, capacity_};
  }
  [[nodiscard]] std::uint32_t candidate_count(const StepCounters& counters) const {
    return uses_midphase_ ? counters.midphase_pairs : counters.pairs;
  }
  /// Manifolds of a step, by row.
  [[nodiscard]] std::vector<KeptPair> kept(std::uint32_t parity, const StepCounters& counters) const;
  [[nodiscard]] std::vector<Pair> candidates(std::uint32_t parity, std::uint32_t count) const {
    return caches_[parity % 2].pairs.to_host(count);
  }

  /// Collides the candidates in work.cache, or recycles what the last step knew of them. shape_types: a bit for each
  /// ShapeType in the scene.
  void collide(Executor& executor, const NarrowPhaseWork& work, std::uint32_t shape_types, StepCounters* counters);
  /// Collides those of them once more that come near each other later in the step: what is found then stands for the
  /// pair. times: by candidate; of those that do not touch then the time becomes 0.
  void collide_again(Executor& executor, const NarrowPhaseWork& work, std::uint32_t shape_types, StepCounters* counters,
                     PairTime* times) {
    run_pairs(executor, work, shape_types, counters, times);
  }

  /// Numbers those that touch.
  void number(Executor& executor, const ContactCache& cache, StepCounters* counters);

 private:
  struct Storage {
    Buffer<Pair> pairs;
    Buffer<PairRange> ranges;
    Buffer<Manifold> found;
    Buffer<std::uint32_t> touching, row, previous;
    Buffer<CollidedRows::Line> collided;
    Buffer<std::uint32_t> candidate;
    Buffer<CachedManifold> kept;
    Buffer<std::uint32_t> triangles;
    Buffer<PointTriangles> point_triangles;
    ContactCache view() {
      return {pairs.data(), ranges.data(),    found.data(),          touching.data(),
              row.data(),   previous.data(),  {collided.data()},     candidate.data(),
              kept.data(),  triangles.data(), point_triangles.data()};
    }
  };

  /// Whether candidates are ordered by kind, so that a warp does one kind of work.
  [[nodiscard]] static bool bins(std::uint32_t shape_types) {
    return Executor::kWarps && (shape_types & (shape_types - 1)) != 0;
  }
  void bin(Executor& executor, const ContactCache& cache, const Proxies& proxies, StepCounters* counters);
  /// again: as of CollideInput.
  void run_pairs(Executor& executor, const NarrowPhaseWork& work, std::uint32_t shape_types, StepCounters* counters,
                 PairTime* again);

  std::uint32_t capacity_ = 0;
  bool uses_midphase_ = false;
  Storage caches_[2];
  Scan scan_;
  RadixSort<std::uint32_t> sort_;
  Buffer<std::uint32_t> kinds_, unordered_, sorted_kinds_, order_, first_;  // of bin()
};

}  // namespace plumb::impulse
