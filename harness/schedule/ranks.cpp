#include "schedule/ranks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace plumb::harness {

namespace {

std::optional<unsigned> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  unsigned number = 0;
  if (text == nullptr) return std::nullopt;
  const auto [end, failure] = std::from_chars(text, text + std::strlen(text), number);
  if (failure != std::errc{} || end != text + std::strlen(text)) return std::nullopt;
  return number;
}

struct Launcher {
  const char *rank, *size, *here;
};

// A batch script of Slurm is a task of one; only srun gives more, each with its step's own numbers.
constexpr std::array<Launcher, 3> launchers{{
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE"},
    {"PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"},
    {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_TASKS_PER_NODE"},
}};

}  // namespace

std::string Ranks::results_name() const {
  return alone() ? "results.jsonl" : "results-" + std::to_string(rank) + ".jsonl";
}

Ranks ranks_of_environment() {
  for (const Launcher& launcher : launchers) {
    const auto rank = number_in(launcher.rank), size = number_in(launcher.size);
    if (!rank || !size || *size < 2 || *rank >= *size) continue;
    return {*rank, *size, std::clamp(number_in(launcher.here).value_or(1), 1u, *size)};
  }
  return {};
}

}  // namespace plumb::harness
