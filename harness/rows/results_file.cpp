#include "rows/results_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/usage_error.hpp"
#include "rows/results_folder.hpp"

namespace plumb::harness {

namespace {

// Of a row that did not go in whole nothing stays, unless another process has written behind it.
void take_back(int descriptor, std::size_t written) {
  const off_t end = lseek(descriptor, 0, SEEK_CUR), last = lseek(descriptor, 0, SEEK_END);
  if (written > 0 && end == last) (void)!ftruncate(descriptor, end - static_cast<off_t>(written));
}

}  // namespace

ResultsFile::ResultsFile(const std::filesystem::path& folder, const std::string& name)
    : folder_(folder), file_(folder / name) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw UsageError("--out " + folder.string() + ": " + failure.message());
  refresh();
  bool torn = false;
  if (std::ifstream in(file_, std::ios::binary); in && in.seekg(-1, std::ios::end)) torn = in.get() != '\n';
  descriptor_ = open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw UsageError("--out " + folder.string() + ": " + std::strerror(errno));
  if (torn) write_all("\n");  // the torn line stays as it is, and the next row gets a line of its own
}

ResultsFile::~ResultsFile() { close(descriptor_); }

void ResultsFile::refresh() {
  for (const std::filesystem::path& file : results_files(folder_)) reader_.read_on(file);
}

void ResultsFile::append(const Row& row) {
  write_all(line_of(to_json(row)) + "\n");
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    throw std::system_error(errno, std::generic_category(), "flushing " + file_.string());
}

void ResultsFile::write_all(const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      take_back(descriptor_, written);
      throw std::system_error(error, std::generic_category(), "writing " + file_.string());
    }
    written += static_cast<std::size_t>(count);
  }
}

}  // namespace plumb::harness
