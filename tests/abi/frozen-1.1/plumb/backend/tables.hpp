// Turns a backend's class into the tables of plumb.h: what depends on the class. The guard behind it is compiled once,
// in the library plumb::backend. See backend.hpp for how to write one.
#pragma once

#include <concepts>
#include <span>
#include <string>

#include "plumb/backend/world_init.hpp"

namespace plumb::backend {

template <class World>
concept HasSettings = requires {
  { World::setting_infos() } -> std::convertible_to<std::span<const PlumbSettingInfo>>;
};

/// A class may say in a sentence why it cannot run on this machine (no device, no driver); "" where it can. The backend
/// is then refused when it is opened, and steps aside.
template <class World>
concept HasRequirement = requires {
  { World::unmet_requirement() } -> std::convertible_to<std::string>;
};

/// What the guard knows of a backend's class.
struct BackendFacts {
  const PlumbBackendInfo* info;
  PlumbDegree (*capability)(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
  std::span<const PlumbSettingInfo> settings;
  IPhysicsWorld* (*make)(const WorldInit& init);  ///< new World(init)
  bool has_joints, has_queries, has_collide, has_debug, has_exceptions, has_settings;
};

/// The entries of PlumbBackendTable that depend on the class, for they are given nothing that would name it.
struct ClassEntries {
  decltype(PlumbBackendTable::info) info;
  decltype(PlumbBackendTable::capability) capability;
  decltype(PlumbBackendTable::extension) extension;
  decltype(PlumbBackendTable::create_world) create_world;
};
[[nodiscard]] PlumbBackendTable backend_table(const ClassEntries& entries);

[[nodiscard]] PlumbSettingsTable settings_table(const BackendFacts& facts,
                                                decltype(PlumbSettingsTable::describe) describe);
/// The table of an extension's name; null for one that the class lacks.
[[nodiscard]] const void* extension_table(const BackendFacts& facts, const PlumbSettingsTable& settings,
                                          const char* name);
PlumbDegree answer_capability(const BackendFacts& facts, PlumbCapability kind, std::uint32_t a, std::uint32_t b,
                              const char** note);
PlumbResult create_guarded_world(const BackendFacts& facts, const PlumbHost* host, const PlumbWorldDesc* desc,
                                 PlumbWorld** world) noexcept;

/// What negotiation asks a class; each may throw.
struct Opening {
  const PlumbBackendInfo& (*info)();
  std::string (*unmet_requirement)();
  const PlumbBackendTable& (*table)();
  const PlumbHost*& host;
};
/// Answers this side's version when the host's range holds it, and says who is too old otherwise.
PlumbResult answer_opening(const Opening& opening, const PlumbOpenRequest* request, PlumbOpenReply* reply) noexcept;

template <class World>
class Tables {
 public:
  static const BackendFacts& facts() {
    static const BackendFacts facts = {&World::info(),
                                       &World::capability,
                                       setting_infos(),
                                       [](const WorldInit& init) -> IPhysicsWorld* { return new World(init); },
                                       std::derived_from<World, IJoints>,
                                       std::derived_from<World, IQueries>,
                                       std::derived_from<World, ICollide>,
                                       std::derived_from<World, IDebug>,
                                       std::derived_from<World, IExceptions>,
                                       std::derived_from<World, ISettings>};
    return facts;
  }

  static const PlumbBackendTable& backend() {
    static const PlumbBackendTable table = backend_table({&info, &capability, &extension, &create_world});
    return table;
  }

  static std::string unmet_requirement() {
    if constexpr (HasRequirement<World>)
      return World::unmet_requirement();
    else
      return {};
  }

  /// What the process lent; kept from the first opening on.
  inline static const PlumbHost* host = nullptr;

 private:
  static std::span<const PlumbSettingInfo> setting_infos() {
    if constexpr (HasSettings<World>)
      return World::setting_infos();
    else
      return {};
  }

  static const PlumbBackendInfo* info() { return facts().info; }
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char** note) {
    return answer_capability(facts(), kind, a, b, note);
  }
  static const PlumbSettingInfo* describe_setting(std::uint32_t index) {
    return index < facts().settings.size() ? &facts().settings[index] : nullptr;
  }
  static const void* extension(const char* name) {
    static const PlumbSettingsTable settings = settings_table(facts(), &describe_setting);
    return extension_table(facts(), settings, name);
  }
  static PlumbResult create_world(const PlumbWorldDesc* desc, PlumbWorld** world) noexcept {
    return create_guarded_world(facts(), host, desc, world);
  }
};

template <class World>
PlumbResult open(const PlumbOpenRequest* request, PlumbOpenReply* reply) noexcept {
  const Opening opening = {&World::info, &Tables<World>::unmet_requirement, &Tables<World>::backend,
                           Tables<World>::host};
  return answer_opening(opening, request, reply);
}

}  // namespace plumb::backend
