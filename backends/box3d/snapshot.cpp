// Save and restore: what moves. Box3D keeps the impulses that it begins the next step with where no one can put them
// back: after a restore it begins with none.
#include <cstring>

#include "world.hpp"

namespace plumb::box3d {
namespace {

struct BodyState {
  double position[3], orientation[4];
  float velocity[3], spin[3];
  PlumbPose target;
  std::uint8_t moving, awake, was_asleep, reserved[5];
};
static_assert(sizeof(BodyState) == 7 * 8 + 6 * 4 + sizeof(PlumbPose) + 8, "no padding: equal states are equal bytes");

BodyState state_of(const Body& body) {
  const PlumbPose pose = body.pose();
  const b3Vec3 v = b3Body_GetLinearVelocity(body.id), w = b3Body_GetAngularVelocity(body.id);
  return {{pose.position.x, pose.position.y, pose.position.z},
          {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w},
          {v.x, v.y, v.z},
          {w.x, w.y, w.z},
          body.target,
          static_cast<std::uint8_t>(body.moving),
          static_cast<std::uint8_t>(b3Body_IsAwake(body.id) ? 1 : 0),
          static_cast<std::uint8_t>(body.was_asleep ? 1 : 0),
          {}};
}

void set_state(Body& body, const BodyState& state) {
  const auto narrow = [](double number) { return static_cast<float>(number); };
  b3Body_SetTransform(body.id, position({state.position[0], state.position[1], state.position[2]}, "pose"),
                      {{narrow(state.orientation[0]), narrow(state.orientation[1]), narrow(state.orientation[2])},
                       narrow(state.orientation[3])});
  body.target = state.target;
  body.moving = static_cast<Body::Moving>(state.moving);
  body.was_asleep = state.was_asleep != 0;
  if (body.is(PLUMB_STATIC)) return;
  b3Body_SetAwake(body.id, true);
  b3Body_SetLinearVelocity(body.id, {state.velocity[0], state.velocity[1], state.velocity[2]});
  b3Body_SetAngularVelocity(body.id, {state.spin[0], state.spin[1], state.spin[2]});
}

using Touching = backend::TouchTracker::Pair;

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

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  lent_.snapshot.clear();
  append(lent_.snapshot, to_plumb(b3World_GetGravity(world_)));
  for (const auto& body : bodies_)
    if (body) append(lent_.snapshot, state_of(*body));
  for (const Touching& pair : touches_.touching()) {
    append(lent_.snapshot, pair.a);
    append(lent_.snapshot, pair.b);
    append(lent_.snapshot, pair.sensor);
  }
  data = lent_.snapshot;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  const auto gravity = take<PlumbVec3>(data);
  std::vector<BodyState> states;
  for (const auto& body : bodies_)
    if (body) states.push_back(take<BodyState>(data));
  std::vector<Touching> touching;
  while (!data.empty()) {
    const auto a = take<PlumbBody>(data), b = take<PlumbBody>(data);
    touching.push_back({a, b, take<std::uint64_t>(data)});
  }
  set_gravity(gravity);
  auto state = states.begin();
  for (const auto& body : bodies_)
    if (body) set_state(*body, *state++);
  for (const auto& body : bodies_)
    if (body) find_pairs_again(*body);  // contacts of where they have been since are none of theirs
  state = states.begin();
  for (const auto& body : bodies_)
    if (body && (state++)->awake == 0 && !body->is(PLUMB_STATIC)) b3Body_SetAwake(body->id, false);
  touches_.touching() = std::move(touching);
  pending_events_.clear();
  contacts_.clear();
  contacts_fresh_ = true;
  return PLUMB_OK;
}

}  // namespace plumb::box3d
