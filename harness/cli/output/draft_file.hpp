// A file that is there whole or not at all: written beside its place, and moved into it. It is opened before the work
// that fills it, so that nobody works for what cannot be written.
#pragma once

#include <string>

namespace plumb::harness {

class DraftFile {
 public:
  /// Throws UsageError, naming the file and why.
  explicit DraftFile(const std::string& file);
  ~DraftFile();  ///< what was not written leaves nothing behind
  DraftFile(const DraftFile&) = delete;
  DraftFile& operator=(const DraftFile&) = delete;

  /// All of the file, once. Throws UsageError likewise.
  void write(const std::string& bytes);

 private:
  [[noreturn]] void give_up(int error) const;
  [[noreturn]] void fail(int error) const;

  std::string file_, draft_;
  int descriptor_ = -1;
};

}  // namespace plumb::harness
