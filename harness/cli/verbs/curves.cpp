#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/options/run_options.hpp"
#include "cli/verbs/verbs.hpp"
#include "report/text/terminal.hpp"

namespace plumb::harness {

void add_curves(CLI::App& program, int& status) {
  const auto options = std::make_shared<RunOptions>();
  options->request.repeat = 3;
  options->request.out = "plumb-results";
  SweepRequest& sweep = options->request.sweep.emplace();
  CLI::App* verb =
      program.add_subcommand("curves", "Run scenes with a backend's settings turned: error against cost, as curves");
  add_run_options(*verb, *options);
  const auto add_axis = [&](const char* option, std::vector<std::string>& axes, const char* doc) {
    verb->add_option(option, axes, doc)->type_name("NAME=VALUES")->take_all()->expected(1)->allow_extra_args(false);
  };
  add_axis("--over", sweep.over,
           "[backend:]name[=value,value] of a setting, repeatable: a curve for each of its choices");
  add_axis("--along", sweep.along,
           "[backend:]name[=value,value] of a knob, repeatable: the curve's points; none: all whole-numbered settings "
           "of the role quality, halved and doubled");
  add_examples(*verb, {{"plumb curves D2 D3 --param N=20 --backend impulse --over solver --out results",
                        "a curve for each solver"},
                       {"plumb curves A7 --backend ode --along iterations=10,20,40", "these points of one knob"}});
  verb->callback([options, &status] { status = run_and_print(*options, print_table); });
}

}  // namespace plumb::harness
