// PROGRAM [gtest's options] BACKEND: by name. Says "skipped: " and why where the backend cannot carry the game.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "hosts/ogre/game/game.hpp"
#include "hosts/ogre/tests/tested_backend.hpp"

namespace {
std::string backend;
}

const std::string& plumb::ogre::tests::tested_backend() { return backend; }

std::vector<std::string> plumb::ogre::tests::other_backends() {
  std::istringstream names(PLUMB_TESTED_BACKENDS);
  std::vector<std::string> others;
  for (std::string name; names >> name;)
    if (name != backend) others.push_back(name);
  return others;
}

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  if (count != 2) {
    std::fprintf(stderr, "usage: %s BACKEND\n", words[0]);
    return 2;
  }
  backend = words[1];
  try {
    const plumb::ogre::Game game(backend);
  } catch (const plumb::Error& error) {
    const bool lacks_something = error.code() == PLUMB_E_UNSUPPORTED;
    std::printf("%s%s\n", lacks_something ? "skipped: " : "", error.what());
    return lacks_something ? 0 : 1;
  }
  return RUN_ALL_TESTS();
}
