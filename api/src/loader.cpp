#include "plumb/loader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>

#include "host_world.hpp"
#include "library.hpp"
#include "plumb/nearest.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "plumb-";
using library::kSuffix;

/// Libraries are never unloaded, so what is open stays open; one entry a file.
struct OpenBackends {
  std::mutex mutex;
  std::map<std::string, const PlumbBackendTable*> by_file;
};

OpenBackends& open_backends() {
  static OpenBackends backends;
  return backends;
}

std::string version_text(std::uint32_t version) {
  return std::to_string(PLUMB_VERSION_MAJOR(version)) + "." + std::to_string(PLUMB_VERSION_MINOR(version));
}

bool is_file_name(const std::string& name) { return fs::path(name).has_parent_path() || name.ends_with(kSuffix); }

std::string file_of(const std::string& name_or_file) {
  if (is_file_name(name_or_file)) {
    std::error_code error;
    const fs::path file = fs::canonical(name_or_file, error);
    if (error)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "backend file " + name_or_file + " cannot be found; check the path");
    return file.string();
  }
  const std::vector<FoundBackend> found = find_backends();
  for (const FoundBackend& backend : found)
    if (backend.name == name_or_file) return fs::canonical(backend.file).string();
  std::string text = "no backend is called \"" + name_or_file + "\"";
  std::vector<std::string> names;
  for (const FoundBackend& backend : found) names.push_back(backend.name);
  text += names.empty() ? "; none was found at all: set PLUMB_BACKEND_PATH to the folder that holds plumb-*" +
                              std::string(kSuffix)
                        : suggestion(name_or_file, names);
  throw Error(PLUMB_E_INVALID_ARGUMENT, text);
}

/// Everything that is called without asking must be there.
void require_whole(const PlumbBackendTable& table, const std::string& name) {
  const bool whole =
      table.struct_size >= sizeof(PlumbBackendTable) && table.info != nullptr && table.capability != nullptr &&
      table.extension != nullptr && table.create_world != nullptr && table.destroy_world != nullptr &&
      table.error_text != nullptr && table.create_shapes != nullptr && table.destroy_shapes != nullptr &&
      table.create_bodies != nullptr && table.destroy_bodies != nullptr && table.list_bodies != nullptr &&
      table.user_data != nullptr && table.read != nullptr && table.write != nullptr && table.set_gravity != nullptr &&
      table.step != nullptr && table.wait != nullptr && table.contacts != nullptr && table.events != nullptr;
  if (!whole)
    throw Error(PLUMB_E_VERSION, "backend " + name + " says that it speaks interface " + version_text(table.version) +
                                     ", but its table lacks functions of it; build it anew against this plumb.h");
  const PlumbBackendInfo* info = table.info();
  if (info == nullptr || info->struct_size < sizeof(PlumbBackendInfo) || info->name == nullptr ||
      info->version == nullptr || info->build == nullptr || info->description == nullptr || info->device == nullptr ||
      info->exclusion_group == nullptr)
    throw Error(PLUMB_E_VERSION,
                "backend " + name + " does not fill PlumbBackendInfo; build it anew against this plumb.h");
}

}  // namespace

Backend::Backend(const PlumbBackendTable* table, std::string file) : table_(table), file_(std::move(file)) {}

PlumbDegree Backend::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const {
  return table_->capability(kind, a, b, nullptr);
}

PlumbNeeds Backend::offered(PlumbNeeds wanted) const {
  PlumbNeeds offers = 0;
  for (std::uint32_t i = 0; i < PLUMB_NEED_COUNT; ++i)
    if ((wanted >> i & 1U) != 0 && capability(PLUMB_CAP_NEED, i) != PLUMB_NONE) offers |= PlumbNeeds{1} << i;
  return offers;
}

std::string Backend::capability_note(PlumbCapability kind, std::uint32_t a, std::uint32_t b) const {
  const char* note = "";
  table_->capability(kind, a, b, &note);
  return note;
}

std::vector<const PlumbSettingInfo*> Backend::settings() const {
  std::vector<const PlumbSettingInfo*> infos;
  const auto* settings = static_cast<const PlumbSettingsTable*>(table_->extension(PLUMB_EXT_SETTINGS));
  for (std::uint32_t i = 0; settings != nullptr && i < settings->count; ++i) infos.push_back(settings->describe(i));
  return infos;
}

std::unique_ptr<IPhysicsWorld> Backend::create_world(const PlumbWorldDesc& desc) const {
  PlumbWorld* world = nullptr;
  const PlumbResult result = table_->create_world(&desc, &world);
  if (result < 0) throw Error(result, table_->error_text(nullptr));
  return adopt_world(*table_, world);
}

