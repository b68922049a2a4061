// Where a profile is written to a file. Every thread puts its zones into a list of its own; now and then the thread
// whose call just ended writes all lists out.
#pragma once

#include <array>
#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "chrome_events.hpp"
#include "growing_json.hpp"
#include "plumb/profile.hpp"

namespace plumb::layers {

class ProfileFile final : public ProfileSink {
 public:
  /// Throws Error when the file cannot be written.
  ProfileFile(const std::string& path, const PlumbBackendInfo& info);
  ~ProfileFile() override;

  void begin(const ProfileZone& zone) noexcept override;
  void end(const ProfileZone& zone) noexcept override;
  void stepped(const ProfiledStep& step) noexcept override;

  /// Writes what is left. Throws Error when something could not be written.
  void finish();

 private:
  /// What a thread has done that is not written yet.
  struct Lane {
    std::mutex mutex;
    std::vector<ProfileZone> zones;
    bool named = false;  ///< in the file
  };
  /// What the last step of a world counted, by counter; -1: not known.
  using Counts = std::array<std::int64_t, 7>;

  Lane& lane_of(std::uint32_t thread);
  /// Unless another thread is at it.
  void write_if_due(std::int64_t now, std::size_t waiting) noexcept;
  // All that follow under file_mutex_.
  void write();
  void put_calls(std::uint32_t thread, Lane& lane);
  void put_step(const ProfiledStep& step);
  void put_counts(const ProfiledStep& step, Counts& last);

  std::string path_;
  std::int64_t origin_;                  ///< ns, what the file calls 0
  std::uint64_t serial_;                 ///< no other file has it
  std::atomic<std::int64_t> written_;    ///< ns, when last
  std::atomic<std::uint64_t> lost_ = 0;  ///< zones and steps for which there was no memory

  std::mutex lanes_mutex_;
  std::map<std::uint32_t, Lane> lanes_;  ///< by thread
  std::mutex steps_mutex_;
  std::vector<ProfiledStep> steps_;

  std::mutex file_mutex_;  ///< of what follows
  GrowingJson file_;
  std::string text_;
  ChromeEvents events_{text_};
  std::vector<ProfileZone> zones_;               ///< of a lane, on their way out
  std::map<std::uint64_t, Counts> last_counts_;  ///< by world
};

}  // namespace plumb::layers
