// The verbs of the program; each is added by its own file. A verb sets status when it is used: 0 all that was asked
// ran, 1 a threshold was missed (where that was asked for). What is asked wrongly is thrown as UsageError.
#pragma once

#include <CLI/CLI.hpp>

namespace plumb::harness {

void add_backends(CLI::App& program, int& status);
void add_scenes(CLI::App& program, int& status);
void add_measures(CLI::App& program, int& status);
void add_run(CLI::App& program, int& status);
void add_compare(CLI::App& program, int& status);
void add_duel(CLI::App& program, int& status);
void add_curves(CLI::App& program, int& status);
void add_conform(CLI::App& program, int& status);
void add_study(CLI::App& program, int& status);
void add_convert(CLI::App& program, int& status);
void add_generate(CLI::App& program, int& status);
void add_reduce(CLI::App& program, int& status);
void add_worlds(CLI::App& program, int& status);
void add_export(CLI::App& program, int& status);
void add_pairs(CLI::App& program, int& status);
void add_live(CLI::App& program, int& status);
void add_report(CLI::App& program, int& status);
void add_replay(CLI::App& program, int& status);
void add_problem(CLI::App& program, int& status);
void add_solve(CLI::App& program, int& status);
void add_man(CLI::App& program, int& status);
void add_completion(CLI::App& program, int& status);
void add_worker(CLI::App& program, int& status);  ///< hidden: what the program starts itself as

/// The program's own options and all verbs.
void add_verbs(CLI::App& program, int& status);

}  // namespace plumb::harness
