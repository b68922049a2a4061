// What a child says of its engine: who it is, what it has, and its settings. JSON, as WIRE.md describes it.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "plumb/backend/usual_capability.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::wire {

/// "Of such questions the answer is": -1 stands for any argument.
struct Rule {
  PlumbCapability kind;
  std::vector<int> first, second;
  PlumbDegree degree;
  std::string note;
};

class Manifest {
 public:
  /// Throws PLUMB_E_VERSION for another wire, PLUMB_E_CORRUPT for what is no manifest; both name what is wrong.
  Manifest(const std::string& json, const std::string& backend_name);
  Manifest(const Manifest&) = delete;
  Manifest& operator=(const Manifest&) = delete;

  [[nodiscard]] const PlumbBackendInfo& info() const { return info_; }
  [[nodiscard]] std::span<const PlumbSettingInfo> settings() const { return settings_; }
  /// Why the engine cannot run here, or "".
  [[nodiscard]] const std::string& unmet() const { return unmet_; }
  /// The last rule that fits, as far as the question means something; what the parent does itself it answers itself.
  [[nodiscard]] backend::Capability capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const;
  /// Whether the child takes such writes itself, which the parent would else make of velocities, poses and forces.
  [[nodiscard]] bool takes(PlumbField field) const { return (takes_ >> field & 1) != 0; }

 private:
  const char* keep(std::string text);
  /// The last that fits; null: none does.
  [[nodiscard]] const Rule* rule_for(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] backend::Capability of_child(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const;
  void add_setting(const PlumbSettingInfo& setting) { settings_.push_back(setting); }

  std::deque<std::string> texts_;  ///< never moved: the tables point into them
  std::deque<std::vector<const char*>> words_;
  PlumbBackendInfo info_{};
  std::vector<PlumbSettingInfo> settings_;
  std::vector<Rule> rules_;
  std::uint32_t takes_ = 0;  ///< bits by field
  std::string unmet_;
};

/// The setting that every backend of this kind has: seconds that one call may take.
inline constexpr const char* kDeadlineSetting = "call_deadline";

}  // namespace plumb::wire
