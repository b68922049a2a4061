// The validation layer's check of the calls whose arguments are like no other's.
#pragma once

#include "validation.hpp"

namespace plumb::layers {

inline PlumbResult ValidationLayer::run(CallTag<Call::collide_pairs>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbPosedPair* pairs, std::size_t stride, std::uint32_t count,
                                        PlumbPairResult* results, PlumbPairPoint* points, std::uint32_t capacity,
                                        std::uint32_t* point_count) {
  require_memory(pairs, count, "pairs");
  require_stride<PlumbPosedPair>(stride, count, "pairs");
  require_memory(results, count, "results");
  require_memory(points, capacity, "points");
  require_memory(point_count, 1, "point_count");
  Canary rows(sizeof(PlumbPairResult), sizeof(PlumbPairResult), count);
  Canary out(sizeof(PlumbPairPoint), sizeof(PlumbPairPoint), capacity);
  std::uint32_t found = 0;
  const PlumbResult result =
      next<Call::collide_pairs>()(world, pairs, stride, count, reinterpret_cast<PlumbPairResult*>(rows.data()),
                                  reinterpret_cast<PlumbPairPoint*>(out.data()), capacity, &found);
  if (!rows.end_intact()) throw BackendError{"wrote more than " + std::to_string(count) + " results"};
  if (!out.end_intact()) throw BackendError{"wrote more than " + std::to_string(capacity) + " points"};
  if (result < 0) return result;
  require_count(result, capacity, found);
  if (rows.first_unwritten(count) < count) throw BackendError{"left a result unwritten"};
  rows.copy_to(results, count);
  out.copy_to(points, std::min(found, capacity));
  *point_count = found;
  for (std::uint32_t i = 0; i < count; ++i)
    if (std::uint64_t{results[i].first_point} + results[i].point_count > found)
      throw BackendError{"results[" + std::to_string(i) + "] names points beyond the " + std::to_string(found) +
                         " there are"};
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::exceptions_set>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbBodyPair* pairs, std::size_t stride, std::uint32_t count,
                                        std::uint32_t touch) {
  require_memory(pairs, count, "pairs");
  require_stride<PlumbBodyPair>(stride, count, "pairs");
  if (touch > 1) refuse_argument("touch is " + std::to_string(touch) + "; it must be 0 or 1");
  return next<Call::exceptions_set>()(world, pairs, stride, count, touch);
}

inline PlumbResult ValidationLayer::run(CallTag<Call::modify_shapes>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                                        std::uint32_t count) {
  require_memory(shapes, count, "shapes");
  require_descs(descs, stride, count);
  return next<Call::modify_shapes>()(world, shapes, descs, stride, count);
}

template <Call call, class Change>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld&, PlumbWorld* world, const Change* changes,
                                 std::size_t stride, std::uint32_t count) {
  require_memory(changes, count, "changes");
  require_stride<Change>(stride, count, "changes");
  return next<call>()(world, changes, stride, count);
}

inline PlumbResult ValidationLayer::run(CallTag<Call::core_user_data>, ValidatedWorld&, PlumbWorld* world, PlumbBody id,
                                        std::uint64_t* user_data) {
  require_memory(user_data, 1, "user_data");
  return next<Call::core_user_data>()(world, id, user_data);
}

inline PlumbResult ValidationLayer::run(CallTag<Call::core_set_gravity>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbVec3* gravity) {
  require_memory(gravity, 1, "gravity");
  return next<Call::core_set_gravity>()(world, gravity);
}

inline PlumbResult ValidationLayer::run(CallTag<Call::core_step>, ValidatedWorld& state, PlumbWorld* world,
                                        const PlumbStepDesc* desc) {
  require_memory(desc, 1, "desc");
  require_struct_size(*desc, UINT32_MAX, "desc");
  const PlumbResult result = next<Call::core_step>()(world, desc);
  state.stepping = result >= 0;
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::core_wait>, ValidatedWorld& state, PlumbWorld* world,
                                        PlumbStepReport* report) {
  if (report != nullptr) require_struct_size(*report, UINT32_MAX, "report");
  state.stepping = false;  // whatever wait answers, the step is over
  if (report == nullptr) return next<Call::core_wait>()(world, nullptr);
  const std::uint32_t size = report->struct_size;
  Canary canary(size, size, 1);
  std::memcpy(canary.data(), &size, sizeof size);
  const PlumbResult result = next<Call::core_wait>()(world, reinterpret_cast<PlumbStepReport*>(canary.data()));
  if (!canary.end_intact()) throw BackendError{"wrote beyond the report's struct_size of " + std::to_string(size)};
  if (result < 0) return result;
  const auto& ours = *reinterpret_cast<const PlumbStepReport*>(canary.data());
  if (ours.struct_size != size)
    throw BackendError{"changed the report's struct_size to " + std::to_string(ours.struct_size)};
  if (ours.bodies != state.bodies || ours.awake > ours.bodies)
    throw BackendError{"reports " + std::to_string(ours.bodies) + " bodies, " + std::to_string(ours.awake) +
                       " awake, where " + std::to_string(state.bodies) + " live"};
  canary.copy_to(report, 1);
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::settings_get>, ValidatedWorld&, PlumbWorld* world,
                                        const char* name, PlumbSettingValue* value) {
  require_memory(name, 1, "name");
  require_memory(value, 1, "value");
  PlumbSettingValue ours{};
  const PlumbResult result = next<Call::settings_get>()(world, name, &ours);
  if (result < 0) return result;
  if (ours.type > PLUMB_SETTING_CHOICE || (ours.type == PLUMB_SETTING_CHOICE) != (ours.choice != nullptr))
    throw BackendError{std::string("gives ") + name + " a value of type " + std::to_string(ours.type) +
                       (ours.choice == nullptr ? " without a choice" : " with a choice")};
  *value = ours;
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::settings_set>, ValidatedWorld&, PlumbWorld* world,
                                        const char* name, const PlumbSettingValue* value) {
  require_memory(name, 1, "name");
  require_memory(value, 1, "value");
  return next<Call::settings_set>()(world, name, value);
}

