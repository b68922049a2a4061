// The loader: what it finds, and what it says of what it cannot open.
#include "plumb/loader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace plumb::test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string& name, PlumbResult code) {
  try {
    (void)open_backend(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << name << " was opened";
  return {};
}

TEST(Loader, FindsBackendsOnTheEnvironmentsPathFirst) {
  setenv("PLUMB_BACKEND_PATH", "/nowhere:" SAMPLE_FOLDER, 1);
  const std::vector<std::string> folders = backend_path();
  ASSERT_FALSE(folders.empty());
  EXPECT_EQ(folders.front(), fs::canonical(SAMPLE_FOLDER).string());
  const Backend backend = open_backend("sample");
  EXPECT_STREQ(backend.info().name, "sample");
  EXPECT_NE(refusal("sampel", PLUMB_E_INVALID_ARGUMENT).find("did you mean \"sample\"?"), std::string::npos);
  unsetenv("PLUMB_BACKEND_PATH");
}

TEST(Loader, TheFirstFolderOfThePathWins) {
  const fs::path folder = fs::temp_directory_path() / ("plumb-loader-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "plumb-sample.so") << "no library, but found first";
  const auto sample_of = [] {
    for (const FoundBackend& backend : find_backends())
      if (backend.name == "sample") return fs::canonical(backend.file).parent_path();
    return fs::path();
  };
  setenv("PLUMB_BACKEND_PATH", (folder.string() + ":" SAMPLE_FOLDER).c_str(), 1);
  EXPECT_EQ(sample_of(), fs::canonical(folder));
  setenv("PLUMB_BACKEND_PATH", (SAMPLE_FOLDER ":" + folder.string()).c_str(), 1);
  EXPECT_EQ(sample_of(), fs::canonical(SAMPLE_FOLDER));
  unsetenv("PLUMB_BACKEND_PATH");
  fs::remove_all(folder);
}

TEST(Loader, OpensAFileOnce) {
  const Backend first = open_backend(SAMPLE_FOLDER "/plumb-sample.so"),
                second = open_backend(SAMPLE_FOLDER "/./plumb-sample.so");
  EXPECT_EQ(&first.table(), &second.table());
  EXPECT_EQ(first.capability(PLUMB_CAP_JOINT, PLUMB_JOINT_BALL), PLUMB_NONE);
  ASSERT_EQ(first.settings().size(), 2U);
  EXPECT_STREQ(first.settings()[0]->name, "substeps");
}

TEST(Loader, SaysWhyAFileIsNoBackend) {
  EXPECT_NE(refusal("./no/such/file.so", PLUMB_E_INVALID_ARGUMENT).find("cannot be found"), std::string::npos);
  const fs::path text = fs::temp_directory_path() / "plumb-text.so";
  std::ofstream(text) << "no library";
  EXPECT_NE(refusal(text.string(), PLUMB_E_INVALID_ARGUMENT).find("cannot be loaded"), std::string::npos);
  fs::remove(text);
  EXPECT_NE(refusal(LIBRARY_WITHOUT_SYMBOL, PLUMB_E_INVALID_ARGUMENT).find("does not export"), std::string::npos);
}

TEST(Loader, OneBackendOfAnExclusionGroupAtATime) {
  EXPECT_STREQ(open_backend(EXCLUSIVE_ONE).info().name, "one");
  const std::string text = refusal(EXCLUSIVE_OTHER, PLUMB_E_EXCLUDED);
  EXPECT_NE(text.find("other cannot share a process with one"), std::string::npos) << text;
  EXPECT_STREQ(open_backend(EXCLUSIVE_ONE).info().name, "one") << "the one that is open stays";
}

TEST(Loader, AWishForWhatIsNotThereIsNoNeed) {
  const Backend sample = open_backend(SAMPLE_FOLDER "/plumb-sample.so");
  EXPECT_THROW((void)sample.create_world(world_desc(PLUMB_NEED_JOINTS)), Error);
  EXPECT_EQ(sample.offered(PLUMB_NEED_JOINTS | PLUMB_NEED_CCD), 0U);
  EXPECT_NE(sample.create_world(world_desc(sample.offered(PLUMB_NEED_ALL))), nullptr);
}

TEST(Loader, WhatHasNoResultThrows) {
  const auto world = open_backend(SAMPLE_FOLDER "/plumb-sample.so").create_world(world_desc(0));
  const auto text_of = [](const auto& call) {
    try {
      (void)call();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_NOT_DECLARED);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(text_of([&] { return world->contacts(); }).find("reading contacts"), std::string::npos);
  EXPECT_NE(text_of([&] { return world->events(); }).find("reading events"), std::string::npos);
  EXPECT_TRUE(world->bodies().empty());
}

TEST(Loader, TheSampleFalls) {
  const Backend backend = open_backend(SAMPLE_FOLDER "/plumb-sample.so");
  const auto world = backend.create_world(world_desc(0));
  PlumbBodyDesc desc = body_desc();
  desc.flags = PLUMB_BODY_NO_ROTATION;
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = 1;
  desc.material.friction = 0;
  PlumbBody id = 0;
  check(*world, world->create_bodies({&desc, 1}, {&id, 1}));
  PlumbStepReport report{};
  for (int i = 0; i < 120; ++i) {
    check(*world, world->step(1.0 / 60));
    check(*world, world->wait(report));
  }
  double pose[7];
  check(*world,
        world->read(PLUMB_FIELD_POSE, {&id, 1}, Rows(reinterpret_cast<std::byte*>(pose), 1, sizeof pose, PLUMB_F64)));
  EXPECT_NEAR(pose[1], -9.81 * 2 * (2 + 1.0 / 60) / 2, 1e-9);  // semi-implicit Euler: g T (T + dt) / 2
}

}  // namespace
}  // namespace plumb::test
