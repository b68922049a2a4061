// Finds backends, opens them, and says in a sentence why one cannot be opened.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb {

/// An opened backend. Cheap to copy; its library stays loaded until the process ends.
class Backend {
 public:
  /// table must live as long as the process.
  explicit Backend(const PlumbBackendTable* table, std::string file = {});

  [[nodiscard]] const PlumbBackendInfo& info() const { return *table_->info(); }
  [[nodiscard]] const PlumbBackendTable& table() const { return *table_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] PlumbDegree capability(PlumbCapability kind, std::uint32_t a = 0, std::uint32_t b = 0) const;
  /// A sentence on the capability, or "".
  [[nodiscard]] std::string capability_note(PlumbCapability kind, std::uint32_t a = 0, std::uint32_t b = 0) const;
  /// Those of the needs that the backend has, if only approximately. What a host would like and can do without joins
  /// what it cannot: `world_desc(required | backend.offered(wanted))`.
  [[nodiscard]] PlumbNeeds offered(PlumbNeeds wanted) const;
  /// The backend's settings; empty without plumb.settings/1.
  [[nodiscard]] std::vector<const PlumbSettingInfo*> settings() const;

  /// Throws Error with the backend's own sentence.
  [[nodiscard]] std::unique_ptr<IPhysicsWorld> create_world(const PlumbWorldDesc& desc) const;

  /// The bytes of a shape, for IPhysicsWorld::cooking() of any world of this backend (plumb.cooking/1). On any thread.
  /// Throws Error likewise.
  [[nodiscard]] std::vector<std::byte> cook(const PlumbShapeDesc& desc) const;

 private:
  const PlumbBackendTable* table_;
  std::string file_;
};

struct FoundBackend {
  std::string name;  ///< "bullet" for plumb-bullet.so or .dll
  std::string file;
};

/// The folders that are searched, in order: each of $PLUMB_BACKEND_PATH (colons between, on Windows semicolons),
/// ../lib/plumb beside the program's folder, the install prefix's lib/plumb. Folders that do not exist are left out.
[[nodiscard]] std::vector<std::string> backend_path();

/// Backends on the path, by name; the first of a name wins. Nothing is opened.
[[nodiscard]] std::vector<FoundBackend> find_backends();

/// Opens a backend by name or by file (anything with a slash or ending in .so, on Windows .dll). host may be null and
/// must live as long as the process. Throws Error: PLUMB_E_INVALID_ARGUMENT (not found; names the nearest),
/// PLUMB_E_VERSION (which side is too old), PLUMB_E_EXCLUDED (which backend stands in the way), or what the backend
/// answered.
[[nodiscard]] Backend open_backend(const std::string& name_or_file, const PlumbHost* host = nullptr);

/// Negotiates with an open function that is already at hand, for backends linked into the program and for tests.
[[nodiscard]] const PlumbBackendTable* negotiate(PlumbOpenFunction open, const std::string& name,
                                                 const PlumbHost* host = nullptr);

}  // namespace plumb
