// Where bodies are and how fast: rows that the host and the step write in turn.
//
// Each side has all rows. After a step the device's are right; the host's are right where they were fetched or written
// since. Only what the host has touched travels to the device, before anything runs there, and only what it asks for
// travels back. On the CPU both sides are one, and nothing travels.
#pragma once

#include <span>
#include <vector>

#include "bodies/body.hpp"
#include "exec/archive.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

enum StatePart : std::uint32_t { kPosePart = 1u << 0, kVelocityPart = 1u << 1 };

/// A body's row under way.
struct StateEntry {
  Position position;
  Quat orientation;
  Velocity velocity;
  std::uint32_t slot, parts;
};

class BodyState {
 public:
  explicit BodyState(Executor& executor) : executor_(executor) {}

  Mirror<Position> position;
  Mirror<Quat> orientation;
  Mirror<Velocity> velocity;

  /// Both sides are right in all rows after this; new ones are at rest at the origin.
  void grow(std::size_t rows);
  [[nodiscard]] std::size_t size() const { return position.size(); }

  /// The host has written these parts of the row.
  void touch(std::uint32_t slot, std::uint32_t parts);
  /// Enqueues what was touched. Returns whether anything was; then wait before touching more.
  bool upload();
  /// The host's rows of these bodies are right after this.
  void fetch(std::span<const std::uint32_t> slots, std::uint32_t parts);
  void fetch_all();
  /// Whether the host's rows are right, all of them.
  [[nodiscard]] bool on_host() const { return kOneMemory || !stale_; }

  /// The first rows, to or from a snapshot.
  void exchange(Archive& archive, std::size_t rows);

  /// A step was enqueued, which moves the bodies.
  void stepped();
  /// Changes whenever state does.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  struct Known {  // epoch in which a part was last right on the host
    std::uint64_t pose, velocity;
  };
  [[nodiscard]] bool knows(std::uint32_t slot, std::uint32_t parts) const;
  void learn(std::uint32_t slot, std::uint32_t parts);
  void gather_entries(const std::vector<std::uint32_t>& slots);

  Executor& executor_;
  bool stale_ = false, whole_ = false;  // whole_: all rows are to be uploaded
  std::uint64_t version_ = 1, epoch_ = 1;
  std::vector<Known> known_;
  std::vector<std::uint8_t> touched_parts_;
  std::vector<std::uint32_t> touched_, missing_;
  Mirror<StateEntry> entries_;
};

}  // namespace plumb::impulse
