// The engine as WebAssembly, which pages run: plumb-impulse.wasm beside the backends, or where ./dev platforms wasm
// puts it.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::harness {

/// "" where there is none.
[[nodiscard]] std::filesystem::path find_engine_file();
/// Its bytes, "" of "". Throws UsageError for what cannot be read or is no WebAssembly.
[[nodiscard]] std::string read_engine(const std::filesystem::path& file);
/// Where it was looked for, and how one comes by it.
[[nodiscard]] std::string how_to_get_engine();

}  // namespace plumb::harness
