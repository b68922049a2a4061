#include <memory>

#include "cli/study_options.hpp"
#include "cli/verbs.hpp"
#include "report/terminal.hpp"

namespace plumb::harness {

void add_run(CLI::App& program, int& status) {
  const auto options = std::make_shared<StudyOptions>();
  CLI::App* verb = program.add_subcommand("run", "Run scenes on backends and measure them");
  add_study_options(*verb, *options);
  verb->callback([options, &status] { status = run_and_print(*options, print_table); });
}

}  // namespace plumb::harness
