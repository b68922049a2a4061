#include <windows.h>

#include <system_error>

#include "library.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::library {

void* open(const std::string& file) {
  // The folder of the library is where those that it needs are looked for.
  HMODULE library = LoadLibraryExW(std::filesystem::path(file).c_str(), nullptr, LOAD_WITH_ALTERED_SEARCH_PATH);
  if (library == nullptr)
    throw Error(PLUMB_E_INVALID_ARGUMENT, "backend cannot be loaded: " + file + ": " +
                                              std::system_category().message(static_cast<int>(GetLastError())));
  return library;
}

void* symbol(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

std::filesystem::path program_folder() {
  std::wstring program(MAX_PATH, L'\0');
  for (;;) {
    const DWORD size = GetModuleFileNameW(nullptr, program.data(), static_cast<DWORD>(program.size()));
    if (size < program.size()) return std::filesystem::path(program.substr(0, size)).parent_path();
    program.resize(2 * program.size());
  }
}

}  // namespace plumb::library
