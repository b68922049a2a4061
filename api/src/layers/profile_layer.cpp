// The profile layer: forwards every call between two looks at the clock.
#include <algorithm>
#include <cmath>
#include <limits>
#include <shared_mutex>
#include <unordered_map>

#include "layer_slots.hpp"
#include "plumb/profile.hpp"
#include "profile_clock.hpp"
#include "profile_file.hpp"
#include "profile_phases.hpp"

namespace plumb::layers {
namespace {

struct ProfiledWorld {
  std::uint64_t number;
  std::int64_t step_start = 0;  ///< ns; 0 where none has begun
};

/// Tells the sink of a call as long as it lasts.
class ProfiledCall {
 public:
  ProfiledCall(ProfileSink& sink, const char* name, std::uint64_t world) : sink_(sink) {
    zone_.name = name;
    zone_.world = world;
    zone_.thread = profile_thread();
    zone_.start = profile_now();
    sink_.begin(zone_);
  }
  ~ProfiledCall() {
    if (!ended_) end();
  }
  ProfiledCall(const ProfiledCall&) = delete;
  ProfiledCall& operator=(const ProfiledCall&) = delete;
  /// Sooner than with the object; gives when, ns.
  std::int64_t end() {
    ended_ = true;
    zone_.duration = profile_now() - zone_.start;
    sink_.end(zone_);
    return zone_.start + zone_.duration;
  }
  [[nodiscard]] std::int64_t start() const { return zone_.start; }

 private:
  ProfileSink& sink_;
  ProfileZone zone_;
  bool ended_ = false;
};

PlumbStepReport unknown_report() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  report.pairs = UINT32_MAX;
  report.residual = unknown;
  std::fill(std::begin(report.phase_seconds), std::end(report.phase_seconds), unknown);
  return report;
}

class ProfileLayer : public LayerBase {
 public:
  ProfileLayer(const PlumbBackendTable* next, ProfileSink& sink) : LayerBase(next), sink_(sink) { ++epoch_; }
  ProfileLayer(const PlumbBackendTable* next, const std::string& file)
      : LayerBase(next), file_(std::make_unique<ProfileFile>(file, *next->info())), sink_(*file_) {
    ++epoch_;
  }

  template <Call call, class... Args>
  auto on(Args... args) {
    if constexpr (call == Call::core_create_world) {
      return create_world(args...);
    } else if constexpr (call == Call::core_destroy_world) {
      return destroy_world(args...);
    } else if constexpr (call == Call::core_step) {
      return step(args...);
    } else if constexpr (call == Call::core_wait) {
      return wait(args...);
    } else {
      const ProfiledCall timed(sink_, name<call>(), number_of(std::get<0>(std::tuple(args...))));
      return next<call>()(args...);
    }
  }

  void finish() {
    if (file_) file_->finish();
  }

 private:
  template <Call call>
  static constexpr const char* name() {
    return CallTraits<call>::name.data();
  }

  PlumbResult create_world(const PlumbWorldDesc* desc, PlumbWorld** world) {
    const std::uint64_t number = ++world_count_;
    ProfiledCall timed(sink_, name<Call::core_create_world>(), number);
    const PlumbResult result = next<Call::core_create_world>()(desc, world);
    timed.end();
    if (result < 0) return result;
    try {
      const std::lock_guard lock(mutex_);
      worlds_[*world] = {number};
    } catch (const std::bad_alloc&) {
      // The world is there, and is one that was made elsewhere.
    }
    ++epoch_;
    return result;
  }

  void destroy_world(PlumbWorld* world) {
    const ProfiledCall timed(sink_, name<Call::core_destroy_world>(), number_of(world));
    {
      const std::lock_guard lock(mutex_);  // before its address can be another's
      worlds_.erase(world);
    }
    ++epoch_;
    next<Call::core_destroy_world>()(world);
  }

  PlumbResult step(PlumbWorld* world, const PlumbStepDesc* desc) {
    ProfiledWorld* profiled = find(world);
    const ProfiledCall timed(sink_, name<Call::core_step>(), profiled == nullptr ? 0 : profiled->number);
    const PlumbResult result = next<Call::core_step>()(world, desc);
    if (profiled != nullptr && result >= 0) profiled->step_start = timed.start();
    return result;
  }

  PlumbResult wait(PlumbWorld* world, PlumbStepReport* report) {
    ProfiledWorld* profiled = find(world);
    PlumbStepReport ours = unknown_report();
    ProfiledCall timed(sink_, name<Call::core_wait>(), profiled == nullptr ? 0 : profiled->number);
    const PlumbResult result = next<Call::core_wait>()(world, report != nullptr ? report : &ours);
    const std::int64_t end = timed.end();
    const std::int64_t start = profiled == nullptr ? 0 : std::exchange(profiled->step_start, 0);
    if (start == 0 || result < 0) return result;
    if (report != nullptr) std::memcpy(&ours, report, std::min<std::size_t>(report->struct_size, sizeof ours));
    ProfiledStep step{{"step", profiled->number, profile_thread(), start, end - start}, ours, {}};
    lay_out_phases(step);
    sink_.stepped(step);
    return result;
  }

  std::uint64_t number_of(PlumbWorld* world) {
    const ProfiledWorld* profiled = find(world);
    return profiled == nullptr ? 0 : profiled->number;
  }

  /// Null for a world that was made elsewhere. Each thread remembers which it called last, so that queries of many
  /// threads on a world do not meet at the lock.
  ProfiledWorld* find(PlumbWorld* world) {
    struct Last {
      std::uint64_t epoch = 0;
      const ProfileLayer* layer = nullptr;
      PlumbWorld* world = nullptr;
      ProfiledWorld* profiled = nullptr;
    };
    static thread_local Last last;
    const std::uint64_t epoch = epoch_;
    if (last.epoch != epoch || last.layer != this || last.world != world) {
      const std::shared_lock lock(mutex_);
      const auto found = worlds_.find(world);
      last = {epoch, this, world, found == worlds_.end() ? nullptr : &found->second};
    }
    return last.profiled;
  }

  std::unique_ptr<ProfileFile> file_;  ///< null where the sink is the caller's
  ProfileSink& sink_;
  std::shared_mutex mutex_;
  std::unordered_map<PlumbWorld*, ProfiledWorld> worlds_;
  std::atomic<std::uint64_t> world_count_ = 0;
  /// Another one when a layer or a world of any came or went: what threads remember is old by then.
  static inline std::atomic<std::uint64_t> epoch_ = 0;
};

}  // namespace

const PlumbBackendTable* profile(const PlumbBackendTable* next, ProfileSink& sink) {
  return LayerSlots<ProfileLayer>::open("profile", next, sink);
}

const PlumbBackendTable* profile(const PlumbBackendTable* next, const std::string& file) {
  return LayerSlots<ProfileLayer>::open("profile", next, file);
}

void end_profile(const PlumbBackendTable* profiled) { LayerSlots<ProfileLayer>::finish("profile", profiled); }

}  // namespace plumb::layers
