#include "plumb/backend/host_memory.hpp"

#include "plumb/physics_world.hpp"

namespace plumb::backend {

namespace {

/// Both functions, or neither.
struct Lent {
  void* user = nullptr;
  decltype(PlumbHost::allocate) allocate = nullptr;
  decltype(PlumbHost::release) release = nullptr;
};
Lent lent;

}  // namespace

void* take_memory(std::size_t bytes, std::size_t alignment) noexcept {
  if (lent.allocate != nullptr) return lent.allocate(lent.user, bytes, alignment);
  return ::operator new (bytes, std::align_val_t{alignment}, std::nothrow);
}

void give_back_memory(void* memory, std::size_t alignment) noexcept {
  if (memory == nullptr) return;
  if (lent.release != nullptr)
    lent.release(lent.user, memory);
  else
    ::operator delete (memory, std::align_val_t{alignment});
}

void use_memory_of(const PlumbHost* host) noexcept {
  const bool lends = host != nullptr && has(*host, &PlumbHost::release) && host->allocate != nullptr;
  lent = lends ? Lent{host->user, host->allocate, host->release} : Lent{};
}

}  // namespace plumb::backend
