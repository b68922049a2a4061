#include "schedule/claims.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/scene.hpp"

namespace plumb::harness {

Claims::Claims(const std::filesystem::path& folder, bool alone) : file_(folder / "claims.lock"), alone_(alone) {
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw UsageError(fmt::format("--out {}: {}", file_.string(), std::strerror(errno)));
}

Claims::~Claims() { close(descriptor_); }

bool Claims::take(const std::string& cell_id) { return lock(cell_id, F_WRLCK); }
void Claims::give_back(const std::string& cell_id) { (void)lock(cell_id, F_UNLCK); }

bool Claims::lock(const std::string& cell_id, short type) {
  // Of the open file, not of the process: closing another descriptor of the file, as a reader may, must not drop it.
  struct flock range {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(std::stoull(cell_id, nullptr, 16) >> 2);
  range.l_len = 1;
  if (fcntl(descriptor_, F_OFD_SETLK, &range) == 0) return true;
  if (errno == EAGAIN || errno == EACCES) return false;
  if (alone_) return true;
  throw UsageError(
      fmt::format("{}: this file system has no locks ({}); let one process work there, or name a folder "
                  "on another by --out",
                  file_.string(), std::strerror(errno)));
}

}  // namespace plumb::harness
