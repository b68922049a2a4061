#include "study/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "rows/statistics.hpp"
#include "schedule/plan.hpp"
#include "schedule/row_of_cell.hpp"
#include "study/cost.hpp"
#include "study/refine.hpp"

namespace plumb::harness {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_added = 4;  // points of one ladder

class StudyRunner {
 public:
  StudyRunner(StudyPlan& plan, const StudyFile& study, bool fixed, const Ranks& ranks, ResultsFile& results,
              const RunCallbacks& callbacks)
      : plan_(plan),
        study_(study),
        fixed_(fixed),
        ranks_(ranks),
        results_(results),
        callbacks_(callbacks),
        bench_(&results, ranks, callbacks),
        start_(Clock::now()) {}

  StudyOutcome run() {
    take_stock();
    outcome_.known = seen_.size();
    while (time_left() > 0) {
      const std::vector<std::size_t> batch = next_batch();
      if (!batch.empty()) {
        run_batch(batch);
        for (const std::size_t cell : batch) bench_.give_back(plan_.cells[cell].id);
      } else if (fixed_ || !refine()) {
        break;
      }
      take_stock();
    }
    // What is still to be put between others is left, too.
    if (!fixed_ && time_left() <= 0 && refine()) take_stock();
    tell_what_is_left();
    return outcome_;
  }

 private:
  /// A cell that is being repeated.
  struct Open {
    std::size_t cell;
    std::vector<Answer> answers;
    bool done = false;
  };

  [[nodiscard]] double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] double time_left() const {
    return study_.budget ? *study_.budget - elapsed() : std::numeric_limits<double>::infinity();
  }

  // Hands on what others, or earlier starts, have finished.
  void take_stock() {
    results_.refresh();
    for (const PlannedCell& planned : plan_.cells) {
      const Row* row = seen_.contains(planned.id) ? nullptr : results_.find(planned.id);
      if (row == nullptr) continue;
      seen_.insert(planned.id);
      costs_.learn(*row);
      callbacks_.finished(*row, false);
    }
  }

  [[nodiscard]] double expected_seconds(const PlannedCell& planned) const {
    return costs_.seconds(planned.cell).value_or(costs_.typical_seconds());
  }

  /// Neither finished, nor known to need no run.
  [[nodiscard]] bool is_open(const PlannedCell& planned) const {
    return !seen_.contains(planned.id) && !idle_.contains(planned.id);
  }

  /// False while it cannot be told yet whether the cell is worth a run; what is not goes to idle_.
  bool is_due(const PlannedCell& planned) {
    if (!planned.unless_same) return true;
    const Row *base = results_.find(planned.unless_same->first), *probe = results_.find(planned.unless_same->second);
    if (base == nullptr || probe == nullptr) return false;
    const bool same = !base->hash.empty() && base->hash == probe->hash;
    if (same || base->status == "unsupported") idle_.insert(planned.id);
    return is_open(planned);
  }

  /// The first batch with cells that nobody has, that are due and that there is time for; they are claimed.
  std::vector<std::size_t> next_batch() {
    for (const std::vector<std::size_t>& batch : plan_.batches) {
      std::vector<std::size_t> mine;
      for (const std::size_t place : batch) {
        const PlannedCell& planned = plan_.cells[place];
        if (!is_open(planned) || given_up_.contains(planned.id) || !is_due(planned)) continue;
        if (expected_seconds(planned) > time_left()) continue;
        if (bench_.take(planned.id)) mine.push_back(place);
      }
      if (mine.empty()) continue;
      // Whoever had the claim until a moment ago has written the row by now.
      results_.refresh();
      std::erase_if(mine, [&](std::size_t place) {
        if (results_.find(plan_.cells[place].id) == nullptr) return false;
        bench_.give_back(plan_.cells[place].id);
        return true;
      });
      if (!mine.empty()) return mine;
      take_stock();
    }
    return {};
  }

  void run_batch(const std::vector<std::size_t>& batch) {
    std::vector<Open> open;
    for (const std::size_t place : batch) open.push_back({place, {}, false});
    // From the batch and not from what ran before it, so that all starts and ranks repeat it in the same order.
    std::mt19937 random(study_.shuffle + static_cast<unsigned>(batch.front()));
    for (std::uint32_t round = 1; !open.empty(); ++round) {
      std::shuffle(open.begin(), open.end(), random);
      for (Open& cell : open) {
        if (!repeat(cell, round)) {
          end_of_time(open);
          return;
        }
        cell.done = is_enough(plan_.cells[cell.cell], cell.answers);
        if (cell.done) finish(plan_.cells[cell.cell], cell.answers);
      }
      std::erase_if(open, [](const Open& cell) { return cell.done; });
    }
  }

  [[nodiscard]] WorkerLimits limits() const {
    RunRequest request;
    request.timeout = study_.timeout;
    return request.limits();
  }

  [[nodiscard]] RunProgress progress_at(std::string what) const {
    return {seen_.size(), total(), std::move(what), 0, 0, {}};
  }

  /// One more repetition; false when the budget ended before it did.
  bool repeat(Open& cell, std::uint32_t round) {
    const PlannedCell& planned = plan_.cells[cell.cell];
    const double left = time_left();
    if (left <= 0) return false;
    WorkerLimits limits = this->limits();
    limits.all_seconds = left;
    Answer answer = bench_.repeat(planned.cell, {}, limits,
                                  progress_at(label_of_repetition(planned.cell, round, planned.repetitions.at_most)),
                                  [this] { return std::optional(seconds_left()); });
    if (answer.status == "out_of_time") return false;
    cell.answers.push_back(std::move(answer));
    return true;
  }

