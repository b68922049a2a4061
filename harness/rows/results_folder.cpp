#include "rows/results_folder.hpp"

#include <zstd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>

#include "plumb/physics_world.hpp"

namespace plumb::harness {

std::vector<std::filesystem::path> results_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path bare = is_packed(entry.path()) ? entry.path().stem() : entry.path().filename();
    const std::string name = bare.string();
    if (name == "results.jsonl" || (name.starts_with("results-") && name.ends_with(".jsonl")))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return is_packed(a) == is_packed(b) ? a < b : is_packed(a);  // later rows of a cell replace earlier ones
  });
  return files;
}

bool is_packed(const std::filesystem::path& file) { return file.extension() == ".zst"; }

std::string unpacked_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string packed{std::istreambuf_iterator<char>(in), {}};
  const std::unique_ptr<ZSTD_DStream, size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  std::string text, block(ZSTD_DStreamOutSize(), '\0');
  ZSTD_inBuffer input{packed.data(), packed.size(), 0};
  std::size_t left = 1;  // of the frame; 0 at its end
  while (left != 0) {
    ZSTD_outBuffer output{block.data(), block.size(), 0};
    const std::size_t before = input.pos;
    left = ZSTD_decompressStream(stream.get(), &output, &input);
    const bool stuck = left != 0 && output.pos == 0 && input.pos == before;
    if (ZSTD_isError(left) || stuck)
      throw Error(PLUMB_E_CORRUPT, file.string() + " does not unpack: it is cut short or was not packed with zstd");
    text.append(block, 0, output.pos);
  }
  return text;
}

}  // namespace plumb::harness
