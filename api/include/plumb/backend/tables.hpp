// Turns a backend's class into the tables of plumb.h. See backend.hpp for how to write one.
#pragma once

#include <concepts>
#include <string_view>

#include "plumb/backend/guarded_extensions.hpp"

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

/// A table entry that calls one member function of the guard.
template <auto Member>
struct Entry;
template <class Guard, class... Arguments, PlumbResult (Guard::*Member)(Arguments...)>
struct Entry<Member> {
  static PlumbResult call(PlumbWorld* world, Arguments... arguments) noexcept {
    if (world == nullptr) return PLUMB_E_INVALID_ARGUMENT;
    auto& guarded = *reinterpret_cast<GuardedExtensions*>(world);
    return guarded.guard([&] { return (guarded.*Member)(arguments...); });
  }
};

/// The extension tables are the same for every backend; which ones it has depends on its class.
inline const PlumbJointsTable kJointsTable = {sizeof(PlumbJointsTable),
                                              0,
                                              &Entry<&GuardedExtensions::create_joints>::call,
                                              &Entry<&GuardedExtensions::destroy_joints>::call,
                                              &Entry<&GuardedExtensions::read_joints>::call,
                                              &Entry<&GuardedExtensions::write_joints>::call};
inline const PlumbQueriesTable kQueriesTable = {sizeof(PlumbQueriesTable), 0, &Entry<&GuardedExtensions::rays>::call,
                                                &Entry<&GuardedExtensions::casts>::call,
                                                &Entry<&GuardedExtensions::overlaps>::call};
inline const PlumbCollideTable kCollideTable = {sizeof(PlumbCollideTable), 0,
                                                &Entry<&GuardedExtensions::collide_pairs>::call};
inline const PlumbDebugTable kDebugTable = {sizeof(PlumbDebugTable),
                                            0,
                                            &Entry<&GuardedExtensions::debug_pairs>::call,
                                            &Entry<&GuardedExtensions::debug_boxes>::call,
                                            &Entry<&GuardedExtensions::debug_axes>::call,
                                            &Entry<&GuardedExtensions::debug_bodies>::call,
                                            &Entry<&GuardedExtensions::debug_constraints>::call};
inline const PlumbSnapshotTable kSnapshotTable = {sizeof(PlumbSnapshotTable), 0, &Entry<&GuardedExtensions::save>::call,
                                                  &Entry<&GuardedExtensions::restore>::call,
                                                  &Entry<&GuardedExtensions::hash>::call};
inline const PlumbExceptionsTable kExceptionsTable = {sizeof(PlumbExceptionsTable), 0,
                                                      &Entry<&GuardedExtensions::set_exceptions>::call,
                                                      &Entry<&GuardedExtensions::list_exceptions>::call};
inline const PlumbStateTable kStateTable = {sizeof(PlumbStateTable), 0, &Entry<&GuardedExtensions::borrow>::call,
                                            &Entry<&GuardedExtensions::state_rows>::call};

template <class World>
class Tables {
 public:
  static const BackendFacts& facts() {
    static const BackendFacts facts = {&World::info(), &World::capability, setting_infos()};
    return facts;
  }

  static const PlumbBackendTable& backend() {
    static const PlumbBackendTable table = {sizeof(PlumbBackendTable),
                                            PLUMB_VERSION,
                                            &info,
                                            &capability,
                                            &extension,
                                            &create_world,
                                            &destroy_world,
                                            &error_text,
                                            &Entry<&GuardedWorld::create_shapes>::call,
                                            &Entry<&GuardedWorld::destroy_shapes>::call,
                                            &Entry<&GuardedWorld::create_bodies>::call,
                                            &Entry<&GuardedWorld::destroy_bodies>::call,
                                            &Entry<&GuardedWorld::list_bodies>::call,
                                            &Entry<&GuardedWorld::user_data>::call,
                                            &Entry<&GuardedWorld::read>::call,
                                            &Entry<&GuardedWorld::write>::call,
                                            &Entry<&GuardedWorld::set_gravity>::call,
                                            &Entry<&GuardedWorld::step>::call,
                                            &Entry<&GuardedWorld::wait>::call,
                                            &Entry<&GuardedWorld::contacts>::call,
                                            &Entry<&GuardedWorld::events>::call};
    return table;
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
    const char* text = "";
    const PlumbDegree degree = kind < PLUMB_CAP_COUNT ? World::capability(kind, a, b, text) : PLUMB_NONE;
    if (note != nullptr) *note = text;
    return degree;
  }

  static const PlumbSettingInfo* describe_setting(std::uint32_t index) {
    return index < facts().settings.size() ? &facts().settings[index] : nullptr;
  }

  static const PlumbSettingsTable& settings_table() {
    static const PlumbSettingsTable table = {
        sizeof(PlumbSettingsTable), static_cast<std::uint32_t>(facts().settings.size()), &describe_setting,
        &Entry<&GuardedExtensions::get_setting>::call, &Entry<&GuardedExtensions::set_setting>::call};
    return table;
  }

