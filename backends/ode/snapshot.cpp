// Saving and restoring all that moves, so that the same steps give the same bits again.
//
// quickstep keeps no impulses from step to step. What decides the bits, beside the rows, is the order in which the
// space lists its geoms (the pairs, and so the constraint rows, follow it), the random seed, and how long a body has
// been idle.
#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "plumb/assert.hpp"
#include "world.hpp"

namespace plumb::ode {
namespace {

/// All of a body that a step changes.
struct BodyState {
  dReal position[3], quaternion[4], rotation[12], velocity[3], spin[3];  ///< as ODE holds them
  PlumbPose static_pose;
  PlumbVec3 idle_spin, locked_position, force, torque;
  PlumbPose target;
  Body::Moving moving;
  Body::Idle idle;
  bool pushed, asleep, was_awake;
};

/// A geom by its body's place in the order of creation and its own in the body.
struct GeomName {
  std::uint32_t body, geom;
};

class Writer {
 public:
  explicit Writer(std::vector<std::byte>& bytes) : bytes_(bytes) { bytes_.clear(); }
  template <class Value>
  void put(const Value& value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof(Value));
  }
  template <class Value>
  void put_all(const std::vector<Value>& values) {
    put(std::uint64_t{values.size()});
    for (const Value& value : values) put(value);
  }

 private:
  std::vector<std::byte>& bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class Value>
  Value take() {
    Value value{};
    if (bytes_.size() < sizeof(Value)) throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
    std::memcpy(&value, bytes_.data(), sizeof(Value));
    bytes_ = bytes_.subspan(sizeof(Value));
    return value;
  }
  template <class Value>
  std::vector<Value> take_all() {
    const auto count = take<std::uint64_t>();
    if (count > bytes_.size() / sizeof(Value)) throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
    std::vector<Value> values;
    for (std::uint64_t i = 0; i < count; ++i) values.push_back(take<Value>());
    return values;
  }

