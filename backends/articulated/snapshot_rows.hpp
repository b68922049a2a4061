// What every adapter's snapshot has beside the engine's own coordinates: bodies as hosts see them, and who touched
// whom. Shared by engines whose bodies are trees of joints; nothing of one engine comes in here.
#pragma once

#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "plumb/backend/touch_tracker.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::articulated {

template <class Value>
void append(std::vector<std::byte>& bytes, const Value* values, std::size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(Value));
}

/// The next values, which are no longer in data then. Throws Error (PLUMB_E_CORRUPT) where it ends too early.
template <class Value>
void take(std::span<const std::byte>& data, Value* values, std::size_t count) {
  const std::size_t size = count * sizeof(Value);
  if (data.size() < size) throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
  if (size != 0) std::memcpy(values, data.data(), size);
  data = data.subspan(size);
}

struct BodyState {
  PlumbPose pose, target;
  PlumbVec3 velocity, spin, force, torque;
  std::uint64_t moving;
};

template <class Body>
void append_bodies(std::vector<std::byte>& bytes, const std::vector<std::unique_ptr<Body>>& bodies) {
  for (const auto& body : bodies) {
    if (!body) continue;
    const BodyState state{body->pose,
                          body->target,
                          body->velocity,
                          body->spin,
                          body->force,
                          body->torque,
                          static_cast<std::uint64_t>(body->moving)};
    append(bytes, &state, 1);
  }
}

/// Of those that live, in order.
template <class Body>
[[nodiscard]] std::vector<BodyState> take_bodies(std::span<const std::byte>& data,
                                                 const std::vector<std::unique_ptr<Body>>& bodies) {
  std::vector<BodyState> states;
  for (const auto& body : bodies)
    if (body) take(data, &states.emplace_back(), 1);
  return states;
}

template <class Body>
void put_back(const BodyState& state, Body& body) {
  body.pose = state.pose;
  body.target = state.target;
  body.velocity = state.velocity;
  body.spin = state.spin;
  body.force = state.force;
  body.torque = state.torque;
  body.moving = static_cast<typename Body::Moving>(state.moving);
}

using Touching = backend::TouchTracker::Pair;

inline void append_touching(std::vector<std::byte>& bytes, const std::vector<Touching>& touching) {
  for (const Touching& pair : touching) {
    const std::uint64_t row[3] = {pair.a, pair.b, pair.sensor};
    append(bytes, row, 3);
  }
}

/// All that is left.
[[nodiscard]] inline std::vector<Touching> take_touching(std::span<const std::byte>& data) {
  std::vector<Touching> touching;
  while (!data.empty()) {
    std::uint64_t row[3];
    take(data, row, 3);
    touching.push_back({row[0], row[1], row[2]});
  }
  return touching;
}

}  // namespace plumb::articulated
