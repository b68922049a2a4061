#include "conform/memory_host.hpp"

#include <bit>
#include <new>

namespace plumb::harness::conform {

MemoryHost& MemoryHost::instance() {
  static auto* const only = new MemoryHost;  // never destroyed
  return *only;
}

MemoryHost::MemoryHost() {
  host_.struct_size = sizeof host_;
  host_.user = this;
  host_.allocate = [](void* user, std::size_t bytes, std::size_t alignment) {
    return static_cast<MemoryHost*>(user)->allocate(bytes, alignment);
  };
  host_.release = [](void* user, void* memory) { static_cast<MemoryHost*>(user)->release(memory); };
}

MemoryHost::Held MemoryHost::held() const {
  const std::lock_guard lock(mutex_);
  return {blocks_.size(), bytes_};
}

std::size_t MemoryHost::mistakes() const {
  const std::lock_guard lock(mutex_);
  return mistakes_;
}

void MemoryHost::refuse_after(std::size_t next) {
  const std::lock_guard lock(mutex_);
  limited_ = true;
  refused_ = false;
  left_ = next;
}

bool MemoryHost::allow() {
  const std::lock_guard lock(mutex_);
  limited_ = false;
  return refused_;
}

void* MemoryHost::allocate(std::size_t bytes, std::size_t alignment) {
  const std::lock_guard lock(mutex_);
  if (bytes == 0 || !std::has_single_bit(alignment) || alignment > 256) {
    ++mistakes_;
    return nullptr;
  }
  if (limited_ && left_-- == 0) {
    left_ = 0;
    refused_ = true;
    return nullptr;
  }
  void* const memory = ::operator new (bytes, std::align_val_t{alignment}, std::nothrow);
  if (memory == nullptr) return nullptr;
  blocks_[memory] = {bytes, alignment};
  bytes_ += bytes;
  return memory;
}

void MemoryHost::release(void* memory) {
  const std::lock_guard lock(mutex_);
  const auto block = blocks_.find(memory);
  if (block == blocks_.end()) {
    ++mistakes_;
    return;
  }
  bytes_ -= block->second.bytes;
  ::operator delete (memory, std::align_val_t{block->second.alignment});
  blocks_.erase(block);
}

}  // namespace plumb::harness::conform
