// Who runs which cell, where several processes, perhaps on several machines, work in one results folder.
//
// A claim is a lock on one byte of DIR/claims.lock, at a place that the cell's id gives. The system gives it back when
// its process ends, however it ends, so that nothing of the dead has to be told from the living and cleared away. Such
// locks hold over a network where the file system passes them on (NFS 4, Lustre with flock, GPFS).
#pragma once

#include <filesystem>
#include <string>

namespace plumb::harness {

class Claims {
 public:
  /// alone: no other process is expected, so that a file system without locks will do. Throws UsageError.
  Claims(const std::filesystem::path& folder, bool alone);
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  /// False when another process has it.
  [[nodiscard]] bool take(const std::string& cell_id);
  void give_back(const std::string& cell_id);

 private:
  bool lock(const std::string& cell_id, short type);

  std::filesystem::path file_;
  bool alone_;
  int descriptor_ = -1;
};

}  // namespace plumb::harness
