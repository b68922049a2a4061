// Whether this process is one of several that a launcher such as mpirun has started on the same study.
//
// The processes need nothing of each other but the results folder, through which cells are claimed, so the program
// uses no MPI library: it starts where none is installed, and any launcher that tells a rank its number will do.
#pragma once

#include <string>

namespace plumb::harness {

struct Ranks {
  unsigned rank = 0, size = 1;
  unsigned here = 1;  ///< of them on this machine

  [[nodiscard]] bool alone() const { return size == 1; }
  [[nodiscard]] bool speaks() const { return rank == 0; }  ///< only one draws and prints
  /// "results.jsonl", or "results-RANK.jsonl" where there are several.
  [[nodiscard]] std::string results_name() const;
};

/// From the environment that Open MPI (OMPI_COMM_WORLD_*), MPICH and others (PMI_*) or Slurm (SLURM_*) give.
[[nodiscard]] Ranks ranks_of_environment();

}  // namespace plumb::harness
