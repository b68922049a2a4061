// Memory of the CPU library: the host's own.
#include "exec/memory.hpp"

#include "plumb/backend/host_memory.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse::memory {

constexpr std::size_t kAlignment = 256;

void* allocate(std::size_t bytes) {
  void* data = backend::take_memory(bytes, kAlignment);
  if (data == nullptr) throw Error(PLUMB_E_OUT_OF_MEMORY, "no " + std::to_string(bytes) + " bytes of memory are left");
  return data;
}
void release(void* data) noexcept { backend::give_back_memory(data, kAlignment); }
void* allocate_host(std::size_t bytes) { return allocate(bytes); }
void release_host(void* data) noexcept { release(data); }
void fill(void* data, int byte, std::size_t bytes) { std::memset(data, byte, bytes); }
void copy_between(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
void upload(void* to, const void* from_host, std::size_t bytes) { std::memcpy(to, from_host, bytes); }
void download(void* to_host, const void* from, std::size_t bytes) { std::memcpy(to_host, from, bytes); }

}  // namespace plumb::impulse::memory
