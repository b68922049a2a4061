#include "cli/verbs/verbs.hpp"

namespace plumb::harness {

void add_verbs(CLI::App& program, int& status) {
  program.set_version_flag("--version", "plumb " PLUMB_PROGRAM_VERSION);
  program.require_subcommand(1);
  add_backends(program, status);
  add_scenes(program, status);
  add_measures(program, status);
  add_run(program, status);
  add_compare(program, status);
  add_duel(program, status);
  add_curves(program, status);
  add_conform(program, status);
  add_study(program, status);
  add_convert(program, status);
  add_generate(program, status);
  add_reduce(program, status);
  add_worlds(program, status);
  add_export(program, status);
  add_pairs(program, status);
  add_live(program, status);
  add_report(program, status);
  add_replay(program, status);
  add_problem(program, status);
  add_solve(program, status);
  add_man(program, status);
  add_completion(program, status);
  add_worker(program, status);
}

}  // namespace plumb::harness
