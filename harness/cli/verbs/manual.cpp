// plumb man and plumb completion: manual pages and completion scripts out of the parser's own options.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "cli/manual/completion_script.hpp"
#include "cli/manual/examples.hpp"
#include "cli/manual/man_page.hpp"
#include "cli/verbs/verbs.hpp"
#include "conform/conformance.hpp"
#include "measure/registry/registry.hpp"
#include "plumb/loader.hpp"
#include "plumb/nearest.hpp"
#include "scene/catalogue.hpp"
#include "study/study_file.hpp"

namespace plumb::harness {

namespace {

namespace fs = std::filesystem;

constexpr const char* version = "plumb " PLUMB_PROGRAM_VERSION;

void write_file(const fs::path& file, const std::string& text) {
  std::error_code failure;
  fs::create_directories(file.parent_path(), failure);
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  if (failure || !out.flush())
    throw UsageError("cannot write " + file.string() + "; name a folder that may be written to");
}

void print_page(const ProgramTable& table, const std::string& asked) {
  if (asked.empty()) {
    std::cout << man_page(table, version);
    return;
  }
  std::vector<std::string> names;
  for (const VerbEntry& verb : table.verbs) {
    if (verb.name == asked) {
      std::cout << man_page(table, verb, version);
      return;
    }
    names.push_back(verb.name);
  }
  throw UsageError("there is no verb \"" + asked + "\"" + suggestion(asked, names));
}

/// Into the places below a prefix's share folder in which man looks.
void write_pages(const ProgramTable& table, const fs::path& share) {
  const fs::path folder = share / "man" / "man1";
  write_file(folder / (table.name + ".1"), man_page(table, version));
  for (const VerbEntry& verb : table.verbs)
    write_file(folder / (table.name + "-" + verb.name + ".1"), man_page(table, verb, version));
}

struct Shell {
  const char* name;
  const char* file;  ///< below share, where the shell looks
  std::string (*script)(const ProgramTable&);
};
constexpr Shell shells[] = {{"bash", "bash-completion/completions/plumb", bash_completion},
                            {"zsh", "zsh/site-functions/_plumb", zsh_completion},
                            {"fish", "fish/vendor_completions.d/plumb.fish", fish_completion}};

void print_words(const ProgramTable& table, const std::string& kind) {
  std::vector<std::string> words;
  if (kind == "scenes") {
    words = scene_words();
  } else if (kind == "backends") {
    for (const FoundBackend& backend : find_backends()) words.push_back(backend.name);
  } else if (kind == "measures") {
    for (const MeasureEntry& measure : all_measures()) words.emplace_back(measure.name);
  } else if (kind == "checks") {
    for (const conform::Check& check : conform::all_checks()) words.emplace_back(check.name);
  } else if (kind == "studies") {
    for (const auto& [name, text] : study_presets()) words.push_back(name);
  } else if (kind == "verbs") {
    for (const VerbEntry& verb : table.verbs) words.push_back(verb.name);
  } else {
    throw UsageError("--words " + kind + ": there is no such kind" +
                     suggestion(kind, {"scenes", "backends", "measures", "checks", "studies", "verbs"}));
  }
  for (const std::string& word : words) std::cout << word << "\n";
}

}  // namespace

void add_man(CLI::App& program, int& status) {
  struct Options {
    std::string verb, out;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("man", "Print a manual page of the program or of a verb, or write all of them");
  verb->add_option("VERB", options->verb, "Whose page; none: that of the program");
  verb->add_option("--out", options->out, "Write all pages to man/man1 below this folder")->type_name("DIR");
  add_examples(*verb, {{"plumb man run | man -l -", "read the page of plumb run"},
                       {"plumb man --out ~/.local/share", "install all pages for oneself"}});
  verb->callback([&program, options, &status] {
    const ProgramTable table = table_of(program);
    if (options->out.empty())
      print_page(table, options->verb);
    else
      write_pages(table, options->out);
    status = 0;
  });
}

void add_completion(CLI::App& program, int& status) {
  struct Options {
    std::string shell, out, words;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("completion", "Print the script by which a shell completes plumb's line");
  verb->add_option("SHELL", options->shell, "Which shell")->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->add_option("--out", options->out, "Write all scripts to where the shells look below this folder")
      ->type_name("DIR");
  verb->add_option("--words", options->words, "What the scripts ask: the words of a kind, one a line")->group("");
  add_examples(*verb, {{"source <(plumb completion bash)", "complete in this shell"},
                       {"plumb completion --out ~/.local/share", "install the scripts for oneself"}});
  verb->callback([&program, options, &status] {
    const ProgramTable table = table_of(program);
    if (options->shell.empty() && options->out.empty() && options->words.empty())
      throw UsageError("say which: plumb completion bash, zsh or fish, or --out DIR for all");
    for (const Shell& shell : shells) {
      if (options->shell == shell.name) std::cout << shell.script(table);
      if (!options->out.empty()) write_file(fs::path(options->out) / shell.file, shell.script(table));
    }
    if (!options->words.empty()) print_words(table, options->words);
    status = 0;
  });
}

}  // namespace plumb::harness
