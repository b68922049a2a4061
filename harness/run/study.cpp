#include "run/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>

#include "run/machine.hpp"
#include "run/row.hpp"

namespace plumb::harness {

namespace {

constexpr unsigned shuffle_seed = 20240229;
constexpr std::uint32_t recording = 0;  // in place of a repetition's number

std::string label_of(const Cell& cell) {
  std::string label = cell.scene->id;
  for (const auto& [name, value] : cell.shown)
    label += " " + name + "=" + std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
  label += " " + cell.backend->name;
  for (const auto& [name, value] : cell.settings.items())
    label += fmt::format(" {}={}", name, value.is_string() ? value.get<std::string>() : value.dump());
  return label;
}

class Study {
 public:
  Study(const Plan& plan, const StudyRequest& request, ResultsFile* results, const StudyCallbacks& callbacks)
      : plan_(plan), request_(request), results_(results), callbacks_(callbacks), machine_(describe_machine()) {
    for (const CellBlock& block : plan.blocks) total_ += block.cells.size();
  }

  void run() {
    for (const CellBlock& block : plan_.blocks) run_block(block);
  }

 private:
  using Answers = std::map<const Cell*, std::vector<Answer>>;  ///< of all repetitions so far

  void run_block(const CellBlock& block) {
    std::vector<const Cell*> open;
    for (const Cell& cell : block.cells) {
      const Json* row = known_row(cell);
      if (row == nullptr) {
        open.push_back(&cell);
      } else {
        record(cell, *row, false);
        hand_on(*row, false);
      }
    }
    Answers answers;
    for (const Ladder& ladder : block.ladders) leave_out_idle(block, ladder, open, answers);
    std::vector<const Cell*> order = open;
    for (std::uint32_t round = 1; round <= request_.repeat; ++round) {
      std::shuffle(order.begin(), order.end(), random_);
      for (const Cell* cell : order) {
        std::vector<Answer>& mine = answers[cell];
        if (mine.size() >= round) continue;                         // a ladder's base or probe
        if (!mine.empty() && mine.back().status != "ok") continue;  // it would only crash or hang once more
        if (!mine.empty() && mine.back().json.value("status", "") == "unsupported") continue;
        mine.push_back(ask(*cell, round));
      }
    }
    for (const Cell* cell : open) finish(*cell, answers[cell]);
  }

  [[nodiscard]] const Json* known_row(const Cell& cell) const {
    return results_ == nullptr ? nullptr : results_->find(cell_id(cell));
  }

  /// What came of a cell: its row of an earlier run, or its first repetition, which is run here when it was not yet.
  Json first_result(const Cell& cell, Answers& answers) {
    if (const Json* row = known_row(cell)) return *row;
    std::vector<Answer>& mine = answers[&cell];
    if (mine.empty()) mine.push_back(ask(cell, 1));
    return mine.front().status == "ok" ? mine.front().json : Json::object();
  }

  void leave_out_idle(const CellBlock& block, const Ladder& ladder, std::vector<const Cell*>& open, Answers& answers) {
    std::vector<std::size_t> idle = ladder.others;
    const Json base = first_result(block.cells[ladder.base], answers);
    if (base.value("status", "") == "unsupported") {
      idle.push_back(ladder.probe);
    } else {
      const Json probe = first_result(block.cells[ladder.probe], answers);
      const std::string hash = base.value("hash", "");
      if (hash.empty() || hash != probe.value("hash", "")) return;
    }
    for (const std::size_t rung : idle) total_ -= std::erase(open, &block.cells[rung]);
  }

  Answer ask(const Cell& cell, std::uint32_t round) {
    Answer answer;
    if (!cell.backend->error.empty()) {
      answer.status = cell.backend->status;
      answer.reason = cell.backend->error;
      return answer;
    }
    answer = ask_worker(cell, round);
    // Somebody ended the worker, perhaps together with this program: that says nothing of the engine, so once more.
    if (answer.killed_from_outside) answer = ask_worker(cell, round);
    return answer;
  }

  Answer ask_worker(const Cell& cell, std::uint32_t round) {
    std::unique_ptr<WorkerProcess>& worker = workers_[cell.backend->file];
    if (!worker || !worker->alive()) worker = std::make_unique<WorkerProcess>(cell.backend->file);
    StudyProgress progress{done_, total_, label_of(cell), 0, 0};
    if (round == recording) {
      progress.cell += " recording";
    } else if (request_.repeat > 1) {
      progress.cell += fmt::format(" {}/{}", round, request_.repeat);
    }
    const auto tick = [&](const Progress& now) {
      if (!callbacks_.progress) return;
      progress.step = now.step;
      progress.steps = now.total;
      callbacks_.progress(progress);
    };
    if (callbacks_.progress) callbacks_.progress(progress);
    Json request = request_of(cell, round == recording ? file_for(cell, "trajectories", ".plt") : "",
                              round == 1 && request_.trace ? file_for(cell, "traces", ".trace") : "");
    request["layers"] = request_.layers;
    return worker->ask(request, request_.limits(), tick);
  }

  /// Runs the cell once more to look at it. Of that run only the trajectory is kept: looking costs time, and some of
  /// what is looked at an engine must keep books for.
  void record(const Cell& cell, const Json& row, bool is_new) {
    if (!request_.record || results_ == nullptr) return;
    const std::string status = row.value("status", "");
    if (status == "unsupported" || status == "timeout" || status == "out_of_memory") return;
    const bool is_there = std::filesystem::exists(file_for(cell, "trajectories", ".plt"));
    if (is_new || !is_there) static_cast<void>(ask(cell, recording));
  }

  /// A file of the cell's own in a folder beside results.jsonl; "" without --out.
  [[nodiscard]] std::string file_for(const Cell& cell, const char* kind, const char* suffix) const {
    if (results_ == nullptr) return "";
    const std::filesystem::path folder = results_->folder() / kind;
    std::filesystem::create_directories(folder);
    return std::filesystem::absolute(folder / (cell_id(cell) + suffix)).string();
  }

  void finish(const Cell& cell, const std::vector<Answer>& answers) {
    const Json row = make_row(cell, answers, machine_);
    const bool killed =
        std::any_of(answers.begin(), answers.end(), [](const Answer& a) { return a.killed_from_outside; });
    if (!killed) record(cell, row, true);
    if (results_ != nullptr && !killed) results_->append(row);  // a killed cell is run again by the next start
    hand_on(row, true);
  }

  void hand_on(const Json& row, bool is_new) {
    ++done_;
    callbacks_.finished(row, is_new);
  }

  const Plan& plan_;
  const StudyRequest& request_;
  ResultsFile* results_;
  const StudyCallbacks& callbacks_;
  Json machine_;
  std::size_t done_ = 0, total_ = 0;
  std::map<std::string, std::unique_ptr<WorkerProcess>> workers_;  ///< by file
  std::mt19937 random_{shuffle_seed};
};

}  // namespace

void run_study(const Plan& plan, const StudyRequest& request, ResultsFile* results, const StudyCallbacks& callbacks) {
  Study(plan, request, results, callbacks).run();
}

}  // namespace plumb::harness
