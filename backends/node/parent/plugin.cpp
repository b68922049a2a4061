// The backend that this library is: PLUMB_WIRE_NAME, in a child started by PLUMB_WIRE_COMMAND.
#include "library.hpp"
#include "world.hpp"

namespace plumb::wire {
namespace {

class Backend final : public World {
 public:
  explicit Backend(const WorldInit& init) : World(init, manifest(), child_command()) {}
  static const PlumbBackendInfo& info() { return info_or_name(); }
  static std::string unmet_requirement() { return why_not(); }
  static std::span<const PlumbSettingInfo> setting_infos() { return manifest().settings(); }
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
    const backend::Capability answer = manifest().capability(kind, a, b);
    note = answer.note;
    return answer.degree;
  }
};

}  // namespace
}  // namespace plumb::wire

PLUMB_BACKEND(plumb::wire::Backend)
