// The profile layer: how long every call of the wall takes and what its steps were made of, for a file that trace
// viewers open, or for the profiler that a game has already. It stacks and lives as the layers of layers.hpp do.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "plumb/plumb.h"

namespace plumb::layers {

/// A stretch of time: a call, a step, or a phase of a step.
struct ProfileZone {
  const char* name = nullptr;  ///< "create_bodies", "joints.create"; "solve" of a phase; lives as long as the process
  std::uint64_t world = 0;     ///< the how manieth that was asked for behind this layer, from 1; 0: made elsewhere
  std::uint32_t thread = 0;    ///< the how manieth of the process that called a profiled table, from 1
  std::int64_t start = 0;      ///< ns of std::chrono::steady_clock
  std::int64_t duration = 0;   ///< ns; 0 until the zone has ended
};

/// What wait told of a step.
struct ProfiledStep {
  ProfileZone zone;        ///< "step": from the beginning of step to the end of wait, on the thread that waited
  PlumbStepReport report;  ///< as the host got it; what it left no room for is NaN, 0, or pairs UINT32_MAX
  /// By PlumbPhase; without a name where the backend told no time. A report has durations alone, so phases stand one
  /// after another from the step's start; where that is more than the step, as of an engine that adds up threads, they
  /// are shrunk in proportion.
  std::array<ProfileZone, PLUMB_PHASE_COUNT> phases;
};

/// Who is told. Its functions are called from whatever thread made the call, several at once, and do not throw.
class ProfileSink {
 public:
  virtual ~ProfileSink() = default;
  /// A call begins. Zones of a thread nest: the one that began last ends first.
  virtual void begin(const ProfileZone& zone) noexcept = 0;
  /// The call that began has ended, on the same thread.
  virtual void end(const ProfileZone& zone) noexcept = 0;
  /// A step is done; comes after the end of its wait, unless that failed.
  virtual void stepped(const ProfiledStep& step) noexcept = 0;

 protected:
  ProfileSink() = default;
  ProfileSink(const ProfileSink&) = default;
  ProfileSink& operator=(const ProfileSink&) = default;
};

/// A table that forwards to next and tells sink of every call that has a world, and of its steps. The sink is the
/// caller's and lives until end_profile. Throws Error when all 16 profile layers of the process are in use.
[[nodiscard]] const PlumbBackendTable* profile(const PlumbBackendTable* next, ProfileSink& sink);

/// Likewise, into a file in Chrome's trace event format (JSON), which https://ui.perfetto.dev and chrome://tracing
/// open: calls by thread, steps with their phases by world, and what steps counted. Whenever nobody writes to it the
/// file is whole: a process that dies loses the last 50 ms, and the call that it died in. Throws Error also when the
/// file cannot be written (PLUMB_E_INVALID_ARGUMENT).
[[nodiscard]] const PlumbBackendTable* profile(const PlumbBackendTable* next, const std::string& file);

/// Completes the file, if it is one, and frees the layer: its worlds must be destroyed by then, and the table is not
/// called again. Throws Error when something could not be written, or for a table that profile() did not give.
void end_profile(const PlumbBackendTable* profiled);

}  // namespace plumb::layers
