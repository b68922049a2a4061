#include "exec/cpu/recording.hpp"

#include <cstring>

#include "plumb/physics_world.hpp"

namespace plumb::impulse {

void Recording::note_bytes(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::byte*>(data);
  if (!replays_) noted_.insert(noted_.end(), bytes, bytes + size);
  if (replays_ && (at_ + size > noted_.size() || std::memcmp(noted_.data() + at_, bytes, size) != 0)) stale();
  at_ += size;
}

void Recording::stale() {
  throw Error(PLUMB_E_INTERNAL, "a recorded step would be replayed with numbers or addresses that have changed");
}

}  // namespace plumb::impulse
