// The verbs and options of the program as plain data, taken from the parser itself: what manual pages and completions
// are made of.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace plumb::harness {

struct OptionEntry {
  std::vector<std::string> names;    ///< "--out", "-h"; of a positional its one name, in capitals
  std::string value;                 ///< what is given: "DIR"; empty of a flag
  std::vector<std::string> choices;  ///< of the value, where there are few
  std::string doc, default_text;
  bool positional = false, required = false, repeatable = false;
};

struct ExampleEntry {
  std::string line, doc;
};

struct VerbEntry {
  std::string name, doc;
  std::vector<OptionEntry> options;  ///< positionals first
  std::vector<ExampleEntry> examples;
};

struct ProgramTable {
  std::string name, doc;
  std::vector<OptionEntry> options;
  std::vector<VerbEntry> verbs;
};

/// All that is not hidden.
[[nodiscard]] ProgramTable table_of(const CLI::App& program);

}  // namespace plumb::harness
