#include "schedule/block_runner.hpp"

#include <algorithm>
#include <chrono>
#include <list>
#include <map>
#include <random>
#include <thread>

#include "plumb/assert.hpp"

namespace plumb::harness {

namespace {

constexpr unsigned shuffle_seed = 20240229;

class BlockRunner {
 public:
  BlockRunner(const Plan& plan, const RunRequest& request, ResultsFile* results, const RunCallbacks& callbacks)
      : plan_(plan), request_(request), results_(results), callbacks_(callbacks), bench_(results, {}, callbacks) {
    for (const CellBlock& block : plan.blocks) total_ += block.cells.size();
  }

  /// Blocks that another process is at come last, when it has finished them or is gone.
  void run() {
    std::list<const CellBlock*> left;
    for (const CellBlock& block : plan_.blocks) left.push_back(&block);
    while (true) {
      left.remove_if([&](const CellBlock* block) { return run_if_free(*block); });
      if (left.empty()) return;
      wait_for_others();
    }
  }

 private:
  /// What a ladder is judged by.
  struct End {
    std::string status, hash;
  };
  using Answers = std::map<const Cell*, std::vector<Answer>>;  ///< of all repetitions so far

  /// False when another process has one of the cells: then none is run.
  bool run_if_free(const CellBlock& block) {
    std::vector<std::string> mine;
    const auto give_back = [&] {
      for (const std::string& id : mine) bench_.give_back(id);
    };
    for (const Cell& cell : block.cells) {
      std::string id = cell_id(cell);
      if (!bench_.take(id)) {
        give_back();
        return false;
      }
      mine.push_back(std::move(id));
    }
    if (results_ != nullptr) results_->refresh();  // whoever had a claim until a moment ago has written its row by now
    run_block(block);
    give_back();
    return true;
  }

  void wait_for_others() const {
    if (callbacks_.progress)
      callbacks_.progress(progress_at("another plumb runs the rest in " + results_->folder().string()));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    throw_if_interrupted();
  }

  void run_block(const CellBlock& block) {
    std::vector<const Cell*> open;
    for (const Cell& cell : block.cells) {
      const Row* row = known_row(cell);
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

  [[nodiscard]] const Row* known_row(const Cell& cell) const {
    return results_ == nullptr ? nullptr : results_->find(cell_id(cell));
  }

  /// What came of a cell: its row of an earlier run, or its first repetition, which is run here when it was not yet.
  End first_end(const Cell& cell, Answers& answers) {
    if (const Row* row = known_row(cell)) return {row->status, row->hash};
    std::vector<Answer>& mine = answers[&cell];
    if (mine.empty()) mine.push_back(ask(cell, 1));
    const Answer& first = mine.front();
    return first.status == "ok" ? End{first.json.value("status", ""), first.json.value("hash", "")} : End{};
  }

  void leave_out_idle(const CellBlock& block, const Ladder& ladder, std::vector<const Cell*>& open, Answers& answers) {
    PLUMB_ASSERT(ladder.base < block.cells.size() && ladder.probe < block.cells.size());
    std::vector<std::size_t> idle = ladder.others;
    const End base = first_end(block.cells[ladder.base], answers);
    if (base.status == "unsupported") {
      idle.push_back(ladder.probe);
    } else {
      const End probe = first_end(block.cells[ladder.probe], answers);
      if (base.hash.empty() || base.hash != probe.hash) return;
    }
    for (const std::size_t rung : idle) total_ -= std::erase(open, &block.cells[rung]);
  }

  [[nodiscard]] RunProgress progress_at(std::string what) const { return {done_, total_, std::move(what), 0, 0, {}}; }

  Answer ask(const Cell& cell, std::uint32_t round) {
    CellFiles files;
    files.layers = request_.layers;
    if (round == 1 && results_ != nullptr) {
      if (request_.trace) files.trace = cell_file(results_->folder(), cell, "traces", ".trace");
      if (request_.timeline) files.timeline = cell_file(results_->folder(), cell, "timelines", ".json");
    }
    return bench_.repeat(cell, files, request_.limits(),
                         progress_at(label_of_repetition(cell, round, request_.repeat)));
  }

  void record(const Cell& cell, const Row& row, bool is_new) {
    if (!request_.record || results_ == nullptr || !wants_recording(results_->folder(), cell, row, is_new)) return;
    CellFiles files;
    files.trajectory = trajectory_of(results_->folder(), cell);
    files.layers = request_.layers;
    static_cast<void>(bench_.repeat(cell, files, request_.limits(), progress_at(label_of(cell) + " recording")));
  }

  void finish(const Cell& cell, const std::vector<Answer>& answers) {
    const Row row = bench_.row_of(cell, answers);
    const bool killed = was_killed(answers);
    if (!killed) record(cell, row, true);
    if (results_ != nullptr && !killed) results_->append(row);  // a killed cell is run again by the next start
    hand_on(row, true);
  }

  void hand_on(const Row& row, bool is_new) {
    ++done_;
    callbacks_.finished(row, is_new);
  }

  const Plan& plan_;
  const RunRequest& request_;
  ResultsFile* results_;
  const RunCallbacks& callbacks_;
  Bench bench_;
  std::size_t done_ = 0, total_ = 0;
  std::mt19937 random_{shuffle_seed};
};

}  // namespace

void run_blocks(const Plan& plan, const RunRequest& request, ResultsFile* results, const RunCallbacks& callbacks) {
  BlockRunner(plan, request, results, callbacks).run();
}

}  // namespace plumb::harness
