// The validation layer: one object for each table that is validated, with what it knows of its worlds.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "canary.hpp"
#include "layer_slots.hpp"
#include "plumb/layers.hpp"
#include "validation_checks.hpp"
#include "validation_world.hpp"

namespace plumb::layers {

template <Call call>
using CallTag = std::integral_constant<Call, call>;

class ValidationLayer : public LayerBase {
 public:
  using LayerBase::LayerBase;

  template <Call call, class... Args>
  auto on(Args... args) {
    if constexpr (call == Call::core_create_world) {
      return create_world(args...);
    } else if constexpr (call == Call::core_destroy_world) {
      return destroy_world(args...);
    } else {
      return on_world_call<call>(args...);
    }
  }

  PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char** note);
  const char* error_text(PlumbWorld* world);
  std::vector<Finding> take_findings();

 private:
  template <Call call, class... Args>
  PlumbResult on_world_call(PlumbWorld* world, Args... args);
  // What all of them have around their own part, compiled once.
  PlumbResult checked_call(Call call, Thread thread, Remarks remarks, PlumbWorld* world,
                           const std::function<PlumbResult(ValidatedWorld&)>& forward);

  // One function for each shape of a call: checks the arguments, forwards, checks the answer.
  template <Call call, class Desc>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, const Desc* descs, std::size_t stride,
                  std::uint32_t count, std::uint64_t* ids);
  template <Call call>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, const std::uint64_t* ids, std::uint32_t count);
  template <Call call, class Row>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, Row* out, std::uint32_t capacity, std::uint32_t* count);
  template <Call call, class Row>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, Row* out, std::size_t stride, std::uint32_t capacity,
                  std::uint32_t* count);
  template <Call call>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, std::uint32_t field, PlumbDataType type,
                  const std::uint64_t* ids, std::uint32_t count, void* rows, std::size_t stride);
  template <Call call>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, std::uint32_t field, PlumbDataType type,
                  const std::uint64_t* ids, std::uint32_t count, const void* rows, std::size_t stride);
  template <Call call, class Query>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, PlumbHitMode mode, const Query* queries,
                  std::size_t stride, std::uint32_t count, PlumbHit* hits, std::uint32_t capacity,
                  std::uint32_t* hit_count);
  PlumbResult run(CallTag<Call::queries_overlaps>, ValidatedWorld&, PlumbWorld*, const PlumbOverlap* overlaps,
                  std::size_t stride, std::uint32_t count, PlumbHit* hits, std::uint32_t capacity,
                  std::uint32_t* hit_count);
  PlumbResult run(CallTag<Call::queries_penetrations>, ValidatedWorld&, PlumbWorld*, const PlumbOverlap* overlaps,
                  std::size_t stride, std::uint32_t count, PlumbPenetration* out, std::uint32_t capacity,
                  std::uint32_t* out_count);
  PlumbResult run(CallTag<Call::closest_bodies>, ValidatedWorld&, PlumbWorld*, PlumbHitMode mode,
                  const PlumbProbe* probes, std::size_t stride, std::uint32_t count, PlumbClosest* out,
                  std::uint32_t capacity, std::uint32_t* out_count);
  PlumbResult run(CallTag<Call::collide_pairs>, ValidatedWorld&, PlumbWorld*, const PlumbPosedPair* pairs,
                  std::size_t stride, std::uint32_t count, PlumbPairResult* results, PlumbPairPoint* points,
                  std::uint32_t capacity, std::uint32_t* point_count);
  PlumbResult run(CallTag<Call::modify_shapes>, ValidatedWorld&, PlumbWorld*, const PlumbShape* shapes,
                  const PlumbShapeDesc* descs, std::size_t stride, std::uint32_t count);
  PlumbResult run(CallTag<Call::exceptions_set>, ValidatedWorld&, PlumbWorld*, const PlumbBodyPair* pairs,
                  std::size_t stride, std::uint32_t count, std::uint32_t touch);
  template <Call call, class Change>
  PlumbResult run(CallTag<call>, ValidatedWorld&, PlumbWorld*, const Change* changes, std::size_t stride,
                  std::uint32_t count);
  PlumbResult run(CallTag<Call::core_user_data>, ValidatedWorld&, PlumbWorld*, PlumbBody id, std::uint64_t* user_data);
  PlumbResult run(CallTag<Call::core_set_gravity>, ValidatedWorld&, PlumbWorld*, const PlumbVec3* gravity);
  PlumbResult run(CallTag<Call::core_step>, ValidatedWorld&, PlumbWorld*, const PlumbStepDesc* desc);
  PlumbResult run(CallTag<Call::core_wait>, ValidatedWorld&, PlumbWorld*, PlumbStepReport* report);
  PlumbResult run(CallTag<Call::settings_get>, ValidatedWorld&, PlumbWorld*, const char* name,
                  PlumbSettingValue* value);
  PlumbResult run(CallTag<Call::settings_set>, ValidatedWorld&, PlumbWorld*, const char* name,
                  const PlumbSettingValue* value);
  template <Call call>
  PlumbResult run_save(PlumbWorld* world, void* data, std::size_t capacity, std::size_t* size);
  PlumbResult run(CallTag<Call::snapshot_save>, ValidatedWorld&, PlumbWorld*, void* data, std::size_t capacity,
                  std::size_t* size);
  PlumbResult run(CallTag<Call::snapshot_save_world>, ValidatedWorld&, PlumbWorld*, void* data, std::size_t capacity,
                  std::size_t* size);
  PlumbResult run(CallTag<Call::snapshot_restore>, ValidatedWorld&, PlumbWorld*, const void* data, std::size_t size);
  PlumbResult run(CallTag<Call::snapshot_hash>, ValidatedWorld&, PlumbWorld*, std::uint64_t* hash);
  PlumbResult run(CallTag<Call::state_borrow>, ValidatedWorld&, PlumbWorld*, const PlumbStateRequest* request,
                  PlumbDLManagedTensor** tensor, PlumbFence* fence);
  PlumbResult run(CallTag<Call::state_rows>, ValidatedWorld&, PlumbWorld*, PlumbBody* ids, std::uint32_t capacity,
                  std::uint32_t* count, std::uint64_t* generation);

  PlumbResult create_world(const PlumbWorldDesc* desc, PlumbWorld** world);
  void destroy_world(PlumbWorld* world);

  void enter(Call call, ValidatedWorld& world, const Visit& visit);
  void judge(Call call, Remarks allowed, ValidatedWorld& world, PlumbWorld* handle, PlumbResult result);
  void check_body_count(ValidatedWorld& world, PlumbWorld* handle, const std::string& when);
  std::shared_ptr<ValidatedWorld> find(PlumbWorld* world);
  void note(FindingKind kind, const std::string& text);

  std::mutex mutex_;
  std::unordered_map<PlumbWorld*, std::shared_ptr<ValidatedWorld>> worlds_;
  std::vector<Finding> findings_;
};

}  // namespace plumb::layers
