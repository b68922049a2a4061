#include "base/packed_file.hpp"

#include <zlib.h>

#include <memory>

#include "base/usage_error.hpp"

namespace plumb::harness {

std::string text_of_file(const std::filesystem::path& file) {
  const auto close = [](gzFile stream) { gzclose(stream); };
  // zlib hands on what is not packed as it is.
  const std::unique_ptr<gzFile_s, decltype(close)> stream(gzopen(file.c_str(), "rb"), close);
  std::string text, block(1 << 16, '\0');
  int count = -1;
  while (stream && (count = gzread(stream.get(), block.data(), static_cast<unsigned>(block.size()))) > 0)
    text.append(block, 0, static_cast<std::size_t>(count));
  if (count < 0) throw UsageError(file.string() + ": there is no such file, or it cannot be read");
  return text;
}

}  // namespace plumb::harness
