// What differs between systems: how a library is opened, and where the program is.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plumb::library {

#if defined(_WIN32)
inline constexpr std::string_view kSuffix = ".dll";
inline constexpr char kBetweenFolders = ';';  // of a search path
#else
inline constexpr std::string_view kSuffix = ".so";
inline constexpr char kBetweenFolders = ':';
#endif

/// Its symbols stay apart from those of other libraries. Never closed. Throws Error with the system's sentence.
[[nodiscard]] void* open(const std::string& file);

/// Null where the library exports no such symbol.
[[nodiscard]] void* symbol(void* library, const char* name);

/// The folder of the running program; empty where the system does not tell.
[[nodiscard]] std::filesystem::path program_folder();

}  // namespace plumb::library