std::vector<std::byte> Backend::cook(const PlumbShapeDesc& desc) const {
  const auto* cooking = static_cast<const PlumbCookingTable*>(table_->extension(PLUMB_EXT_COOKING));
  if (cooking == nullptr)
    throw Error(PLUMB_E_UNSUPPORTED, std::string("backend ") + info().name +
                                         " has no " PLUMB_EXT_COOKING "; create shapes from their descriptors");
  PlumbCooked cooked{};
  cooked.struct_size = sizeof cooked;
  const PlumbResult result = cooking->cook(&desc, &cooked);
  if (result < 0) throw Error(result, cooked.message);
  const std::unique_ptr<const void, decltype(cooking->release)> lent(cooked.data, cooking->release);
  const auto* first = static_cast<const std::byte*>(cooked.data);
  return {first, first + cooked.size};
}

std::vector<std::string> backend_path() {
  std::vector<fs::path> wanted;
  if (const char* given = std::getenv("PLUMB_BACKEND_PATH"); given != nullptr) {
    std::string_view rest = given;
    while (!rest.empty()) {
      const std::size_t colon = std::min(rest.find(library::kBetweenFolders), rest.size());
      if (colon != 0) wanted.emplace_back(rest.substr(0, colon));
      rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
  }
  wanted.push_back(library::program_folder() / ".." / "lib" / "plumb");
  wanted.emplace_back(PLUMB_INSTALLED_BACKENDS);
  std::vector<std::string> folders;
  for (const fs::path& folder : wanted) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (!error && fs::is_directory(real) && std::find(folders.begin(), folders.end(), real.string()) == folders.end())
      folders.push_back(real.string());
  }
  return folders;
}

std::vector<FoundBackend> find_backends() {
  std::map<std::string, std::string> by_name;
  for (const std::string& folder : backend_path()) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      const std::string file = entry.path().filename().string();
      if (file.starts_with(kPrefix) && file.ends_with(kSuffix) && file.size() > kPrefix.size() + kSuffix.size())
        by_name.try_emplace(file.substr(kPrefix.size(), file.size() - kPrefix.size() - kSuffix.size()),
                            entry.path().string());
    }
  }
  std::vector<FoundBackend> found;
  for (const auto& [name, file] : by_name) found.push_back({name, file});
  return found;
}

const PlumbBackendTable* negotiate(PlumbOpenFunction open, const std::string& name, const PlumbHost* host) {
  // Minor versions append only, so every later one of this major will do: what it has more, nobody here calls.
  constexpr std::uint32_t oldest = PLUMB_MAKE_VERSION(1, 0),
                          newest = PLUMB_MAKE_VERSION(PLUMB_VERSION_MAJOR(PLUMB_VERSION), 0xffff);
  const PlumbOpenRequest request = {sizeof request, oldest, newest, 0, host};
  PlumbOpenReply reply{};
  reply.struct_size = sizeof reply;
  const PlumbResult result = open(&request, &reply);
  reply.message[sizeof reply.message - 1] = '\0';
  if (result < 0)
    throw Error(result, reply.message[0] != '\0' ? reply.message : "backend " + name + " refused without saying why");
  if (reply.struct_size != sizeof reply)
    throw Error(PLUMB_E_VERSION, "backend " + name + " changed the reply's struct_size to " +
                                     std::to_string(reply.struct_size) +
                                     ", which is the host's to set; its negotiation is broken");
  if (reply.version < oldest || reply.version > newest)
    throw Error(PLUMB_E_VERSION, "backend " + name + " answered with interface " + version_text(reply.version) +
                                     ", which this host did not offer (" + version_text(oldest) + " to " +
                                     version_text(newest) + "); its negotiation is broken");
  if (reply.table == nullptr || reply.table->version != reply.version)
    throw Error(PLUMB_E_VERSION,
                "backend " + name + " agreed to interface " + version_text(reply.version) + " and gave no table of it");
  require_whole(*reply.table, name);
  return reply.table;
}

Backend open_backend(const std::string& name_or_file, const PlumbHost* host) {
  const std::string file = file_of(name_or_file);
  OpenBackends& backends = open_backends();
  const std::lock_guard lock(backends.mutex);
  if (const auto known = backends.by_file.find(file); known != backends.by_file.end())
    return Backend(known->second, file);

  const auto open = reinterpret_cast<PlumbOpenFunction>(library::symbol(library::open(file), PLUMB_OPEN_SYMBOL));
  if (open == nullptr)
    throw Error(PLUMB_E_INVALID_ARGUMENT, file + " is no Plumb backend: it does not export " PLUMB_OPEN_SYMBOL);
  const PlumbBackendTable* table = negotiate(open, file, host);
  const std::string group = table->info()->exclusion_group;
  for (const auto& [other_file, other] : backends.by_file)
    if (!group.empty() && group == other->info()->exclusion_group)
      throw Error(PLUMB_E_EXCLUDED, std::string("backend ") + table->info()->name + " cannot share a process with " +
                                        other->info()->name +
                                        ", which is open already: their libraries clash; use one process each");
  backends.by_file.emplace(file, table);
  return Backend(table, file);
}

}  // namespace plumb
