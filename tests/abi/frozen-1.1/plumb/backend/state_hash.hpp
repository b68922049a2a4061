// StateHash: 64 bits over float64 rows, by which two states are held to be the same to the last bit.
//
// A world's hash is taken over its live bodies in order of creation, each 7 numbers of pose and 6 of velocity. Both
// sides of the wall use this class, so that a backend's hash and one that the host takes of the rows it read are equal.
#pragma once

#include <cstdint>
#include <cstring>

namespace plumb::backend {

/// Order matters. -0 and 0 differ; every NaN counts as the same NaN. Not cryptographic.
///
/// Each word is xored in, then a multiplication and a shift spread it; both steps can be undone, so two streams that
/// differ in one word never meet again. The end is the finalizer of MurmurHash3 (Appleby 2011, fmix64).
class StateHash {
 public:
  void add(double number) {
    constexpr std::uint64_t canonical_nan = 0x7ff8000000000000u;
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    add_word(number != number ? canonical_nan : bits);
  }
  void add_word(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio, odd
    state_ ^= state_ >> 32;
  }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t h = state_;
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
    return h ^ (h >> 33);
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace plumb::backend