 private:
  std::span<const std::byte> bytes_;
};

template <std::size_t Size>
void copy(dReal (&to)[Size], const dReal* from) {
  std::copy(from, from + Size, to);
}

BodyState state_of(const Body& body) {
  BodyState state;
  std::memset(&state, 0, sizeof state);  // the padding too: equal states are equal bytes
  state.static_pose = body.pose;
  state.idle_spin = body.idle_spin;
  state.locked_position = body.locks.position;
  state.force = body.push.force;
  state.torque = body.push.torque;
  state.target = body.target.pose;
  state.moving = body.target.moving;
  state.idle = body.sleep.idle;
  state.pushed = body.push.any;
  state.asleep = body.asleep();
  state.was_awake = body.sleep.was_awake;
  if (body.body == nullptr) return state;
  copy(state.position, dBodyGetPosition(body.body));
  copy(state.quaternion, dBodyGetQuaternion(body.body));
  copy(state.rotation, dBodyGetRotation(body.body));
  copy(state.velocity, dBodyGetLinearVel(body.body));
  copy(state.spin, dBodyGetAngularVel(body.body));
  return state;
}

void take_state(Body& body, const BodyState& state) {
  body.idle_spin = state.idle_spin;
  body.locks.position = state.locked_position;
  body.push.force = state.force;
  body.push.torque = state.torque;
  body.target.pose = state.target;
  body.target.moving = state.moving;
  body.push.any = state.pushed;
  body.sleep.was_awake = state.was_awake;
  if (body.body == nullptr) {
    body.set_frame(state.static_pose);
    return;
  }
  dBodySetPosition(body.body, state.position[0], state.position[1], state.position[2]);  // its geoms have moved
  // dBodySetQuaternion would normalise once more, and so change the last bits.
  std::copy(std::begin(state.quaternion), std::end(state.quaternion),
            const_cast<dReal*>(dBodyGetQuaternion(body.body)));
  std::copy(std::begin(state.rotation), std::end(state.rotation), const_cast<dReal*>(dBodyGetRotation(body.body)));
  dBodySetLinearVel(body.body, state.velocity[0], state.velocity[1], state.velocity[2]);
  dBodySetAngularVel(body.body, state.spin[0], state.spin[1], state.spin[2]);
  body.resume_idling(state.idle);
  if (state.asleep) dBodyDisable(body.body);
}

template <class Object>
std::vector<std::uint64_t> ids_of(const std::vector<Object*>& order) {
  std::vector<std::uint64_t> ids;
  for (const Object* object : order) ids.push_back(object->handle);
  return ids;
}

/// As they were created: some may have been made anew since, under the handles that they had.
template <class Object>
void put_in_order(std::vector<Object*>& order, const std::vector<std::uint64_t>& ids) {
  std::unordered_map<std::uint64_t, Object*> living;
  for (Object* object : order) living[object->handle] = object;
  if (ids.size() != order.size() ||
      !std::all_of(ids.begin(), ids.end(), [&](std::uint64_t id) { return living.contains(id); }))
    throw Error(PLUMB_E_CORRUPT, "the snapshot is of other bodies or joints");
  std::transform(ids.begin(), ids.end(), order.begin(), [&](std::uint64_t id) { return living[id]; });
}

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  if (space_ != nullptr &&
      (settings_.broad_phase.space == Space::sap || settings_.broad_phase.space == Space::quadtree))
    throw Error(PLUMB_E_UNSUPPORTED,
                "ODE does not tell the order inside its sap and quadtree spaces, on which the bits "
                "depend; make the world with the setting space=hash");
  return inside_ode([&] {
    Writer out(lent_.snapshot);
    out.put(seed_);
    out.put(gravity_);
    out.put_all(ids_of(lists_.all));
    out.put_all(ids_of(joint_lists_.all));
    for (const Body* body : lists_.all) out.put(state_of(*body));
    std::vector<GeomName> names;
    if (space_ != nullptr) {
      dSpaceClean(space_);
      for (std::uint32_t i = 0; i < lists_.all.size(); ++i)
        for (std::uint32_t k = 0; k < lists_.all[i]->geoms.size(); ++k) lists_.all[i]->geoms[k]->name = {i, k};
      for (int i = 0; i < dSpaceGetNumGeoms(space_); ++i) {
        const auto [body, geom] = tag_of(dSpaceGetGeom(space_, i)).name;
        PLUMB_ASSERT(body < lists_.all.size() && geom < lists_.all[body]->geoms.size());
        names.push_back({body, geom});
      }
    }
    out.put_all(names);
    const PairEvents::Memory memory = events_.memory();
    out.put_all(memory.touching);
    out.put_all(memory.sensed);
    data = lent_.snapshot;
    return PLUMB_OK;
  });
}

PlumbResult World::restore(std::span<const std::byte> data) {
  return inside_ode([&] {
    Reader in(data);
    const auto seed = in.take<unsigned long>();
    const auto gravity = in.take<PlumbVec3>();
    put_in_order(lists_.all, in.take_all<PlumbBody>());
    put_in_order(joint_lists_.all, in.take_all<PlumbJoint>());
    std::vector<BodyState> states;
    for (std::size_t i = 0; i < lists_.all.size(); ++i) states.push_back(in.take<BodyState>());
    const auto names = in.take_all<GeomName>();
    for (const GeomName& name : names)
      if (name.body >= lists_.all.size() || name.geom >= lists_.all[name.body]->geoms.size())
        throw Error(PLUMB_E_CORRUPT, "the snapshot is of other shapes");
    PairEvents::Memory memory;
    memory.touching = in.take_all<BodyPair>();
    memory.sensed = in.take_all<BodyPair>();

    seed_ = seed;
    set_gravity(gravity);
    PLUMB_ASSERT(substep_.left == 0);
    lists_.pushed.clear();
    for (std::size_t i = 0; i < lists_.all.size(); ++i) {
      take_state(*lists_.all[i], states[i]);
      if (lists_.all[i]->push.any) lists_.pushed.push_back(lists_.all[i]);
    }
    if (space_ != nullptr) {
      dSpaceClean(space_);  // only then may geoms change places: a space keeps those that moved in front
      for (auto name = names.rbegin(); name != names.rend(); ++name) {
        const dGeomID geom = lists_.all[name->body]->geoms[name->geom]->placed.geom;
        dSpaceRemove(space_, geom);
        dSpaceAdd(space_, geom);
      }
    }
    events_.remember(std::move(memory));
    figures_.nonfinite = 0;
    return PLUMB_OK;
  });
}

}  // namespace plumb::ode
