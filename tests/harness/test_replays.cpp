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
  ASSERT_NE(text.find("<section id=\"replays\">"), std::string::npos);
  const bool viewer = text.find("id=\"plumb-viewer\"") != std::string::npos;
  EXPECT_EQ(text.find("class=\"plumb-replay\" data-scene=\"A1\"") != std::string::npos, viewer);
  EXPECT_EQ(text.find("without node") != std::string::npos, !viewer);
  EXPECT_NE(text.find("</html>"), std::string::npos);

  ASSERT_EQ(plumb({"report", folder.string(), "--html", page, "--no-replays"}).status, 0);
  EXPECT_EQ(text_of(page).find("<section id=\"replays\">"), std::string::npos);
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

}  // namespace
}  // namespace plumb::harness::testing
