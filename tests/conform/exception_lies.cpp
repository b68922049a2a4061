// Lies about pair exceptions.
#include "honest.hpp"

namespace plumb::lying {
namespace {

std::vector<PlumbBodyPair> kept;  // that were set

std::vector<PlumbBodyPair> listed(PlumbWorld* world) {
  std::vector<PlumbBodyPair> pairs(1000);
  std::uint32_t count = 0;
  honest.exceptions.list(world, pairs.data(), static_cast<std::uint32_t>(pairs.size()), &count);
  pairs.resize(std::min<std::size_t>(pairs.size(), count));
  return pairs;
}

void forget_all(PlumbWorld* world) {
  const std::vector<PlumbBodyPair> pairs = listed(world);
  honest.exceptions.set(world, pairs.data(), sizeof(PlumbBodyPair), static_cast<std::uint32_t>(pairs.size()), 1);
}

}  // namespace

void exceptions_ignored() {
  liar.exceptions.set = [](PlumbWorld*, const PlumbBodyPair*, std::size_t, std::uint32_t,
                           std::uint32_t) -> PlumbResult { return PLUMB_OK; };
}
void bullets_have_no_exceptions() { exceptions_ignored(); }
void excepted_contacts_never_end() { hide_events<PLUMB_EVENT_CONTACT_END>(); }
void excepted_bodies_stay_sensed() { hide_events<PLUMB_EVENT_SENSOR_LEAVE>(); }

void excepted_bodies_sleep_on() {
  liar.exceptions.set = [](PlumbWorld* world, const PlumbBodyPair* pairs, std::size_t stride, std::uint32_t count,
                           std::uint32_t touch) {
    const PlumbResult result = honest.exceptions.set(world, pairs, stride, count, touch);
    const double asleep = 0;
    for (const PlumbBodyPair& pair : copied(pairs, stride, count))
      for (const PlumbBody body : {pair.body_a, pair.body_b})
        honest.core.write(world, PLUMB_FIELD_AWAKE, PLUMB_F64, &body, 1, &asleep, sizeof asleep);
    return result;
  };
}

void no_exceptions_listed() {
  liar.exceptions.list = [](PlumbWorld*, PlumbBodyPair*, std::uint32_t, std::uint32_t* count) -> PlumbResult {
    return *count = 0, PLUMB_OK;
  };
}

void slots_keep_exceptions() {
  liar.exceptions.set = [](PlumbWorld* world, const PlumbBodyPair* pairs, std::size_t stride, std::uint32_t count,
                           std::uint32_t touch) {
    kept = copied(pairs, stride, count);
    return honest.exceptions.set(world, pairs, stride, count, touch);
  };
  liar.core.create_bodies = [](PlumbWorld* world, const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count,
                               PlumbBody* ids) {
    const PlumbResult result = honest.core.create_bodies(world, descs, stride, count, ids);
    for (PlumbBodyPair pair : kept) {
      for (PlumbBody* body : {&pair.body_a, &pair.body_b})
        if (result >= 0 && slot_of(*body) == slot_of(ids[0])) *body = ids[0];
      honest.exceptions.set(world, &pair, sizeof pair, 1, 0);
    }
    return result;
  };
}

void exceptions_not_restored() {
  liar.snapshot.restore = [](PlumbWorld* world, const void* data, std::size_t size) {
    const PlumbResult result = honest.snapshot.restore(world, data, size);
    forget_all(world);
    return result;
  };
}

void joints_take_exceptions_with_them() {
  liar.joints.destroy = [](PlumbWorld* world, const PlumbJoint* ids, std::uint32_t count) {
    const PlumbResult result = honest.joints.destroy(world, ids, count);
    forget_all(world);
    return result;
  };
}

}  // namespace plumb::lying
