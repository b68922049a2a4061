// Duels as a user runs them: two engines, or one with two settings, run or of earlier results; and what is refused.
#include <gtest/gtest.h>

#include <fstream>

#include "program.hpp"
#include "rows/row.hpp"

namespace plumb::harness::testing {
namespace {

namespace fs = std::filesystem;

const std::string sample = SAMPLE_BACKEND, verlet = sample + ":integrator=verlet", misbehaving = MISBEHAVING_BACKEND;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t lines_of(const fs::path& file) {
  const std::string text = text_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::vector<std::string> duel(const std::string& a, const std::string& b, std::vector<std::string> more) {
  more.insert(more.begin(), {"duel", a, b});
  return more;
}

TEST(Duels, of_one_engine_with_two_settings_find_the_better_one) {
  const fs::path folder = fresh_folder("duel");
  const std::string page = (folder / "page.html").string();
  const Finished run = plumb(duel(sample, verlet, {"A1", "--repeat", "1", "--out", folder.string(), "--html", page}));
  ASSERT_EQ(run.status, 0) << run.err;
  // Semi-implicit Euler falls g t dt / 2 too far; Verlet is exact.
  EXPECT_NE(run.out.find("sample is ahead in 0, sample:integrator=verlet in 1."), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("page in " + page), std::string::npos) << run.out;
  const std::string html = text_of(page);
  EXPECT_NE(html.find("sample:integrator=verlet"), std::string::npos);
  EXPECT_NE(html.find("They part at "), std::string::npos);
  EXPECT_NE(html.find("</html>"), std::string::npos);
  const bool viewer = html.find("id=\"plumb-viewer\"") != std::string::npos;
  EXPECT_EQ(html.find("data-plumb-replay=\"A1\" data-at=\"") != std::string::npos, viewer);
  EXPECT_EQ(html.find("data-scene=\"A1\" data-backend=\"sample:integrator=verlet\"") != std::string::npos, viewer);

  const std::size_t rows = lines_of(folder / "results.jsonl");
  const Finished again = plumb(duel(sample, verlet, {"A1", "--repeat", "1", "--out", folder.string(), "--html", page}));
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.err.find("2 cells were finished already"), std::string::npos) << again.err;
  EXPECT_EQ(lines_of(folder / "results.jsonl"), rows);

  // The same of the rows, once nothing can be loaded any more.
  const Finished from = plumb(duel("sample", "sample:integrator=verlet", {"--from", folder.string(), "--html", page}));
  EXPECT_EQ(from.status, 0) << from.err;
  EXPECT_EQ(from.out, again.out);
  EXPECT_NE(text_of(page).find("They part at "), std::string::npos);
}

TEST(Duels, keep_to_the_scenes_that_both_can_run_and_say_which_they_cannot) {
  const fs::path folder = fresh_folder("duel_unsupported");
  const Finished run = plumb(duel(
      sample, verlet,
      {"A1", "D1", "--param", "H=1", "--seconds", "0.1", "--repeat", "1", "--replays", "0", "--out", folder.string()}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("Neither runs D1 H=1 (sample: unsupported"), std::string::npos) << run.out;
  EXPECT_TRUE(fs::exists(folder / "duel-sample-sample-integrator-verlet.html")) << "its place when none is given";
  EXPECT_FALSE(fs::exists(folder / "trajectories")) << "no replays, no recordings";
}

TEST(Duels, an_engine_that_crashes_loses_and_takes_nothing_along) {
  const fs::path folder = fresh_folder("duel_crash");
  const Finished run =
      plumb(duel(sample, misbehaving + ":misbehaviour=segfault", {"A1", "--repeat", "1", "--out", folder.string()}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("crashed"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("sample is ahead in 1, misbehaving:misbehaviour=segfault in 0."), std::string::npos)
      << run.out;
}

TEST(Duels, refuse_what_cannot_be_meant) {
  const std::string out = fresh_folder("duel_refused").string();
  const auto refused = [&](const std::string& a, const std::string& b, std::vector<std::string> more,
                           const char* because, const Environment& environment = {}) {
    more.insert(more.end(), {"--out", out});
    const Finished run = plumb(duel(a, b, std::move(more)), environment);
    EXPECT_EQ(run.status, 2) << because;
    EXPECT_NE(run.err.find(because), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  };
  refused(sample, sample, {"A1"}, "are the same engine");
  refused(sample, sample + ":default", {"A1"}, "are the same engine");
  refused(sample, "smaple-engine", {"A1"}, "there is no backend \"smaple-engine\"");
  refused(sample, sample + ":tund", {"A1"}, "did you mean \"tuned\"?");
  refused(sample, sample + ":matched,tuned", {"A1"}, "two profiles");
  refused(sample, sample + ":integrater=verlet", {"A1"}, "integrator");
  refused(sample, ":tuned", {"A1"}, "names no engine");
  refused(sample, verlet, {"A1x"}, "unknown scene \"A1x\"");
  refused(sample, verlet, {"A1", "--html", out + "/none/page.html"}, "none/page.html");
  refused(sample, misbehaving, {"A1"}, "cannot be loaded", {{"PLUMB_MISBEHAVE", "segfault_on_open"}});
  EXPECT_EQ(fs::exists(out + "/results.jsonl") ? lines_of(out + "/results.jsonl") : 0u, 0u) << "nothing was run";
}

TEST(Duels, refuse_results_that_do_not_have_the_two) {
  const fs::path folder = fresh_folder("duel_from");
  ASSERT_EQ(plumb({"run", "A1", "--backend", sample, "--out", folder.string()}).status, 0);
  const auto refused = [&](const std::string& a, const std::string& b, std::vector<std::string> more,
                           const std::string& because) {
    more.insert(more.end(), {"--from", folder.string()});
    const Finished run = plumb(duel(a, b, std::move(more)));
    EXPECT_EQ(run.status, 2) << because;
    EXPECT_NE(run.err.find(because), std::string::npos) << run.err;
  };
  refused("sample", "smple", {}, "did you mean \"sample\"?");
  refused("sample", "sample:integrator=verlet", {}, "no run of sample with what sample:integrator=verlet asks for");
  refused("sample", "sample:tuned", {"D1"}, "no run of");
  refused("sample", "sample", {}, "are the same engine");
  refused("sample", "sample:tuned", {"--dt", "0.01"}, "--dt");
}

}  // namespace
}  // namespace plumb::harness::testing
