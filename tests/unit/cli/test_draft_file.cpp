#include "cli/output/draft_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>

#include "scene/scene.hpp"

namespace {
bool over_quota = false;
}

// The linker's --wrap sends every close here: a file system that says only when a file is closed that it has no room.
extern "C" int __real_close(int descriptor);
extern "C" int __wrap_close(int descriptor) {
  const int result = __real_close(descriptor);
  if (!over_quota) return result;
  errno = EDQUOT;
  return -1;
}

namespace plumb::harness {
namespace {

TEST(DraftFile, WhatOnlyCloseReportsLeavesWhatWasThere) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("plumb-draft-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "x";
  std::ofstream(file) << "before";
  std::string told;
  {
    DraftFile draft(file.string());
    over_quota = true;
    try {
      draft.write("after!!");
    } catch (const UsageError& error) {
      told = error.what();
    }
    over_quota = false;
  }
  EXPECT_NE(told.find("cannot write " + file.string() + ": Disk quota exceeded"), std::string::npos) << told;
  EXPECT_EQ(std::filesystem::file_size(file), 6u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()), 1);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace plumb::harness
