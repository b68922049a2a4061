#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/options/run_options.hpp"
#include "cli/verbs/verbs.hpp"
#include "report/text/terminal.hpp"

namespace plumb::harness {

void add_run(CLI::App& program, int& status) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* verb = program.add_subcommand("run", "Run scenes on backends and measure them");
  add_run_options(*verb, *options);
  add_examples(
      *verb,
      {{"plumb run tower --param H=10", "one scene on every backend"},
       {"plumb run C1 --backend ode --set iterations=50 --json", "another setting; a row as JSON"},
       {"plumb run D1 --backend impulse --profile tuned --seconds 2", "with the settings of the engine's author"},
       {"plumb run ./my-scene.json --strict", "a file of one's own; status 1 when a threshold is missed"},
       {"plumb run D12 --record --out results", "with a trajectory for plumb report and plumb export"},
       {"plumb run D1 --backend impulse --timeline --out results",
        "with a timeline of its calls and phases for Perfetto"}});
  verb->callback([options, &status] { status = run_and_print(*options, print_table); });
}

}  // namespace plumb::harness
