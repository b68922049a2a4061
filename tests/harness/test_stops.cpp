// What ends before it is done says how to go on, and leaves nothing half written.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs the program by a line of the shell that begins with `before`; the status is the shell's.
Finished in_shell(const std::filesystem::path& folder, const std::string& before,
                  const std::vector<std::string>& arguments) {
  std::string line = before + " '" PLUMB_PROGRAM "'";
  for (const std::string& word : arguments) line += " '" + word + "'";
  const std::filesystem::path out = folder / "said.out", err = folder / "said.err";
  const int status = std::system((line + " >'" + out.string() + "' 2>'" + err.string() + "'").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out), text_of(err)};
}

/// Three cells of a second and more each; the signal comes within the second one.
Finished stopped(const std::filesystem::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run",       particle_scene(folder), "--backend", MISBEHAVING_BACKEND, "--set",
                                     "pause=0.03"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return in_shell(folder, "timeout -s INT 3", arguments);
}

void expect_whole_rows(const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    EXPECT_TRUE(Json::parse(line, nullptr, false).is_object()) << line;
    EXPECT_FALSE(in.eof()) << "its newline is missing";
  }
}

TEST(Stops, interrupted_runs_say_how_to_go_on_and_show_what_is_done) {
  const std::filesystem::path folder = fresh_folder("stopped");
  const std::string out = (folder / "out").string();
  const Finished finished = stopped(folder, {"--out", out});
  EXPECT_NE(finished.err.find("kept in " + out), std::string::npos) << finished.err;
  EXPECT_NE(finished.err.find("the same line goes on: plumb run "), std::string::npos) << finished.err;
  EXPECT_NE(finished.out.find("height=10"), std::string::npos) << finished.out << finished.err;
  expect_whole_rows(folder / "out" / "results.jsonl");
}

TEST(Stops, interrupted_runs_without_a_folder_show_what_is_done_and_name_the_option) {
  const Finished finished = stopped(fresh_folder("stopped_bare"), {});
  EXPECT_NE(finished.err.find("with --out DIR"), std::string::npos) << finished.err;
  EXPECT_NE(finished.out.find("height=10"), std::string::npos) << finished.out << finished.err;
}

TEST(Stops, interrupted_studies_say_how_to_go_on) {
  const std::filesystem::path folder = fresh_folder("stopped_study");
  const std::string scene = particle_scene(folder), study = (folder / "study.json").string();
  std::ofstream(study) << R"({"name": "slow", "sets": {"scenes": ")" << scene
                       << R"(", "settings": {"pause": 0.03}, "repetitions": 1}})";
  const Finished finished =
      in_shell(folder, "timeout -s TERM 3",
               {"study", study, "--backend", MISBEHAVING_BACKEND, "--out", (folder / "out").string()});
  EXPECT_NE(finished.err.find("the same line goes on: plumb study "), std::string::npos) << finished.err;
  expect_whole_rows(folder / "out" / "results.jsonl");
}

TEST(Stops, a_full_disk_is_named_and_no_row_is_torn) {
  const std::filesystem::path folder = fresh_folder("full");
  const Finished finished = in_shell(folder, "ulimit -f 8; exec",
                                     {"run", particle_scene(folder), "--backend", MISBEHAVING_BACKEND, "--backend",
                                      SAMPLE_BACKEND, "--out", (folder / "out").string()});
  EXPECT_EQ(finished.status, 2) << finished.err;
  EXPECT_NE(finished.err.find("results.jsonl: File too large"), std::string::npos) << finished.err;
  EXPECT_GT(std::filesystem::file_size(folder / "out" / "results.jsonl"), 0u);
  expect_whole_rows(folder / "out" / "results.jsonl");
}

TEST(Stops, a_page_that_does_not_fit_is_named_and_the_old_one_stays) {
  const std::filesystem::path folder = fresh_folder("full_page");
  const std::string out = (folder / "out").string(), page = (folder / "page.html").string();
  ASSERT_EQ(plumb({"run", particle_scene(folder), "--backend", SAMPLE_BACKEND, "--out", out}).status, 0);
  std::ofstream(page) << "as it was";
  const Finished finished = in_shell(folder, "ulimit -f 8; exec", {"report", out, "--html", page});
  EXPECT_EQ(finished.status, 2) << finished.err;
  EXPECT_NE(finished.err.find("cannot write " + page + ": File too large"), std::string::npos) << finished.err;
  EXPECT_EQ(text_of(page), "as it was");
  EXPECT_FALSE(std::filesystem::exists(page + ".part"));
}

TEST(Stops, a_page_that_cannot_be_written_is_told_before_any_row_is_read) {
  const std::filesystem::path folder = fresh_folder("nowhere");
  const Finished finished = plumb({"report", (folder / "no_results").string(), "--html", "/no/such/folder/page.html"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("cannot write /no/such/folder/page.html: No such file"), std::string::npos)
      << finished.err;
}

TEST(Stops, a_problem_that_cannot_be_written_is_told_before_its_scene_is_looked_for) {
  const Finished finished = plumb({"problem", "no_such_scene", "--out", "/no/such/folder/x.hdf5"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("cannot write /no/such/folder/x.hdf5: No such file"), std::string::npos) << finished.err;
}

TEST(Stops, a_problem_is_there_whole_or_not_at_all) {
  const std::filesystem::path folder = fresh_folder("problem_draft"), file = folder / "x.hdf5";
  std::ofstream(file) << "as it was";
  EXPECT_EQ(plumb({"problem", "A7", "--out", file.string()}).status, 2);
  EXPECT_EQ(text_of(file), "as it was");
  EXPECT_EQ(plumb({"problem", "D7", "--out", file.string()}).status, 0);
  EXPECT_EQ(text_of(file).substr(1, 3), "HDF");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST(Stops, pictures_that_cannot_be_written_are_told_before_any_trajectory_is_read) {
  const std::filesystem::path folder = fresh_folder("no_pictures");
  const std::string none = (folder / "none.plt").string(), file = (folder / "file").string();
  std::ofstream(file) << "no folder";
  Finished finished = plumb({"export", none, "--png", "/no/such/folder/a.png"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("cannot write /no/such/folder/a.png: No such file"), std::string::npos) << finished.err;
  finished = plumb({"export", none, "--frames", file + "/frames"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("--frames " + file + "/frames: Not a directory"), std::string::npos) << finished.err;
  finished = plumb({"export", none, "--png", (folder / "a.png").string(), "--frames", (folder / "frames").string()});
  EXPECT_NE(finished.err.find("none.plt"), std::string::npos) << finished.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png.part"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "frames"));
}

TEST(Stops, a_full_standard_output_is_an_error) {
  const std::filesystem::path folder = fresh_folder("full_output");
  const std::string line = "'" PLUMB_PROGRAM "' measures --json >/dev/full 2>'" + (folder / "err").string() + "'";
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(text_of(folder / "err").find("standard output"), std::string::npos) << text_of(folder / "err");
}

TEST(Stops, whoever_writes_rows_says_where) {
  const std::filesystem::path folder = fresh_folder("where");
  const std::string scene = particle_scene(folder), out = (folder / "out").string();
  for (const char* form : {"--json", "--csv"}) {
    const Finished finished = plumb({"compare", scene, "--backend", SAMPLE_BACKEND, "--out", out, form});
    EXPECT_NE(finished.err.find("results in " + out), std::string::npos) << form << finished.err;
  }
}

}  // namespace
}  // namespace plumb::harness::testing