  [[nodiscard]] bool is_enough(const PlannedCell& planned, const std::vector<Answer>& answers) const {
    const Answer& last = answers.back();
    if (last.status != "ok" || last.json.value("status", "") == "unsupported") return true;  // as it will be again
    const Repetitions& wanted = planned.repetitions;
    if (answers.size() < wanted.at_least) return false;
    if (fixed_ || answers.size() >= wanted.at_most) return true;
    double spent = 0;
    for (const Answer& answer : answers) spent += answer.wall_seconds;
    if (spent > wanted.within) return true;
    const std::vector<double> runs = medians_of_runs(answers);
    const auto spread = relative_spread(runs);
    return runs.empty() || (spread && *spread <= study_.confidence);
  }

  void finish(const PlannedCell& planned, const std::vector<Answer>& answers) {
    Row row = bench_.row_of(planned.cell, answers);
    row.origin.study = study_.name;
    if (was_killed(answers)) {  // the next start runs it again
      given_up_.insert(planned.id);
      return;
    }
    if (planned.record && wants_recording(results_.folder(), planned.cell, row, true)) record(planned.cell);
    results_.append(row);
    seen_.insert(planned.id);
    costs_.learn(row);
    ++outcome_.run;
    callbacks_.finished(row, true);
  }

  void record(const Cell& cell) {
    CellFiles files;
    files.trajectory = trajectory_of(results_.folder(), cell);
    files.layers = true;
    static_cast<void>(bench_.repeat_quietly(cell, files, limits()));
  }

  // What was repeated once has its errors, and an adaptive study takes its times for as good as they are.
  void end_of_time(const std::vector<Open>& open) {
    for (const Open& cell : open) {
      if (!fixed_ && !cell.done && !cell.answers.empty()) finish(plan_.cells[cell.cell], cell.answers);
    }
  }

  /// Puts points between those of the ladders that are finished; false when there are none to put.
  bool refine() {
    std::vector<std::size_t> batch;
    for (StudyLadder& ladder : plan_.ladders) {
      std::vector<LadderPoint> points;
      std::string metric;
      for (const std::size_t place : ladder.cells) {
        const PlannedCell& planned = plan_.cells[place];
        const Row* row = results_.find(planned.id);
        if (row == nullptr) continue;
        if (const auto point = ladder_point(*row, knob_value(planned.cell, ladder.knob), metric))
          points.push_back(*point);
      }
      for (const double value : points_to_add(points)) {
        if (ladder.added == most_added) break;
        add_point(ladder, value, batch);
      }
    }
    if (batch.empty()) return false;
    outcome_.refined += batch.size();
    plan_.batches.push_back(std::move(batch));
    return true;
  }

  void add_point(StudyLadder& ladder, double value, std::vector<std::size_t>& batch) {
    PlannedCell planned = plan_.cells[ladder.cells.front()];
    planned.cell = with_knob(planned.cell, ladder.knob, value);
    planned.id = cell_id(planned.cell);
    planned.stage = refined_stage;
    planned.record = false;
    planned.unless_same.reset();
    const std::size_t before = plan_.cells.size();
    const std::size_t place = plan_.add(std::move(planned));
    if (std::find(ladder.cells.begin(), ladder.cells.end(), place) != ladder.cells.end()) return;
    ladder.cells.push_back(place);
    ++ladder.added;
    if (place != before) return;
    batch.push_back(place);
    if (results_.find(plan_.cells[place].id) != nullptr) ++outcome_.known;  // put there by an earlier start
  }

  [[nodiscard]] std::size_t total() const { return plan_.cells.size() - idle_.size(); }

  // Worked out anew at most once a second: it looks at all cells.
  [[nodiscard]] std::optional<double> seconds_left() {
    if (elapsed() > estimated_at_ + 1) {
      double sum = 0;
      for (const PlannedCell& planned : plan_.cells) {
        if (is_open(planned)) sum += expected_seconds(planned) * planned.repetitions.at_least;
      }
      estimated_at_ = elapsed();
      estimate_ = sum / ranks_.size;
    }
    return std::min(std::max(0.0, estimate_ - (elapsed() - estimated_at_)), std::max(0.0, time_left()));
  }

  void tell_what_is_left() {
    outcome_.idle = idle_.size();
    outcome_.elsewhere = seen_.size() - outcome_.known - outcome_.run;
    for (const PlannedCell& planned : plan_.cells) {
      if (!is_open(planned) || given_up_.contains(planned.id)) continue;
      if (study_.budget && bench_.take(planned.id)) {
        bench_.give_back(planned.id);
        outcome_.out_of_time.push_back(fmt::format("{} dt={:.4g}", label_of(planned.cell), planned.cell.dt));
      } else {
        ++outcome_.elsewhere;
      }
    }
  }

  StudyPlan& plan_;
  const StudyFile& study_;
  bool fixed_;
  Ranks ranks_;
  ResultsFile& results_;
  const RunCallbacks& callbacks_;
  Bench bench_;
  CostModel costs_;
  Clock::time_point start_;
  std::set<std::string> seen_;      ///< cells whose rows were handed on
  std::set<std::string> idle_;      ///< rungs of knobs that do nothing
  std::set<std::string> given_up_;  ///< cells whose workers somebody keeps killing
  double estimated_at_ = -10, estimate_ = 0;
  StudyOutcome outcome_;
};

}  // namespace

StudyOutcome run_study_plan(StudyPlan& plan, const StudyFile& study, bool fixed, const Ranks& ranks,
                            ResultsFile& results, const RunCallbacks& callbacks) {
  return StudyRunner(plan, study, fixed, ranks, results, callbacks).run();
}

}  // namespace plumb::harness
