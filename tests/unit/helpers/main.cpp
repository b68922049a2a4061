// test_helpers [gtest's options] BACKEND: the helpers over one backend, by name or file.
#include <cstdio>
#include <optional>

#include "backend_under_test.hpp"

namespace {
std::optional<plumb::Backend> opened;
}

const plumb::Backend& plumb::helpers::test::backend_under_test() { return *opened; }

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  if (count != 2) {
    std::fprintf(stderr, "usage: test_helpers BACKEND\n");
    return 2;
  }
  try {
    opened = plumb::open_backend(words[1]);
  } catch (const plumb::Error& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
  return RUN_ALL_TESTS();
}
