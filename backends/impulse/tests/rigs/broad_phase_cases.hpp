// What the benchmarks of the broad phase measure, on the CPU and on a CUDA device: the same inputs, the same phases,
// and a hash of the list of pairs, which must be the same on both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"
#include "tests/rigs/box_fields.hpp"
#include "tests/rigs/broad_phase_rig.hpp"

namespace plumb::impulse {

struct BroadPhaseCase {
  const char* name;
  Field field;
  int log2_boxes;
  Real neighbours;  ///< others that overlap a box; a pair is two boxes' neighbourhood
  BroadPhase::Method method;
  MortonBits bits;
};

inline constexpr BroadPhaseCase kBroadPhaseCases[] = {
    {"uniform 2^14", Field::kUniform, 14, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"uniform 2^17", Field::kUniform, 17, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"uniform 2^18", Field::kUniform, 18, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"giant 2^18", Field::kGiant, 18, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"clustered 2^17", Field::kClustered, 17, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"mixed 2^17", Field::kMixed, 17, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"uniform 2^20", Field::kUniform, 20, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"uniform 2^20, 30 bits", Field::kUniform, 20, 20, BroadPhase::Method::kLbvh, MortonBits::k30},
    {"sweep 2^14", Field::kUniform, 14, 20, BroadPhase::Method::kSweep, MortonBits::k63},
    {"grid 2^14", Field::kUniform, 14, 20, BroadPhase::Method::kGrid, MortonBits::k63},
    {"grid 2^17", Field::kUniform, 17, 20, BroadPhase::Method::kGrid, MortonBits::k63},
    {"uniform 2^9", Field::kUniform, 9, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"sweep 2^9", Field::kUniform, 9, 20, BroadPhase::Method::kSweep, MortonBits::k63},
    {"grid 2^9", Field::kUniform, 9, 20, BroadPhase::Method::kGrid, MortonBits::k63},
    {"mixed 2^11", Field::kMixed, 11, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"mixed 2^14", Field::kMixed, 14, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"mixed 2^20", Field::kMixed, 20, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"decades 2^14", Field::kDecades, 14, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"decades 2^17", Field::kDecades, 17, 20, BroadPhase::Method::kLbvh, MortonBits::k63},
    {"sparse 2^20", Field::kUniform, 20, 10, BroadPhase::Method::kLbvh, MortonBits::k63},
};

/// One case, set up and found once.
class BroadPhaseBench {
 public:
  BroadPhaseBench(const BroadPhaseCase& of, std::uint32_t threads) : rig(threads) {
    n = 1U << of.log2_boxes;
    rig.broad_phase.method = of.method;
    rig.broad_phase.morton_bits = of.bits;
    bits_ = of.bits;
    rig.set(make_boxes(of.field, n, 7, of.neighbours), n);
    pairs = rig.find(static_cast<std::uint32_t>(of.neighbours) * n);
    if (rig.found != pairs.size()) throw Error(PLUMB_E_INTERNAL, std::string(of.name) + ": more pairs than expected");
    reduce_.reserve(n);
    extent_.grow(1);
    tree_.reserve(n, bits_);
  }

  void extent() { reduce_.run(rig.executor, n, LoadExtent{rig.boxes.data(), rig.movers.data()}, extent_.data()); }
  void build() {
    extent();
    tree_.build(rig.executor, rig.boxes.data(), rig.movers.data(), n, extent_.data(), bits_);
  }
  void all() { rig.enqueue(); }

  [[nodiscard]] std::uint64_t hash() const {  // FNV-1a over the list in its order
    std::uint64_t h = 0xCBF29CE484222325U;
    for (const Pair& pair : pairs)
      for (const std::uint32_t word : {pair.a, pair.b}) h = (h ^ word) * 0x100000001B3U;
    return h;
  }

  BroadPhaseRig rig;
  std::uint32_t n = 0;
  std::vector<Pair> pairs;

 private:
  MortonBits bits_;
  Reduce<SceneExtent> reduce_;
  Buffer<SceneExtent> extent_;
  Lbvh tree_;
};

inline std::string hexadecimal(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t k = 16; k-- > 0; value >>= 4) text[k] = "0123456789abcdef"[value & 15U];
  return text;
}

/// The phases, each with what comes before it, under its name. The tree's is what the tree costs, whatever the method.
struct BroadPhasePhase {
  const char* name;
  void (BroadPhaseBench::*run)();
};
inline constexpr BroadPhasePhase kBroadPhasePhases[] = {
    {"extent", &BroadPhaseBench::extent}, {"extent + tree", &BroadPhaseBench::build}, {"all", &BroadPhaseBench::all}};

}  // namespace plumb::impulse
