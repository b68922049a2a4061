#include "run/results.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "scene/scene.hpp"

namespace plumb::harness {

ResultsFile::ResultsFile(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw UsageError("--out " + folder.string() + ": " + failure.message());
  const std::filesystem::path file = folder / "results.jsonl";
  bool torn = false;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    torn = in.eof();
    Json row = Json::parse(line, nullptr, false);
    if (!row.is_object() || !row.contains("cell") || !row["cell"].is_string()) continue;
    const std::string cell = row["cell"];
    rows_[cell] = std::move(row);
  }
  descriptor_ = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw UsageError("--out " + folder.string() + ": " + std::strerror(errno));
  if (torn) write_all("\n");  // the torn line stays as it is, and the next row gets a line of its own
}

ResultsFile::~ResultsFile() { close(descriptor_); }

const Json* ResultsFile::find(const std::string& cell_id) const {
  const auto found = rows_.find(cell_id);
  return found == rows_.end() ? nullptr : &found->second;
}

void ResultsFile::append(const Json& row) {
  write_all(line_of(row) + "\n");
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    throw std::system_error(errno, std::generic_category(), "flushing results.jsonl");
}

void ResultsFile::write_all(const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw std::system_error(errno, std::generic_category(), "writing results.jsonl");
    written += static_cast<std::size_t>(count);
  }
}

}  // namespace plumb::harness
