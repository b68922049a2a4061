#include "cli/output/draft_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "scene/scene.hpp"

namespace plumb::harness {

DraftFile::DraftFile(const std::string& file) : file_(file), draft_(file + ".part") {
  if (std::filesystem::is_directory(file_)) fail(EISDIR);
  descriptor_ = open(draft_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(errno);
}

DraftFile::~DraftFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(draft_.c_str());
}

void DraftFile::give_up(int error) const {
  unlink(draft_.c_str());
  fail(error);
}

void DraftFile::write(const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    written += static_cast<std::size_t>(count);
  }
  // A file system of the net or with quotas may say only now that there is no room.
  if (close(std::exchange(descriptor_, -1)) != 0) give_up(errno);
  if (std::rename(draft_.c_str(), file_.c_str()) != 0) give_up(errno);
}

void DraftFile::fail(int error) const {
  throw UsageError(
      fmt::format("cannot write {}: {}; name a file in a folder that is there, may be written to and has room", file_,
                  std::strerror(error)));
}

}  // namespace plumb::harness
