#include "bodies/body_state.hpp"

#include <algorithm>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct StateView {
  Position* position;
  Quat* orientation;
  Velocity* velocity;
};

struct PutRows {
  StateView state;
  const StateEntry* entries;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const StateEntry& entry = entries[i];
    if ((entry.parts & kPosePart) != 0) {
      state.position[entry.slot] = entry.position;
      state.orientation[entry.slot] = entry.orientation;
    }
    if ((entry.parts & kVelocityPart) != 0) state.velocity[entry.slot] = entry.velocity;
  }
};

struct TakeRows {
  StateView state;
  StateEntry* entries;
  PLUMB_HD void operator()(std::uint32_t i) const {
    StateEntry& entry = entries[i];
    entry.position = state.position[entry.slot];
    entry.orientation = state.orientation[entry.slot];
    entry.velocity = state.velocity[entry.slot];
  }
};

}  // namespace

void BodyState::grow(std::size_t rows) {
  fetch_all();
  const std::size_t before = size();
  if (!kOneMemory) {
    known_.resize(rows);
    touched_parts_.resize(rows);
    whole_ = true;
  }
  orientation.grow(rows);
  velocity.grow(rows);
  position.grow(rows);
  for (std::size_t i = before; i < size(); ++i) orientation[i] = {0, 0, 0, 1};
  ++version_;
}

bool BodyState::knows(std::uint32_t slot, std::uint32_t parts) const {
  const Known& known = known_[slot];
  return ((parts & kPosePart) == 0 || known.pose == epoch_) &&
         ((parts & kVelocityPart) == 0 || known.velocity == epoch_);
}

void BodyState::learn(std::uint32_t slot, std::uint32_t parts) {
  if ((parts & kPosePart) != 0) known_[slot].pose = epoch_;
  if ((parts & kVelocityPart) != 0) known_[slot].velocity = epoch_;
}

void BodyState::touch(std::uint32_t slot, std::uint32_t parts) {
  PLUMB_ASSERT(slot < size());
  ++version_;
  if (kOneMemory) return;
  learn(slot, parts);
  if (touched_parts_[slot] == 0) touched_.push_back(slot);
  touched_parts_[slot] |= static_cast<std::uint8_t>(parts);
}

void BodyState::gather_entries(const std::vector<std::uint32_t>& slots) {
  if (slots.size() > entries_.size()) entries_.grow(std::max(slots.size(), 2 * entries_.size()));
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::uint32_t slot = slots[i];
    entries_[i] = {position[slot], orientation[slot], velocity[slot], slot, touched_parts_[slot]};
  }
  executor_.to_device(entries_, slots.size());
}

bool BodyState::upload() {
  if (kOneMemory || (!whole_ && touched_.empty())) return false;
  if (whole_) {
    executor_.to_device(position, size());
    executor_.to_device(orientation, size());
    executor_.to_device(velocity, size());
  } else {
    gather_entries(touched_);
    executor_.run(static_cast<std::uint32_t>(touched_.size()),
                  PutRows{{position.device(), orientation.device(), velocity.device()}, entries_.device()});
  }
  for (const std::uint32_t slot : touched_) touched_parts_[slot] = 0;
  touched_.clear();
  whole_ = false;
  return true;
}

void BodyState::fetch(std::span<const std::uint32_t> slots, std::uint32_t parts) {
  if (on_host()) return;
  missing_.clear();
  for (const std::uint32_t slot : slots)
    if (!knows(slot, parts)) missing_.push_back(slot);
  if (missing_.empty()) return;
  if (upload()) executor_.wait();
  gather_entries(missing_);
  executor_.run(static_cast<std::uint32_t>(missing_.size()),
                TakeRows{{position.device(), orientation.device(), velocity.device()}, entries_.device()});
  executor_.to_host(entries_, missing_.size());
  executor_.wait();
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    const StateEntry& entry = entries_[i];
    position[entry.slot] = entry.position;
    orientation[entry.slot] = entry.orientation;
    velocity[entry.slot] = entry.velocity;
    learn(entry.slot, kPosePart | kVelocityPart);
  }
}

void BodyState::fetch_all() {
  if (on_host()) return;
  upload();
  executor_.to_host(position, size());
  executor_.to_host(orientation, size());
  executor_.to_host(velocity, size());
  executor_.wait();
  stale_ = false;
}

void BodyState::exchange(Archive& archive, std::size_t rows) {
  PLUMB_ASSERT(rows <= size());
  fetch_all();
  archive.items(position.host(), rows);
  archive.items(orientation.host(), rows);
  archive.items(velocity.host(), rows);
  if (!archive.reads()) return;
  ++version_;
  whole_ = !kOneMemory;
}

void BodyState::stepped() {
  ++version_;
  ++epoch_;
  stale_ = true;
}

}  // namespace plumb::impulse
