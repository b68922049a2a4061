// A sequence that record() has seen. The CPU runs it anew each time, so there is nothing to keep. A program that plays
// a device (memory_apart.cpp) notes what a device would replay, and fails where that is no longer what is meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb::impulse {

class Recording {
 public:
  void forget() { noted_.clear(); }

  void begin() {
    replays_ = !noted_.empty();
    at_ = 0;
  }
  /// Out of the way of kernels that run with nothing recorded.
  template <class F>
  [[gnu::cold, gnu::noinline]] void note(std::uint32_t n, [[maybe_unused]] const F& f) {
    note_bytes(&n, sizeof n);
#if __has_builtin(__builtin_clear_padding)  // where the compiler has none, as Clang 19, kernels cannot be compared
    F kernel = f;
    __builtin_clear_padding(&kernel);
    note_bytes(&kernel, sizeof kernel);
#endif
  }
  void end() const {
    if (replays_ && at_ != noted_.size()) stale();
  }

 private:
  void note_bytes(const void* data, std::size_t size);
  [[noreturn]] static void stale();

  std::vector<std::byte> noted_;
  std::size_t at_ = 0;
  bool replays_ = false;
};

}  // namespace plumb::impulse
