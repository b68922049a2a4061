#include <dlfcn.h>
#if defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

#include "library.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::library {

void* open(const std::string& file) {
  // Local binding keeps the engines' symbols apart; exclusion groups are for those that clash all the same.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw Error(PLUMB_E_INVALID_ARGUMENT, std::string("backend cannot be loaded: ") + dlerror());
  return library;
}

void* symbol(void* library, const char* name) { return dlsym(library, name); }

std::filesystem::path program_folder() {
  std::error_code ignored;
#if defined(__APPLE__)
  std::uint32_t size = 0;
  _NSGetExecutablePath(nullptr, &size);
  std::string program(size, '\0');
  _NSGetExecutablePath(program.data(), &size);
  return std::filesystem::canonical(program.c_str(), ignored).parent_path();
#else
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
#endif
}

}  // namespace plumb::library
