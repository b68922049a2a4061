// Parses the line and turns failures into exit statuses.
#include "cli/program.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>

#include "base/shown.hpp"
#include "cli/verbs/verbs.hpp"
#include "plumb/nearest.hpp"
#include "scene/scene.hpp"
#include "worker/worker_process.hpp"

namespace plumb::harness {
namespace {

constexpr int wrong_question = 2;

std::vector<std::string> verb_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App* app) { return !app->get_group().empty(); }))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> long_options(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// CLI11 names what it did not expect; this adds the nearest right word.
std::string hint(const CLI::App& program, int count, char** arguments) {
  if (count < 2) return "; known are " + fmt::format("{}", fmt::join(verb_names(program), ", "));
  const auto known = program.get_subcommands([&](const CLI::App* app) { return app->get_name() == arguments[1]; });
  if (known.empty()) return suggestion(arguments[1], verb_names(program));
  const std::vector<std::string> options = long_options(*known.front());
  for (int i = 2; i < count; ++i) {
    const std::string word = std::string(arguments[i]).substr(0, std::string(arguments[i]).find('='));
    if (word.starts_with("--") && std::find(options.begin(), options.end(), word) == options.end())
      return suggestion(word, options);
  }
  return "";
}

// What was typed may be long, and is told in one line of some length, without what a terminal obeys.
void complain(const std::string& text) {
  constexpr std::size_t longest_word = 300, longest = 1500;
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    shown += shortened(text.substr(at, end - at), longest_word);
    if (end < text.size()) shown += ' ';
    at = end + 1;
  }
  fmt::print(stderr, "plumb: {}\n", shortened(shown, longest));
}

int parse_and_do(CLI::App& program, int count, char** arguments, const int& status) {
  try {
    if (count >= 2 && arguments[1][0] != '-') {
      const std::string verb = arguments[1];
      const std::vector<std::string> verbs = verb_names(program);
      if (verb != "worker" && std::find(verbs.begin(), verbs.end(), verb) == verbs.end())
        throw UsageError("there is no verb \"" + verb + "\"" + suggestion(verb, verbs));
    }
    program.parse(count, arguments);
    if (!std::cout.flush() || std::fflush(stdout) != 0)
      throw UsageError("cannot write to standard output: is its disk full?");
    return status;
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    complain(error.what() + hint(program, count, arguments));
    return wrong_question;
  } catch (const Interrupted& interrupted) {
    std::cout.flush();
    signal(interrupted.signal, SIG_DFL);
    raise(interrupted.signal);
    return 128 + interrupted.signal;
  } catch (const std::exception& error) {
    complain(error.what());
    return wrong_question;
  }
}

}  // namespace

int run_program(int count, char** arguments) {
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like others
  CLI::App program("Holds physics backends against the truth: the same scenes, the same measures, any engine.",
                   "plumb");
  int status = 0;
  add_verbs(program, status);
  return parse_and_do(program, count, arguments, status);
}

}  // namespace plumb::harness
