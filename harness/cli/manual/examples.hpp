// Lines that show how a verb is used: they end its --help, and stand in its manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

namespace plumb::harness {

struct Example {
  std::string line, doc;  ///< "plumb run D1", and what it does; the line has no " # "
};

/// "Examples:" and a line for each, under the help of the verb.
void add_examples(CLI::App& verb, std::initializer_list<Example> examples);

}  // namespace plumb::harness
