#include "cli/manual/option_table.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace plumb::harness {

namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

OptionEntry entry_of(const CLI::Option& option, bool positional) {
  OptionEntry entry;
  entry.doc = option.get_description();
  entry.default_text = option.get_default_str();
  entry.required = option.get_required();
  entry.positional = positional;
  entry.repeatable =
      option.get_items_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  if (positional) entry.names = {option.get_name(true)};
  const bool takes_value = option.get_type_size_max() != 0;
  if (!takes_value) return entry;
  // "WORD:{light,dark}": a type, and after a colon what its validator allows.
  const std::string type = option.get_type_name();
  entry.value = entry.positional ? entry.names.front() : type.substr(0, type.find(':'));
  const auto open = type.find('{'), close = type.find('}');
  if (open != std::string::npos && close != std::string::npos)
    entry.choices = split(type.substr(open + 1, close - open - 1), ',');
  return entry;
}

std::vector<OptionEntry> options_of(const CLI::App& app) {
  std::vector<OptionEntry> options;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    // What may be given either way is both.
    if (option->get_positional()) options.push_back(entry_of(*option, true));
    if (option->nonpositional()) options.push_back(entry_of(*option, false));
  }
  std::stable_partition(options.begin(), options.end(), [](const OptionEntry& option) { return option.positional; });
  return options;
}

/// The examples out of the footer that add_examples made.
std::vector<ExampleEntry> examples_of(const CLI::App& app) {
  std::vector<ExampleEntry> examples;
  for (const std::string& line : split(app.get_footer(), '\n')) {
    const auto mark = line.find("  # ");
    if (!line.starts_with("  ") || mark == std::string::npos) continue;
    const std::string command = line.substr(2, mark - 2);
    examples.push_back({command.substr(0, command.find_last_not_of(' ') + 1), line.substr(mark + 4)});
  }
  return examples;
}

}  // namespace

ProgramTable table_of(const CLI::App& program) {
  ProgramTable table{program.get_name(), program.get_description(), options_of(program), {}};
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App* app) { return !app->get_group().empty(); }))
    table.verbs.push_back({verb->get_name(), verb->get_description(), options_of(*verb), examples_of(*verb)});
  return table;
}

}  // namespace plumb::harness
