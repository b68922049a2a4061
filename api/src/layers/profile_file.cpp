#include "profile_file.hpp"

#include <cerrno>
#include <cstring>

#include "plumb/physics_world.hpp"
#include "profile_clock.hpp"
#include "profile_phases.hpp"

namespace plumb::layers {
namespace {

constexpr std::int64_t longest_wait = 50'000'000;  // ns, of what a process that dies may lose
constexpr std::size_t most_waiting = 4096;         // zones of a thread
constexpr int calls_process = 1, steps_process = 2;

std::atomic<std::uint64_t> file_count = 0;

std::string head_of(const PlumbBackendInfo& info) {
  std::string head = R"({"displayTimeUnit":"ns","otherData":{)";
  const std::pair<const char*, const char*> facts[] = {
      {"backend", info.name}, {"version", info.version}, {"build", info.build}, {"device", info.device}};
  for (const auto& [name, text] : facts) {
    if (name != facts[0].first) head += ',';
    append_quoted(head, name);
    head += ':';
    append_quoted(head, text);
  }
  return head + R"(},"traceEvents":[)";
}

}  // namespace

ProfileFile::ProfileFile(const std::string& path, const PlumbBackendInfo& info)
    : path_(path),
      origin_(profile_now()),
      serial_(++file_count),
      written_(origin_),
      file_(path, head_of(info), "\n]}\n") {
  if (!file_.good())
    throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write the profile " + path + ": " + std::strerror(errno));
  events_.name_row({calls_process, 0}, "process_name", std::string("calls of ") + info.name);
  events_.name_row({steps_process, 0}, "process_name", std::string("steps of ") + info.name);
  file_.append(text_);
}

ProfileFile::~ProfileFile() {
  const std::lock_guard lock(file_mutex_);
  try {
    write();
  } catch (...) {
    // finish() is who tells.
  }
}

void ProfileFile::begin(const ProfileZone&) noexcept {}

void ProfileFile::end(const ProfileZone& zone) noexcept {
  std::size_t waiting = 0;
  try {
    Lane& lane = lane_of(zone.thread);
    const std::lock_guard lock(lane.mutex);
    lane.zones.push_back(zone);
    waiting = lane.zones.size();
  } catch (...) {
    ++lost_;
  }
  write_if_due(zone.start + zone.duration, waiting);
}

void ProfileFile::stepped(const ProfiledStep& step) noexcept {
  try {
    const std::lock_guard lock(steps_mutex_);
    steps_.push_back(step);
  } catch (...) {
    ++lost_;
  }
}

void ProfileFile::finish() {
  const std::lock_guard lock(file_mutex_);
  write();
  file_.close();
  if (!file_.good() || lost_ != 0)
    throw Error(PLUMB_E_INVALID_ARGUMENT,
                "the profile " + path_ + " could not be written whole; is the disk or the memory full?");
}

ProfileFile::Lane& ProfileFile::lane_of(std::uint32_t thread) {
  static thread_local std::pair<std::uint64_t, Lane*> last{};
  if (last.first != serial_) {
    const std::lock_guard lock(lanes_mutex_);
    last = {serial_, &lanes_[thread]};
  }
  return *last.second;
}

void ProfileFile::write_if_due(std::int64_t now, std::size_t waiting) noexcept {
  if (waiting < most_waiting && now - written_.load(std::memory_order_relaxed) < longest_wait) return;
  const std::unique_lock lock(file_mutex_, std::try_to_lock);
  if (!lock) return;
  try {
    write();
  } catch (...) {
    ++lost_;
    text_.clear();  // half an event would make the file unreadable
    zones_.clear();
  }
}

void ProfileFile::write() {
  std::vector<std::pair<std::uint32_t, Lane*>> lanes;
  {
    const std::lock_guard lock(lanes_mutex_);
    for (auto& [thread, lane] : lanes_) lanes.emplace_back(thread, &lane);
  }
  for (const auto& [thread, lane] : lanes) put_calls(thread, *lane);
  std::vector<ProfiledStep> steps;
  {
    const std::lock_guard lock(steps_mutex_);
    steps.swap(steps_);
  }
  for (const ProfiledStep& step : steps) put_step(step);
  file_.append(text_);
  written_ = profile_now();
}

void ProfileFile::put_calls(std::uint32_t thread, Lane& lane) {
  {
    const std::lock_guard lock(lane.mutex);
    zones_.swap(lane.zones);
  }
  const ChromeEvents::Row row{calls_process, thread};
  if (!lane.named) events_.name_row(row, "thread_name", "thread " + std::to_string(thread));
  lane.named = true;
  for (const ProfileZone& zone : zones_) {
    events_.zone(row, zone.name, zone.start - origin_, zone.duration);
    events_.argument("world", static_cast<std::int64_t>(zone.world));
    events_.close();
  }
  zones_.clear();
}

void ProfileFile::put_step(const ProfiledStep& step) {
  const ChromeEvents::Row row{steps_process, step.zone.world};
  const auto [counts, is_new] = last_counts_.try_emplace(step.zone.world);
  if (is_new) {
    counts->second.fill(-1);
    events_.name_row(row, "thread_name", "world " + std::to_string(step.zone.world));
  }
  events_.zone(row, step.zone.name, step.zone.start - origin_, step.zone.duration);
  events_.argument("step", static_cast<std::int64_t>(step.report.step));
  events_.argument("threads", step.report.threads);
  events_.argument("remarks", step.report.remarks);
  if (std::isfinite(step.report.residual)) events_.argument("residual", step.report.residual);
  events_.close();
  for (std::size_t phase = 0; phase < step.phases.size(); ++phase) {
    const ProfileZone& zone = step.phases[phase];
    if (zone.name == nullptr || step.report.phase_seconds[phase] == 0) continue;
    events_.zone(row, zone.name, zone.start - origin_, zone.duration);
    events_.argument("told_us", std::round(1e9 * step.report.phase_seconds[phase]) / 1e3);  // to the ns
    events_.close();
  }
  put_counts(step, counts->second);
}

// A viewer draws a counter on until it changes, so that is when it is written.
void ProfileFile::put_counts(const ProfiledStep& step, Counts& last) {
  static constexpr std::pair<const char*, std::uint32_t PlumbStepReport::*> counters[] = {
      {"bodies", &PlumbStepReport::bodies},      {"awake", &PlumbStepReport::awake},
      {"pairs", &PlumbStepReport::pairs},        {"contacts", &PlumbStepReport::contacts},
      {"joints", &PlumbStepReport::joints},      {"dropped", &PlumbStepReport::dropped},
      {"nonfinite", &PlumbStepReport::nonfinite}};
  static_assert(std::size(counters) == std::tuple_size_v<Counts>);
  for (std::size_t i = 0; i < last.size(); ++i) {
    const auto& [name, member] = counters[i];
    const std::int64_t count = step.report.*member == UINT32_MAX ? -1 : std::int64_t{step.report.*member};
    if (count == last[i]) continue;
    last[i] = count;
    if (count < 0) continue;
    events_.counter({steps_process, step.zone.world}, "world " + std::to_string(step.zone.world) + " " + name,
                    step.zone.start + step.zone.duration - origin_, count);
  }
}

}  // namespace plumb::layers
