// A host that lends memory, counts what is taken of it, and refuses when it is told to.
#pragma once

#include <cstddef>
#include <mutex>
#include <unordered_map>

#include "plumb/plumb.h"

namespace plumb::harness::conform {

/// Lives as long as the process, for a backend may give memory back at its very end.
class MemoryHost {
 public:
  static MemoryHost& instance();

  [[nodiscard]] const PlumbHost* host() const { return &host_; }

  struct Held {
    std::size_t blocks = 0, bytes = 0;
  };
  [[nodiscard]] Held held() const;
  /// Of releases of what was not held, and of alignments that are none.
  [[nodiscard]] std::size_t mistakes() const;

  /// `next` more times memory is given, then none until allow().
  void refuse_after(std::size_t next);
  /// Whether any was refused since.
  bool allow();

 private:
  MemoryHost();
  void* allocate(std::size_t bytes, std::size_t alignment);
  void release(void* memory);

  struct Block {
    std::size_t bytes, alignment;
  };
  PlumbHost host_{};
  mutable std::mutex mutex_;
  std::unordered_map<void*, Block> blocks_;
  std::size_t bytes_ = 0, mistakes_ = 0, left_ = 0;
  bool limited_ = false, refused_ = false;
};

}  // namespace plumb::harness::conform