template <Call call>
PlumbResult ValidationLayer::run_save(PlumbWorld* world, void* data, std::size_t capacity, std::size_t* size) {
  require_memory(data, capacity, "data");
  require_memory(size, 1, "size");
  Canary canary(1, 1, capacity);
  std::size_t needed = 0;
  const PlumbResult result = next<call>()(world, canary.data(), capacity, &needed);
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(capacity) + " bytes"};
  if (result < 0) return result;
  require_count(result, capacity, needed);
  if (result == PLUMB_TRUNCATED && !canary.untouched())
    throw BackendError{"wrote a part of a snapshot that did not fit"};
  canary.copy_to(data, std::min(needed, capacity));
  *size = needed;
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::snapshot_save>, ValidatedWorld&, PlumbWorld* world, void* data,
                                        std::size_t capacity, std::size_t* size) {
  return run_save<Call::snapshot_save>(world, data, capacity, size);
}
inline PlumbResult ValidationLayer::run(CallTag<Call::snapshot_save_world>, ValidatedWorld&, PlumbWorld* world,
                                        void* data, std::size_t capacity, std::size_t* size) {
  return run_save<Call::snapshot_save_world>(world, data, capacity, size);
}

inline PlumbResult ValidationLayer::run(CallTag<Call::snapshot_restore>, ValidatedWorld& state, PlumbWorld* world,
                                        const void* data, std::size_t size) {
  require_memory(data, size, "data");
  const PlumbResult result = next<Call::snapshot_restore>()(world, data, size);
  // Others may live now.
  if (result >= 0) (void)next<Call::core_list_bodies>()(world, nullptr, 0, &state.bodies);
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::snapshot_hash>, ValidatedWorld&, PlumbWorld* world,
                                        std::uint64_t* hash) {
  require_memory(hash, 1, "hash");
  return next<Call::snapshot_hash>()(world, hash);
}

inline PlumbResult ValidationLayer::run(CallTag<Call::state_borrow>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbStateRequest* request, PlumbDLManagedTensor** tensor,
                                        PlumbFence* fence) {
  require_memory(request, 1, "request");
  require_struct_size(*request, UINT32_MAX, "request");
  require_memory(tensor, 1, "tensor");
  PlumbDLManagedTensor* lent = nullptr;
  const PlumbResult result = next<Call::state_borrow>()(world, request, &lent, fence);
  if (result < 0) return result;
  if (lent == nullptr || lent->deleter == nullptr) throw BackendError{"lends no tensor, or one without a deleter"};
  *tensor = lent;
  if (result == PLUMB_COPIED && request->allow_copy == 0) throw BackendError{"copied where allow_copy is 0"};
  return result;
}

inline PlumbResult ValidationLayer::run(CallTag<Call::state_rows>, ValidatedWorld&, PlumbWorld* world, PlumbBody* ids,
                                        std::uint32_t capacity, std::uint32_t* count, std::uint64_t* generation) {
  require_memory(ids, capacity, "ids");
  require_memory(count, 1, "count");
  require_memory(generation, 1, "generation");
  Canary canary(sizeof(PlumbBody), sizeof(PlumbBody), capacity);
  std::uint32_t found = 0;
  const PlumbResult result =
      next<Call::state_rows>()(world, reinterpret_cast<PlumbBody*>(canary.data()), capacity, &found, generation);
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(capacity) + " ids"};
  if (result < 0) return result;
  require_count(result, capacity, found);
  canary.copy_to(ids, std::min(found, capacity));
  *count = found;
  return result;
}

}  // namespace plumb::layers
