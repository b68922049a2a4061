// The tables of plumb.h over the guard, and how a backend is opened and its worlds are made.
#include "plumb/backend/tables.hpp"

#include <cstdio>
#include <memory>
#include <string_view>

#include "guarded_extensions.hpp"

namespace plumb::backend {

namespace {

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
const PlumbJointsTable kJointsTable = {sizeof(PlumbJointsTable),
                                       0,
                                       &Entry<&GuardedExtensions::create_joints>::call,
                                       &Entry<&GuardedExtensions::destroy_joints>::call,
                                       &Entry<&GuardedExtensions::read_joints>::call,
                                       &Entry<&GuardedExtensions::write_joints>::call};
const PlumbQueriesTable kQueriesTable = {sizeof(PlumbQueriesTable), 0, &Entry<&GuardedExtensions::rays>::call,
                                         &Entry<&GuardedExtensions::casts>::call,
                                         &Entry<&GuardedExtensions::overlaps>::call};
const PlumbCollideTable kCollideTable = {sizeof(PlumbCollideTable), 0, &Entry<&GuardedExtensions::collide_pairs>::call};
const PlumbDebugTable kDebugTable = {sizeof(PlumbDebugTable),
                                     0,
                                     &Entry<&GuardedExtensions::debug_pairs>::call,
                                     &Entry<&GuardedExtensions::debug_boxes>::call,
                                     &Entry<&GuardedExtensions::debug_axes>::call,
                                     &Entry<&GuardedExtensions::debug_bodies>::call,
                                     &Entry<&GuardedExtensions::debug_constraints>::call};
const PlumbSnapshotTable kSnapshotTable = {sizeof(PlumbSnapshotTable), 0, &Entry<&GuardedExtensions::save>::call,
                                           &Entry<&GuardedExtensions::restore>::call,
                                           &Entry<&GuardedExtensions::hash>::call};
const PlumbExceptionsTable kExceptionsTable = {sizeof(PlumbExceptionsTable), 0,
                                               &Entry<&GuardedExtensions::set_exceptions>::call,
                                               &Entry<&GuardedExtensions::list_exceptions>::call};
const PlumbStateTable kStateTable = {sizeof(PlumbStateTable), 0, &Entry<&GuardedExtensions::borrow>::call,
                                     &Entry<&GuardedExtensions::state_rows>::call};

std::string& creation_error() {
  thread_local std::string text;
  return text;
}

const char* error_text(PlumbWorld* world) {
  return world == nullptr ? creation_error().c_str() : reinterpret_cast<GuardedExtensions*>(world)->error_text();
}

void destroy_world(PlumbWorld* world) {
  try {
    delete reinterpret_cast<GuardedExtensions*>(world);
  } catch (...) {  // a destructor that throws has nowhere to report to
  }
}

WorldInit checked_init(const BackendFacts& facts, const PlumbHost* host, const PlumbWorldDesc* given) {
  PlumbWorldDesc desc = adopt_descs(given, given == nullptr ? 0 : given->struct_size, 1, "world").front();
  require_finite({"world", 0}, "gravity", desc.gravity);
  require_pointer(desc.settings, desc.setting_count, "settings");
  if (desc.threads == 0) desc.threads = 1;
  for (std::uint32_t index = 0; index < 64; ++index) {
    if (((desc.needs >> index) & 1) == 0) continue;
    const char* note = "";
    if (index >= PLUMB_NEED_COUNT || facts.capability(PLUMB_CAP_NEED, index, 0, note) == PLUMB_NONE)
      refuse(PLUMB_E_UNSUPPORTED,
             std::string(facts.info->name) + " lacks " + need_name(index) + (*note == '\0' ? "" : ": ") + note);
  }
  WorldInit init{desc, host, facts.settings, {}};
  for (const PlumbSettingInfo& info : facts.settings) init.values.push_back(info.default_value);
  for (std::uint32_t i = 0; i < desc.setting_count; ++i) {
    const PlumbSettingInfo& info = GuardedExtensions::find_setting(facts, desc.settings[i].name);
    init.values[static_cast<std::size_t>(&info - facts.settings.data())] =
        GuardedExtensions::checked_setting(info, desc.settings[i].value);
  }
  init.desc.settings = nullptr;
  init.desc.setting_count = 0;
  return init;
}

}  // namespace

PlumbBackendTable backend_table(const ClassEntries& entries) {
  return {sizeof(PlumbBackendTable),
          PLUMB_VERSION,
          entries.info,
          entries.capability,
          entries.extension,
          entries.create_world,
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
}

PlumbSettingsTable settings_table(const BackendFacts& facts, decltype(PlumbSettingsTable::describe) describe) {
  return {sizeof(PlumbSettingsTable), static_cast<std::uint32_t>(facts.settings.size()), describe,
          &Entry<&GuardedExtensions::get_setting>::call, &Entry<&GuardedExtensions::set_setting>::call};
}

const void* extension_table(const BackendFacts& facts, const PlumbSettingsTable& settings, const char* name) {
  const std::string_view wanted = name == nullptr ? "" : name;
  if (wanted == PLUMB_EXT_STATE) return &kStateTable;
  if (wanted == PLUMB_EXT_SNAPSHOT) return &kSnapshotTable;  // its hash is there for every backend
  if (wanted == PLUMB_EXT_JOINTS && facts.has_joints) return &kJointsTable;
  if (wanted == PLUMB_EXT_QUERIES && facts.has_queries) return &kQueriesTable;
  if (wanted == PLUMB_EXT_COLLIDE && facts.has_collide) return &kCollideTable;
  if (wanted == PLUMB_EXT_DEBUG && facts.has_debug) return &kDebugTable;
  if (wanted == PLUMB_EXT_EXCEPTIONS && facts.has_exceptions) return &kExceptionsTable;
  if (wanted == PLUMB_EXT_SETTINGS && facts.has_settings) return &settings;
  return nullptr;
}

PlumbDegree answer_capability(const BackendFacts& facts, PlumbCapability kind, std::uint32_t a, std::uint32_t b,
                              const char** note) {
  const char* text = "";
  const PlumbDegree degree = kind < PLUMB_CAP_COUNT ? facts.capability(kind, a, b, text) : PLUMB_NONE;
  if (note != nullptr) *note = text;
  return degree;
}

PlumbResult create_guarded_world(const BackendFacts& facts, const PlumbHost* host, const PlumbWorldDesc* desc,
                                 PlumbWorld** world) noexcept {
  const auto failed = [](PlumbResult code, const char* text) {
    creation_error() = text;
    return code;
  };
  try {
    require_pointer(world, 1, "world");
    const WorldInit init = checked_init(facts, host, desc);
    std::unique_ptr<IPhysicsWorld> made(facts.make(init));
    *world = reinterpret_cast<PlumbWorld*>(new GuardedExtensions(facts, init, std::move(made)));
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

PlumbResult answer_opening(const Opening& opening, const PlumbOpenRequest* request, PlumbOpenReply* reply) noexcept {
  if (request == nullptr || reply == nullptr || reply->struct_size < sizeof(PlumbOpenReply))
    return PLUMB_E_INVALID_ARGUMENT;
  reply->table = nullptr;
  reply->message[0] = '\0';
  const auto answer = [&](PlumbResult result, const char* format, auto... values) {
    std::snprintf(reply->message, sizeof reply->message, format, values...);
    return result;
  };
  try {
    const PlumbBackendInfo& info = opening.info();
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
    if (const std::string why = opening.unmet_requirement(); !why.empty())
      return answer(PLUMB_E_UNSUPPORTED, "%s", why.c_str());
    if (opening.host == nullptr) opening.host = request->host;
    reply->version = PLUMB_VERSION;
    reply->table = &opening.table();
    return PLUMB_OK;
  } catch (const std::exception& error) {
    return answer(PLUMB_E_INTERNAL, "%s", error.what());
  } catch (...) {
    return answer(PLUMB_E_INTERNAL, "%s", "the backend threw something that is not a std::exception");
  }
}

}  // namespace plumb::backend
