// A file that may be packed by gzip, as Debian packs what lies below /usr/share/doc.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::harness {

/// Whether the name ends with .gz.
[[nodiscard]] inline bool is_packed(const std::filesystem::path& file) { return file.extension() == ".gz"; }

/// What is in it, unpacked where it is packed. Throws UsageError that names the file.
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file);

}  // namespace plumb::harness
