#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/options/run_options.hpp"
#include "cli/verbs/verbs.hpp"
#include "report/text/terminal.hpp"

namespace plumb::harness {

void add_compare(CLI::App& program, int& status) {
  const auto options = std::make_shared<RunOptions>();
  options->request.repeat = 3;
  options->request.out = "plumb-results";
  CLI::App* verb = program.add_subcommand("compare", "Run scenes on all backends in turns, and hold them side by side");
  add_run_options(*verb, *options);
  add_examples(
      *verb, {{"plumb compare core --out results", "the whole table; stop it at any time and start it again"},
              {"plumb compare A7 E8 --backend ode --backend bullet --csv", "two scenes, two engines, a line a metric"},
              {"plumb compare G1 --param N=1000 --threads 2", "with two threads for each world"}});
  verb->callback([options, &status] { status = run_and_print(*options, print_comparison); });
}

}  // namespace plumb::harness
