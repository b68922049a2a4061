// Manual pages and completions: nothing of the parser is missing, man and the shells read them without a complaint, and
// bash completes what it should.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/manual/completion_script.hpp"
#include "cli/manual/man_page.hpp"
#include "cli/verbs/verbs.hpp"
#include "scene/catalogue.hpp"
#include "shell.hpp"

namespace plumb::harness::testing {
namespace {

namespace fs = std::filesystem;

struct Described {
  Described() : program("Holds engines against the truth.", "plumb") { add_verbs(program, status); }
  int status = 0;
  CLI::App program;
};

/// As roff has it.
std::string escaped(const std::string& name) {
  std::string out;
  for (const char c : name) out += c == '-' ? std::string("\\-") : std::string(1, c);
  return out;
}

class Written : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("plumb-manual-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    const Said said = in_bash(PLUMB_PROGRAM " man --out " + folder_.string() +
                              " && " PLUMB_PROGRAM " completion --out " + folder_.string());
    ASSERT_EQ(said.status, 0) << said.text;
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// What bash offers for the last word.
  std::vector<std::string> completions(const std::vector<std::string>& words, const std::string& before = "") {
    std::string line =
        before + "source " + (folder_ / "bash-completion/completions/plumb").string() + "; COMP_WORDS=(" PLUMB_PROGRAM;
    for (const std::string& word : words) line += " \"" + word + "\"";
    line += "); COMP_CWORD=" + std::to_string(words.size()) + "; _plumb; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
    std::istringstream said(in_bash(line).text);
    std::vector<std::string> offered;
    for (std::string word; std::getline(said, word);)
      if (!word.empty()) offered.push_back(word);
    return offered;
  }

  fs::path folder_;
};

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(ManPages, TellOfEveryVerbAndEveryOption) {
  Described parser;
  const ProgramTable table = table_of(parser.program);
  const std::string overview = man_page(table, "plumb 1");
  std::size_t verbs = 0;
  for (const CLI::App* verb : parser.program.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_group().empty()) continue;
    ++verbs;
    EXPECT_NE(overview.find("\\fB" + verb->get_name() + "\\fR"), std::string::npos) << verb->get_name();
    const auto entry = std::find_if(table.verbs.begin(), table.verbs.end(),
                                    [&](const VerbEntry& candidate) { return candidate.name == verb->get_name(); });
    ASSERT_NE(entry, table.verbs.end()) << verb->get_name();
    const std::string page = man_page(table, *entry, "plumb 1");
    for (const CLI::Option* option : verb->get_options()) {
      if (option->get_group().empty()) continue;
      for (const std::string& name : option->get_lnames())
        EXPECT_NE(page.find("\\fB" + escaped("--" + name) + "\\fR"), std::string::npos) << verb->get_name() << name;
      if (!option->get_positional()) continue;
      EXPECT_NE(page.find("\\fI" + option->get_name(true) + "\\fR"), std::string::npos) << option->get_name(true);
    }
    for (const char* section : {".SH NAME", ".SH SYNOPSIS", ".SH DESCRIPTION", ".SH EXAMPLES", ".SH SEE ALSO"})
      EXPECT_NE(page.find(section), std::string::npos) << verb->get_name() << section;
  }
  EXPECT_GE(verbs, 16u);
}

TEST_F(Written, PagesPleaseMan) {
  if (!has_command("groff")) GTEST_SKIP() << "there is no groff";
  std::size_t pages = 0;
  for (const auto& page : fs::directory_iterator(folder_ / "man" / "man1")) {
    const Said said = in_bash("groff -man -ww -z -Tutf8 " + page.path().string());
    EXPECT_EQ(said.status, 0);
    EXPECT_EQ(said.text, "") << page.path();
    ++pages;
  }
  EXPECT_GE(pages, 17u);
}

TEST_F(Written, ScriptsAreReadByTheirShells) {
  EXPECT_EQ(in_bash("bash -n " + (folder_ / "bash-completion/completions/plumb").string()).text, "");
  bool all = true;
  for (const auto& [shell, file] :
       {std::pair{"zsh", "zsh/site-functions/_plumb"}, std::pair{"fish", "fish/vendor_completions.d/plumb.fish"}}) {
    ASSERT_TRUE(fs::exists(folder_ / file));
    if (has_command(shell)) {
      EXPECT_EQ(in_bash(std::string(shell) + " -n " + (folder_ / file).string()).text, "");
    } else {
      all = false;
    }
  }
  if (!all) GTEST_SKIP() << "not all of zsh and fish are here";
}

TEST_F(Written, BashCompletesVerbsAndOptions) {
  EXPECT_EQ(completions({"sc"}), std::vector<std::string>{"scenes"});
  Described parser;
  const ProgramTable table = table_of(parser.program);
  const auto offered = completions({""});
  for (const VerbEntry& verb : table.verbs) {
    EXPECT_TRUE(contains(offered, verb.name)) << verb.name;
    const auto options = completions({verb.name, "--"});
    for (const OptionEntry& option : verb.options) {
      if (option.positional || !option.names.front().starts_with("--")) continue;
      EXPECT_TRUE(contains(options, option.names.front())) << verb.name << option.names.front();
    }
  }
  EXPECT_FALSE(contains(offered, "worker"));
  EXPECT_EQ(completions({"run", "D1", "--prof"}), std::vector<std::string>{"--profile"});
}

TEST_F(Written, BashCompletesScenesBackendsAndChoices) {
  const auto scenes = completions({"run", ""});
  for (const std::string& word : scene_words()) EXPECT_TRUE(contains(scenes, word)) << word;
  EXPECT_EQ(completions({"run", "D1", "free-f"}), std::vector<std::string>{"free-fall"});
  EXPECT_EQ(completions({"run", "D1", "--profile", "t"}), std::vector<std::string>{"tuned"});
  EXPECT_EQ(completions({"run", "D1", "--profile", "=", "m"}), std::vector<std::string>{"matched"});
  EXPECT_EQ(completions({"measures", "quant"}), std::vector<std::string>{"quantities"});
  EXPECT_EQ(completions({"study", "stand"}), std::vector<std::string>{"standard"});
  EXPECT_EQ(completions({"man", "comple"}), std::vector<std::string>{"completion"});
  const fs::path backends = folder_ / "backends";
  fs::create_directories(backends);
  std::ofstream(backends / "plumb-mine_alone.so") << "";
  const std::string path = "export PLUMB_BACKEND_PATH=" + backends.string() + "; ";
  EXPECT_EQ(completions({"run", "D1", "--backend", "mine"}, path), std::vector<std::string>{"mine_alone"});
  EXPECT_EQ(completions({"conform", "mine"}, path), std::vector<std::string>{"mine_alone"});
}

TEST_F(Written, BashCompletesFilesAndFolders) {
  std::ofstream(folder_ / "page.json") << "{}";
  fs::create_directories(folder_ / "results");
  const std::string there = "cd " + folder_.string() + "; ";
  EXPECT_EQ(completions({"report", "results", "--html", "pa"}, there), std::vector<std::string>{"page.json"});
  EXPECT_EQ(completions({"run", "D1", "--out", "re"}, there), std::vector<std::string>{"results"});
  EXPECT_TRUE(contains(completions({"run", "page"}, there), "page.json"));
}

TEST(Manual, AWrongVerbIsToldTheNearest) {
  const Said said = in_bash(PLUMB_PROGRAM " man rnu");
  EXPECT_EQ(said.status, 2);
  EXPECT_NE(said.text.find("did you mean \"run\"?"), std::string::npos) << said.text;
}

}  // namespace
}  // namespace plumb::harness::testing
