// A sequence that record() has seen. The CPU runs it anew each time, so there is nothing to keep. The build that plays
// a device (PLUMB_IMPULSE_MEMORY_APART) notes what a device would replay, and fails where that is no longer what is
// meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "exec/memory.hpp"

namespace plumb::impulse {

class Recording {
 public:
  void forget() { noted_.clear(); }

  void begin() {
    replays_ = !noted_.empty();
    at_ = 0;
  }
  template <class F>
  void note(std::uint32_t n, [[maybe_unused]] F kernel) {
    if (kOneMemory) return;
    note_bytes(&n, sizeof n);
#if __has_builtin(__builtin_clear_padding)  // where the compiler has none, as Clang 19, kernels cannot be compared
    __builtin_clear_padding(&kernel);
    note_bytes(&kernel, sizeof kernel);
#endif
  }
  void end() const {
    if (replays_ && at_ != noted_.size()) stale();
  }

 private:
  void note_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    if (!replays_) noted_.insert(noted_.end(), bytes, bytes + size);
    if (replays_ && (at_ + size > noted_.size() || std::memcmp(noted_.data() + at_, bytes, size) != 0)) stale();
    at_ += size;
  }
  [[noreturn]] static void stale();

  std::vector<std::byte> noted_;
  std::size_t at_ = 0;
  bool replays_ = false;
};

}  // namespace plumb::impulse