  static const void* extension(const char* name) {
    const std::string_view wanted = name == nullptr ? "" : name;
    if (wanted == PLUMB_EXT_STATE) return &kStateTable;
    if (wanted == PLUMB_EXT_SNAPSHOT) return &kSnapshotTable;  // its hash is there for every backend
    if (wanted == PLUMB_EXT_JOINTS && std::derived_from<World, IJoints>) return &kJointsTable;
    if (wanted == PLUMB_EXT_QUERIES && std::derived_from<World, IQueries>) return &kQueriesTable;
    if (wanted == PLUMB_EXT_COLLIDE && std::derived_from<World, ICollide>) return &kCollideTable;
    if (wanted == PLUMB_EXT_DEBUG && std::derived_from<World, IDebug>) return &kDebugTable;
    if (wanted == PLUMB_EXT_EXCEPTIONS && std::derived_from<World, IExceptions>) return &kExceptionsTable;
    if (wanted == PLUMB_EXT_SETTINGS && std::derived_from<World, ISettings>) return &settings_table();
    return nullptr;
  }

  static std::string& creation_error() {
    thread_local std::string text;
    return text;
  }

  static const char* error_text(PlumbWorld* world) {
    return world == nullptr ? creation_error().c_str() : reinterpret_cast<GuardedExtensions*>(world)->error_text();
  }

  static WorldInit checked_init(const PlumbWorldDesc* given) {
    PlumbWorldDesc desc = adopt_descs(given, given == nullptr ? 0 : given->struct_size, 1, "world").front();
    require_finite({"world", 0}, "gravity", desc.gravity);
    require_pointer(desc.settings, desc.setting_count, "settings");
    if (desc.threads == 0) desc.threads = 1;
    for (std::uint32_t index = 0; index < 64; ++index) {
      if (((desc.needs >> index) & 1) == 0) continue;
      const char* note = "";
      if (index >= PLUMB_NEED_COUNT || World::capability(PLUMB_CAP_NEED, index, 0, note) == PLUMB_NONE)
        refuse(PLUMB_E_UNSUPPORTED,
               std::string(facts().info->name) + " lacks " + need_name(index) + (*note == '\0' ? "" : ": ") + note);
    }
    WorldInit init{desc, host, facts().settings, {}};
    for (const PlumbSettingInfo& info : facts().settings) init.values.push_back(info.default_value);
    for (std::uint32_t i = 0; i < desc.setting_count; ++i) {
      const PlumbSettingInfo& info = GuardedExtensions::find_setting(facts(), desc.settings[i].name);
      init.values[static_cast<std::size_t>(&info - facts().settings.data())] =
          GuardedExtensions::checked_setting(info, desc.settings[i].value);
    }
    init.desc.settings = nullptr;
    init.desc.setting_count = 0;
    return init;
  }

  static PlumbResult create_world(const PlumbWorldDesc* desc, PlumbWorld** world) noexcept {
    const auto failed = [](PlumbResult code, const char* text) {
      creation_error() = text;
      return code;
    };
    try {
      require_pointer(world, 1, "world");
      const WorldInit init = checked_init(desc);
      auto made = std::make_unique<World>(init);
      *world = reinterpret_cast<PlumbWorld*>(new GuardedExtensions(facts(), init, std::move(made)));
      return PLUMB_OK;
    } catch (const Error& error) {
      return failed(error.code(), error.what());
    } catch (const std::bad_alloc&) {
      return failed(PLUMB_E_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
      return failed(PLUMB_E_INTERNAL, error.what());
    } catch (...) {
      return failed(PLUMB_E_INTERNAL, "the backend threw something that is not a std::exception");
    }
  }

  static void destroy_world(PlumbWorld* world) {
    try {
      delete reinterpret_cast<GuardedExtensions*>(world);
    } catch (...) {  // a destructor that throws has nowhere to report to
    }
  }
};

/// Negotiates: answers this side's version when the host's range holds it, and says who is too old otherwise.
template <class World>
PlumbResult open(const PlumbOpenRequest* request, PlumbOpenReply* reply) noexcept {
  if (request == nullptr || reply == nullptr || reply->struct_size < sizeof(PlumbOpenReply))
    return PLUMB_E_INVALID_ARGUMENT;
  reply->table = nullptr;
  reply->message[0] = '\0';
  const auto answer = [&](PlumbResult result, const char* format, auto... values) {
    std::snprintf(reply->message, sizeof reply->message, format, values...);
    return result;
  };
  try {
    const PlumbBackendInfo& info = World::info();
    const auto major = PLUMB_VERSION_MAJOR(PLUMB_VERSION), minor = PLUMB_VERSION_MINOR(PLUMB_VERSION);
    if (PLUMB_VERSION < request->min_version)
      return answer(PLUMB_E_VERSION,
                    "backend %s speaks interface %u.%u and the host asks for at least %u.%u; get a newer %s", info.name,
                    major, minor, PLUMB_VERSION_MAJOR(request->min_version), PLUMB_VERSION_MINOR(request->min_version),
                    info.name);
    if (PLUMB_VERSION > request->max_version)
      return answer(PLUMB_E_VERSION, "backend %s speaks interface %u.%u and the host at most %u.%u; get a newer host",
                    info.name, major, minor, PLUMB_VERSION_MAJOR(request->max_version),
                    PLUMB_VERSION_MINOR(request->max_version));
    if constexpr (HasRequirement<World>) {
      const std::string why = World::unmet_requirement();
      if (!why.empty()) return answer(PLUMB_E_UNSUPPORTED, "%s", why.c_str());
    }
    if (Tables<World>::host == nullptr) Tables<World>::host = request->host;
    reply->version = PLUMB_VERSION;
    reply->table = &Tables<World>::backend();
    return PLUMB_OK;
  } catch (const std::exception& error) {
    return answer(PLUMB_E_INTERNAL, "%s", error.what());
  } catch (...) {
    return answer(PLUMB_E_INTERNAL, "the backend threw something that is not a std::exception");
  }
}

}  // namespace plumb::backend
