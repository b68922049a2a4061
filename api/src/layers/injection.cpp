// The fault injection layer: one chosen call fails.
#include <algorithm>
#include <atomic>

#include "layer_slots.hpp"
#include "plumb/layers.hpp"
#include "plumb/nearest.hpp"

namespace plumb::layers {
namespace {

thread_local bool last_creation_injected = false;

class InjectionLayer : public LayerBase {
 public:
  InjectionLayer(const PlumbBackendTable* next, const Fault& fault)
      : LayerBase(next),
        fault_(fault),
        text_("injected failure of call " + std::to_string(fault.nth) + " of " + fault.call) {}

  template <Call call, class... Args>
  auto on(Args... args) {
    if constexpr (call == Call::core_destroy_world) {
      forget(args...);
      return next<call>()(args...);
    } else {
      PlumbWorld* world = nullptr;
      if constexpr (call != Call::core_create_world) world = std::get<0>(std::tuple(args...));
      const bool fails = fault_.call == name_of(call) && ++calls_ == fault_.nth;
      if (call == Call::core_create_world) {
        last_creation_injected = fails;
      } else if (fails) {
        failed_ = world;
      } else {
        forget(world);
      }
      return fails ? fault_.result : next<call>()(args...);
    }
  }

  const char* error_text(PlumbWorld* world) {
    const bool ours = world == nullptr ? last_creation_injected : failed_ == world;
    return ours ? text_.c_str() : LayerBase::error_text(world);
  }

 private:
  void forget(PlumbWorld* world) { failed_.compare_exchange_strong(world, nullptr); }

  Fault fault_;
  std::string text_;
  std::atomic<std::uint64_t> calls_ = 0;
  std::atomic<PlumbWorld*> failed_ = nullptr;  ///< whose last call was the one that failed
};

}  // namespace

const PlumbBackendTable* inject(const PlumbBackendTable* next, const Fault& fault) {
  std::vector<std::string> known;
  for_each_call([&]<Call call>() {
    if (call != Call::core_destroy_world) known.emplace_back(name_of(call));  // that one has no result
  });
  if (std::find(known.begin(), known.end(), fault.call) == known.end())
    throw Error(PLUMB_E_INVALID_ARGUMENT,
                "no call \"" + fault.call + "\" can be made to fail" + suggestion(fault.call, known));
  if (fault.result >= 0)
    throw Error(PLUMB_E_INVALID_ARGUMENT,
                "an injected result must be below 0, and " + std::to_string(fault.result) + " is not");
  return LayerSlots<InjectionLayer>::open("injection", next, fault);
}

}  // namespace plumb::layers
