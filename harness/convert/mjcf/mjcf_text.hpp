// An MJCF file and those it includes as one, as this version of MuJoCo takes it.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::harness {

/// What differs from the files: what gzip packed is unpacked, textures are gone, which nothing that moves needs and not
/// everybody ships, and a range limits even where nothing says `limited`, as it does since MuJoCo 2.3 and did before
/// 2.2. Throws UsageError for what is no XML or cannot be read.
[[nodiscard]] std::string mjcf_text(const std::filesystem::path& file);

}  // namespace plumb::harness
