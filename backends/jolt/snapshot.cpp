// Save and restore: Jolt's own state, and of it what the adapter keeps.
#include <cstring>

#include "recorder.hpp"
#include "world.hpp"

namespace plumb::jolt {
namespace {

/// Of bodies: what Jolt does not know.
struct BodyState {
  PlumbPose target;
  std::uint8_t moving, was_asleep, reserved[6];
};
static_assert(sizeof(BodyState) == sizeof(PlumbPose) + 8, "no padding: equal states are equal bytes");

/// Before all else. Jolt's own bytes are as long as they were.
struct Head {
  std::uint64_t bodies, joints, touching, jolts;
};

template <class Value>
void append(std::vector<std::byte>& bytes, const Value& value) {
  const auto* from = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), from, from + sizeof value);
}

template <class Value>
Value take(std::span<const std::byte>& data) {
  Value value;
  if (data.size() < sizeof value) throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
  std::memcpy(&value, data.data(), sizeof value);
  data = data.subspan(sizeof value);
  return value;
}

template <class Object>
std::uint64_t living(const std::vector<std::unique_ptr<Object>>& slots) {
  std::uint64_t count = 0;
  for (const auto& at : slots) count += at ? 1 : 0;
  return count;
}

constexpr auto kBesideJoints =
    JPH::EStateRecorderState::Global | JPH::EStateRecorderState::Bodies | JPH::EStateRecorderState::Contacts;

/// In the order of slots: Jolt's is that of who came and went.
template <class Visit>
void each_constraint(const std::vector<std::unique_ptr<Joint>>& joints, Visit visit) {
  for (const auto& joint : joints) {
    if (!joint) continue;
    visit(*joint->main);
    if (joint->helper != nullptr) visit(*joint->helper);
  }
}

void save_jolts(const JPH::PhysicsSystem& system, const std::vector<std::unique_ptr<Joint>>& joints,
                std::vector<std::byte>& bytes) {
  Recorder to(bytes);
  system.SaveState(to, kBesideJoints);
  each_constraint(joints, [&](const JPH::TwoBodyConstraint& constraint) { constraint.SaveState(to); });
}

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  std::vector<std::byte>& bytes = lent_.snapshot;
  std::vector<std::byte> jolts;
  save_jolts(system_, joints_, jolts);
  bytes.clear();
  append(bytes, Head{living(bodies_), living(joints_), touches_.touching().size(), jolts.size()});
  for (const auto& body : bodies_)
    if (body)
      append(bytes, BodyState{body->target,
                              static_cast<std::uint8_t>(body->moving),
                              static_cast<std::uint8_t>(body->was_asleep ? 1 : 0),
                              {}});
  for (const backend::TouchTracker::Pair& pair : touches_.touching()) append(bytes, pair);
  bytes.insert(bytes.end(), jolts.begin(), jolts.end());
  data = bytes;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  const auto head = take<Head>(data);
  if (head.bodies != living(bodies_) || head.joints != living(joints_))
    throw Error(PLUMB_E_CORRUPT, "the snapshot is of " + std::to_string(head.bodies) + " bodies and " +
                                     std::to_string(head.joints) + " joints; here live others");
  std::vector<BodyState> states;
  std::vector<backend::TouchTracker::Pair> touching;
  for (std::uint64_t i = 0; i < head.bodies; ++i) states.push_back(take<BodyState>(data));
  for (std::uint64_t i = 0; i < head.touching; ++i) touching.push_back(take<backend::TouchTracker::Pair>(data));
  if (data.size() != head.jolts) throw Error(PLUMB_E_CORRUPT, "the snapshot has not the length that it says");

  Recorder from(data);
  bool done = system_.RestoreState(from);
  each_constraint(joints_, [&](JPH::TwoBodyConstraint& constraint) { constraint.RestoreState(from); });
  done = done && !from.IsFailed() && from.rest().empty();
  if (!done) throw Error(PLUMB_E_WORLD_LOST, "Jolt could not put back all of what it had saved");
  auto state = states.begin();
  for (const auto& body : bodies_) {
    if (!body) continue;
    body->target = state->target;
    body->moving = static_cast<Body::Moving>(state->moving);
    body->was_asleep = (state++)->was_asleep != 0;
  }
  touches_.touching() = std::move(touching);
  pending_events_.clear();
  listener_.forget_all();
  lent_.contacts.clear();
  last_.contacts_fresh = true;
  return PLUMB_OK;
}

}  // namespace plumb::jolt
