#include "cli/manual/examples.hpp"

#include <algorithm>

namespace plumb::harness {

void add_examples(CLI::App& verb, std::initializer_list<Example> examples) {
  std::size_t width = 0;
  for (const Example& example : examples) width = std::max(width, example.line.size());
  std::string text = "Examples:";
  for (const Example& example : examples)
    text += "\n  " + example.line + std::string(width - example.line.size(), ' ') + "  # " + example.doc;
  verb.footer(text);
}

}  // namespace plumb::harness
