#include "cli/live/engine_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>

#include "base/usage_error.hpp"
#include "plumb/loader.hpp"

namespace plumb::harness {

namespace {

std::vector<std::string> engine_folders() {
  std::vector<std::string> folders = backend_path();
  folders.emplace_back(PLUMB_WASM_FOLDER);
  return folders;
}

}  // namespace

std::filesystem::path find_engine_file() {
  for (const std::string& folder : engine_folders()) {
    std::filesystem::path file = std::filesystem::path(folder) / "plumb-impulse.wasm";
    if (std::filesystem::exists(file)) return file;
  }
  return {};
}

std::string read_engine(const std::filesystem::path& file) {
  if (file.empty()) return "";
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw UsageError("cannot read " + file.string());
  if (!bytes.starts_with(std::string_view("\0asm", 4))) throw UsageError(file.string() + " is no WebAssembly");
  return bytes;
}

std::string how_to_get_engine() {
  return fmt::format(
      "there is no plumb-impulse.wasm, which the page runs, in {}; \"./dev platforms wasm\" builds it (on Debian with "
      "emscripten, clang-19, lld-19 and llvm-19, which it installs), or name one by --wasm",
      fmt::join(engine_folders(), ", "));
}

}  // namespace plumb::harness
