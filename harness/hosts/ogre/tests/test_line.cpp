// What is wrong with the line is told before any window opens.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hosts/ogre/tests/program.hpp"

namespace plumb::ogre::tests {
namespace {

void expect_refused(const std::string& options, std::initializer_list<const char*> words) {
  const Ended ended = run_line(PLUMB_OGRE_PROGRAM " " + options + " 2>&1 </dev/null");
  EXPECT_EQ(ended.status, 2) << options << ": " << ended.text;
  for (const char* word : words)
    EXPECT_NE(ended.text.find(word), std::string::npos) << options << ": \"" << word << "\" is not in " << ended.text;
}

TEST(Line, WrongOptionsAreToldByNameValueAndRemedy) {
  expect_refused("--frames 0", {"--frames", "\"0\"", "write 300"});
  expect_refused("--frames many", {"--frames", "\"many\"", "write 300"});
  expect_refused("--frmaes 3", {"--frmaes", "did you mean \"--frames\"?"});
  expect_refused("--screenshot a.png", {"--screenshot", "--frames"});
  expect_refused("--frames 1 --screenshot a.jpg", {"--screenshot", "a.jpg", ".png"});
  expect_refused("--frames 1 --screenshot no/such/folder/a.png", {"--screenshot", "no/such/folder", "make it"});
  expect_refused("--switch-at soon ode", {"--switch-at", "\"soon\"", "write 2.5"});
  expect_refused("--switch-at -1 ode", {"--switch-at", "\"-1\"", "write 2.5"});
  expect_refused("--switch-at 1", {"--switch-at", "SECONDS NAME"});
  expect_refused("--script no-such-file", {"--script", "no-such-file", "SECONDS ACTION"});
  expect_refused("--backend no-such-engine", {"--backend", "no-such-engine", "there are"});
  expect_refused("now", {"now", "--help"});
}

TEST(Line, WrongScriptsAreToldByFileAndLine) {
  const std::string file = testing::TempDir() + "plumb-ogre-wrong.script";
  std::ofstream(file) << "1 jump\n2 hop\n";
  expect_refused("--script " + file, {"--script", "plumb-ogre-wrong.script:2", "\"hop\""});
  std::filesystem::remove(file);
}

TEST(Line, HelpTellsWhatThereIs) {
  const Ended ended = run_line(PLUMB_OGRE_PROGRAM " --help");
  EXPECT_EQ(ended.status, 0);
  for (const char* option : {"--backend", "--frames", "--screenshot", "--switch-at", "--script"})
    EXPECT_NE(ended.text.find(option), std::string::npos) << option;
}

}  // namespace
}  // namespace plumb::ogre::tests
