#include "hosts/ogre/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "plumb/nearest.hpp"

namespace plumb::ogre {
namespace {

namespace fs = std::filesystem;

template <class Number>
bool reads(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

CLI::Validator count_of_frames() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        int frames = 0;
        return reads(text, frames) && frames >= 1 ? "" : "\"" + text + "\" is no whole number of 1 or more: write 300";
      },
      "");
}

CLI::Validator time_of_game() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double seconds = 0;
        return reads(text, seconds) && std::isfinite(seconds) && seconds >= 0
                   ? ""
                   : "\"" + text + "\" is no time of 0 s or more: write 2.5";
      },
      "");
}

CLI::Validator picture_file() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        const fs::path file(text);
        if (file.extension() != ".png") return "\"" + text + "\" does not end in .png, which is what is written";
        const fs::path folder = fs::absolute(file).parent_path();
        return fs::is_directory(folder) ? "" : "there is no folder " + folder.string() + ": make it first";
      },
      "");
}

std::vector<TimedAction> read_script(const std::string& name) {
  std::ifstream file(name);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.good() || fs::is_directory(name))
    throw std::invalid_argument("\"" + name + "\" cannot be read: name a file of lines SECONDS ACTION");
  return parse_script(text, name);
}

std::string hint(const CLI::App& program, int count, char** words) {
  std::vector<std::string> known;
  for (const CLI::Option* option : program.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 1; i < count; ++i) {
    const std::string word = std::string(words[i]).substr(0, std::string(words[i]).find('='));
    if (word.starts_with("--") && std::find(known.begin(), known.end(), word) == known.end())
      return suggestion(word, known);
  }
  return "; plumb-ogre --help tells what there is";
}

int complain(const std::string& text) {
  std::fprintf(stderr, "plumb-ogre: %s\n", text.c_str());
  return kWrongQuestion;
}

}  // namespace

std::optional<int> parse_options(int count, char** words, Options& options) {
  CLI::App program("A small game in OGRE over any of Plumb's backends, which may change while it runs.", "plumb-ogre");
  program.add_option("--backend", options.backend, "The engine to begin with, by name or file")
      ->type_name("NAME")
      ->capture_default_str();
  const CLI::Option* frames =
      program.add_option("--frames", options.frames, "End after so many frames of 1/60 s, however long they take")
          ->type_name("N")
          ->check(count_of_frames());
  program.add_option("--screenshot", options.screenshot, "A picture of the last of --frames")
      ->type_name("FILE.png")
      ->check(picture_file());
  std::vector<std::pair<double, std::string>> switches;
  program.add_option("--switch-at", switches, "Go on in another engine then, repeatable")
      ->type_name("SECONDS NAME")
      ->check(time_of_game().application_index(0));
  std::string script;
  program.add_option("--script", script, "Actions at times: a line each, as 1.5 walk 2 0; README.md has the words")
      ->type_name("FILE");
  try {
    program.parse(count, words);
    if (!options.screenshot.empty() && frames->count() == 0)
      throw std::invalid_argument("--screenshot is of the last frame: say with --frames which that is");
    if (!script.empty()) options.actions = read_script(script);
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ExtrasError& error) {
    return complain(error.what() + hint(program, count, words));
  } catch (const CLI::ParseError& error) {
    return complain(error.what());
  } catch (const std::invalid_argument& error) {
    return complain(script.empty() ? error.what() : std::string("--script: ") + error.what());
  }
  for (const auto& [seconds, engine] : switches) {
    TimedAction& timed = options.actions.emplace_back();
    timed.time = seconds;
    timed.action = SwitchTo{engine};
  }
  return std::nullopt;
}

}  // namespace plumb::ogre
