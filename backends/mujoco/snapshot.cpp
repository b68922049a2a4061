// Save and restore: MuJoCo's coordinates, their rates and its warm start are all that a step begins with, so the same
// steps give the same bits again.
#include <cstring>

#include "world.hpp"

namespace plumb::mujoco {
namespace {

struct BodyState {
  PlumbPose pose, target;
  PlumbVec3 velocity, spin, force, torque;
  std::uint64_t moving;
};

using Touching = backend::TouchTracker::Pair;

template <class Value>
void append(std::vector<std::byte>& bytes, const Value* values, std::size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(Value));
}

template <class Value>
void take(std::span<const std::byte>& data, Value* values, std::size_t count) {
  const std::size_t size = count * sizeof(Value);
  if (data.size() < size) throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
  if (size != 0) std::memcpy(values, data.data(), size);
  data = data.subspan(size);
}

struct Coordinates {
  std::vector<mjtNum> position, rate, warm;

  explicit Coordinates(const mjModel& m)
      : position(static_cast<std::size_t>(m.nq)), rate(static_cast<std::size_t>(m.nv)), warm(rate.size()) {}
};

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  prepare();
  const mjModel& m = *model_.model;
  const mjData& d = *model_.data;
  snapshot_.clear();
  append(snapshot_, &gravity_, 1);
  append(snapshot_, d.qpos, static_cast<std::size_t>(m.nq));
  append(snapshot_, d.qvel, static_cast<std::size_t>(m.nv));
  append(snapshot_, d.qacc_warmstart, static_cast<std::size_t>(m.nv));
  for (const auto& body : bodies_) {
    if (!body) continue;
    const BodyState state{body->pose,
                          body->target,
                          body->velocity,
                          body->spin,
                          body->force,
                          body->torque,
                          static_cast<std::uint64_t>(body->moving)};
    append(snapshot_, &state, 1);
  }
  for (const Touching& pair : touches_.touching()) {
    const std::uint64_t row[3] = {pair.a, pair.b, pair.sensor};
    append(snapshot_, row, 3);
  }
  data = snapshot_;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  prepare();
  mjData& d = *model_.data;
  Coordinates saved(*model_.model);
  PlumbVec3 gravity{};
  take(data, &gravity, 1);
  take(data, saved.position.data(), saved.position.size());
  take(data, saved.rate.data(), saved.rate.size());
  take(data, saved.warm.data(), saved.warm.size());
  std::vector<BodyState> states;
  for (const auto& body : bodies_)
    if (body) take(data, &states.emplace_back(), 1);
  std::vector<Touching> touching;
  while (!data.empty()) {
    std::uint64_t row[3];
    take(data, row, 3);
    touching.push_back({row[0], row[1], row[2]});
  }
  set_gravity(gravity);
  auto state = states.begin();
  for (const auto& body : bodies_) {
    if (!body) continue;
    body->pose = state->pose, body->target = state->target;
    body->velocity = state->velocity, body->spin = state->spin;
    body->force = state->force, body->torque = state->torque;
    body->moving = static_cast<Body::Moving>(state->moving);
    body->written = body->is(PLUMB_STATIC);
    ++state;
  }
  write_state();  // of what stands still
  std::copy(saved.position.begin(), saved.position.end(), d.qpos);
  std::copy(saved.rate.begin(), saved.rate.end(), d.qvel);
  std::copy(saved.warm.begin(), saved.warm.end(), d.qacc_warmstart);
  touches_.touching() = std::move(touching);
  pending_events_.clear();
  contacts_.clear();
  return PLUMB_OK;
}

}  // namespace plumb::mujoco
