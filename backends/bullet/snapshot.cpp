// Save and restore: what moves, without the warm-start data, which Bullet keeps where no one can put it back.
#include <cstring>
#include <type_traits>

#include "plumb/assert.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

struct BodyState {
  btTransformData pose, interpolated;
  btVector3Data linear, angular, interpolated_linear, interpolated_angular, force, torque;
  btTransformData target;
  btVector3Data coast_linear, coast_angular;
  btScalar deactivation_time;
  std::int32_t activation;
  std::uint8_t has_target, coasts, was_asleep, reserved[5];
};
static_assert(std::is_trivially_copyable_v<BodyState>);

btTransformData serialized(const btTransform& transform) {
  btTransformData data;
  transform.serialize(data);
  return data;
}
btVector3Data serialized(const btVector3& v) {
  btVector3Data data{};
  v.serialize(data);
  return data;
}
btTransform restored(const btTransformData& data) {
  btTransform transform;
  transform.deSerialize(data);
  return transform;
}
btVector3 restored(const btVector3Data& data) {
  btVector3 v;
  v.deSerialize(data);
  return v;
}

BodyState state_of(const Body& body) {
  BodyState state{};
  state.pose = serialized(body.getWorldTransform());
  state.interpolated = serialized(body.getInterpolationWorldTransform());
  state.linear = serialized(body.getLinearVelocity());
  state.angular = serialized(body.getAngularVelocity());
  state.interpolated_linear = serialized(body.getInterpolationLinearVelocity());
  state.interpolated_angular = serialized(body.getInterpolationAngularVelocity());
  state.force = serialized(body.getTotalForce());
  state.torque = serialized(body.getTotalTorque());
  state.target = serialized(body.target);
  state.coast_linear = serialized(body.coasting.linear);
  state.coast_angular = serialized(body.coasting.angular);
  state.deactivation_time = body.getDeactivationTime();
  state.activation = body.getActivationState();
  state.has_target = body.has_target ? 1 : 0;
  state.coasts = body.coasting.on ? 1 : 0;
  return state;
}

void set_state(Body& body, const BodyState& state) {
  body.setCenterOfMassTransform(restored(state.pose));
  body.setInterpolationWorldTransform(restored(state.interpolated));
  body.setLinearVelocity(restored(state.linear));
  body.setAngularVelocity(restored(state.angular));
  body.setInterpolationLinearVelocity(restored(state.interpolated_linear));
  body.setInterpolationAngularVelocity(restored(state.interpolated_angular));
  body.clearForces();
  body.applyCentralForce(restored(state.force));
  body.applyTorque(restored(state.torque));
  body.target = restored(state.target);
  body.coasting.linear = restored(state.coast_linear);
  body.coasting.angular = restored(state.coast_angular);
  body.setDeactivationTime(state.deactivation_time);
  body.forceActivationState(state.activation);
  body.has_target = state.has_target != 0;
  body.coasting.on = state.coasts != 0;
}

template <class Row>
void append(std::vector<std::byte>& bytes, const std::vector<Row>& rows) {
  static_assert(std::is_trivially_copyable_v<Row>);
  const std::uint64_t count = rows.size();
  for (const auto part : {std::as_bytes(std::span(&count, 1)), std::as_bytes(std::span(rows))})
    bytes.insert(bytes.end(), part.begin(), part.end());
}

template <class Row>
std::vector<Row> take(std::span<const std::byte>& data) {
  std::uint64_t count = 0;
  if (data.size() >= sizeof count) std::memcpy(&count, data.data(), sizeof count);
  if (data.size() < sizeof count || (data.size() - sizeof count) / sizeof(Row) < count)
    throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
  std::vector<Row> rows(static_cast<std::size_t>(count));
  if (count != 0) std::memcpy(static_cast<void*>(rows.data()), data.data() + sizeof count, rows.size() * sizeof(Row));
  data = data.subspan(sizeof count + rows.size() * sizeof(Row));
  return rows;
}

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  lent_.snapshot.clear();
  std::vector<BodyState> states;
  for (const auto& body : bodies_)
    if (body) states.push_back(state_of(*body));
  append(lent_.snapshot, std::vector{gravity_});
  append(lent_.snapshot, states);
  append(lent_.snapshot, events_.pending);
  append(lent_.snapshot, events_.touches.touching());
  data = lent_.snapshot;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  std::size_t live = 0;
  for (const auto& body : bodies_) live += body ? 1 : 0;
  const auto gravity = take<PlumbVec3>(data);
  const auto states = take<BodyState>(data);
  auto pending_events = take<PlumbEvent>(data);
  auto touching = take<backend::TouchTracker::Pair>(data);
  if (gravity.size() != 1 || states.size() != live)
    throw Error(PLUMB_E_CORRUPT, "the snapshot does not have a state for every body");
  set_gravity(gravity[0]);
  PLUMB_ASSERT(sub_step_.left == 0);
  auto state = states.begin();
  for (const auto& body : bodies_)
    if (body) set_state(*body, *state++);
  events_.pending = std::move(pending_events);
  events_.touches.touching() = std::move(touching);
  // Contacts of where the bodies have been since are none of theirs.
  btOverlappingPairCache& pairs = *parts_.broadphase.getOverlappingPairCache();
  btBroadphasePairArray& array = pairs.getOverlappingPairArray();
  for (int i = 0; i < array.size(); ++i) pairs.cleanOverlappingPair(array[i], &parts_.dispatcher);
  world_.updateAabbs();
  solver_->solver().reset();
  contacts_.rows.clear();
  contacts_.fresh = true;
  return PLUMB_OK;
}

}  // namespace plumb::bullet
