#include "schedule/bench.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/machine.hpp"
#include "schedule/row_of_cell.hpp"

namespace plumb::harness {

Bench::Bench(ResultsFile* results, const Ranks& ranks, const RunCallbacks& callbacks)
    : callbacks_(callbacks), machine_(describe_machine()), workers_(ranks.here) {
  if (results != nullptr) claims_.emplace(results->folder(), ranks.alone());
}

bool Bench::take(const std::string& cell_id) { return !claims_ || claims_->take(cell_id); }

void Bench::give_back(const std::string& cell_id) {
  if (claims_) claims_->give_back(cell_id);
}

Answer Bench::repeat(const Cell& cell, const CellFiles& files, const WorkerLimits& limits, RunProgress progress,
                     const std::function<std::optional<double>()>& seconds_left) {
  const auto tell = [&] {
    if (!callbacks_.progress) return;
    if (seconds_left) progress.seconds_left = seconds_left();
    callbacks_.progress(progress);
  };
  tell();
  return workers_.ask(cell, files, limits, [&](const Progress& now) {
    progress.step = now.step;
    progress.steps = now.total;
    tell();
  });
}

Row Bench::row_of(const Cell& cell, const std::vector<Answer>& answers) const {
  return make_row(cell, answers, machine_);
}

std::string label_of_repetition(const Cell& cell, std::uint32_t round, std::uint32_t rounds) {
  return rounds > 1 ? fmt::format("{} {}/{}", label_of(cell), round, rounds) : label_of(cell);
}

bool was_killed(const std::vector<Answer>& answers) {
  return std::any_of(answers.begin(), answers.end(), [](const Answer& a) { return a.killed_from_outside; });
}

}  // namespace plumb::harness
