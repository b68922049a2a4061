// Recorded cells become replays in the page.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Replays, stand_in_the_page_or_are_said_to_be_missing) {
  const std::filesystem::path folder = fresh_folder("replays");
  const std::string page = (folder / "page.html").string();
  ASSERT_EQ(plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--record", "--out", folder.string()}).status, 0);
  ASSERT_EQ(plumb({"report", folder.string(), "--html", page}).status, 0);
  const std::string text = text_of(page);
  ASSERT_NE(text.find("<section id=\"replays\""), std::string::npos);
  const bool viewer = text.find("id=\"plumb-viewer\"") != std::string::npos;
  EXPECT_EQ(text.find("class=\"plumb-replay\" data-scene=\"A1\"") != std::string::npos, viewer);
  EXPECT_EQ(text.find("without node") != std::string::npos, !viewer);
  EXPECT_NE(text.find("</html>"), std::string::npos);

  ASSERT_EQ(plumb({"report", folder.string(), "--html", page, "--no-replays"}).status, 0);
  EXPECT_EQ(text_of(page).find("<section id=\"replays\""), std::string::npos);
}

TEST(Replays, files_that_are_none_are_told_and_left_out) {
  const std::filesystem::path folder = fresh_folder("foreign");
  const std::string page = (folder / "page.html").string();
  ASSERT_EQ(plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--out", folder.string()}).status, 0);
  std::filesystem::create_directories(folder / "trajectories");
  std::ofstream(folder / "trajectories" / "old.plt") << "PLUMBTR1 and so on";
  const Finished report = plumb({"report", folder.string(), "--html", page});
  EXPECT_EQ(report.status, 0);
  EXPECT_NE(report.err.find("old.plt"), std::string::npos) << report.err;
  EXPECT_EQ(text_of(page).find("<section id=\"replays\">"), std::string::npos);
}

TEST(Replays, are_exported_as_gltf) {
  const std::filesystem::path folder = fresh_folder("export");
  const Finished run =
      plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--record", "--out", folder.string(), "--json"});
  ASSERT_EQ(run.rows().size(), 1u) << run.err;
  const std::string file = (folder / "trajectories" / (run.rows()[0]["cell"].get<std::string>() + ".plt")).string();
  const std::string glb = (folder / "a1.glb").string();
  ASSERT_EQ(plumb({"export", file, "--gltf", glb}).status, 0);
  EXPECT_EQ(text_of(glb).substr(0, 4), "glTF");
  const Finished unsaid = plumb({"export", file});
  EXPECT_EQ(unsaid.status, 2);
  EXPECT_NE(unsaid.err.find("--gltf"), std::string::npos) << unsaid.err;
  const Finished nowhere = plumb({"export", (folder / "none.plt").string(), "--gltf", glb});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_NE(nowhere.err.find("none.plt"), std::string::npos) << nowhere.err;
}

TEST(Replays, are_exported_as_pictures_or_it_is_said_what_is_missing) {
  const std::filesystem::path folder = fresh_folder("picture");
  const Finished run =
      plumb({"run", "A1", "--backend", SAMPLE_BACKEND, "--record", "--out", folder.string(), "--json"});
  ASSERT_EQ(run.rows().size(), 1u) << run.err;
  const std::string file = (folder / "trajectories" / (run.rows()[0]["cell"].get<std::string>() + ".plt")).string();
  const std::string png = (folder / "a1.png").string();
  const Finished finished = plumb({"export", file, "--png", png, "--at", "1", "--size", "320x200"});
  if (finished.status != 0) {
    EXPECT_EQ(finished.status, 2);
    const bool named =
        finished.err.find("node") != std::string::npos || finished.err.find("browser") != std::string::npos;
    EXPECT_TRUE(named) << finished.err;
    GTEST_SKIP() << "this machine takes no pictures: " << finished.err;
  }
  EXPECT_EQ(text_of(png).substr(1, 3), "PNG");
  EXPECT_GT(std::filesystem::file_size(png), 1000u);
}

}  // namespace
}  // namespace plumb::harness::testing
