// Results put in order: scenes with their variants, backends, and which cells stand for a backend's defaults.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// One scene with one set of parameters: what engines and settings are compared on.
struct Problem {
  std::string scene, group, variant;
  std::vector<const Row*> rows;  ///< in the order of the file

  /// "D1 H=50"
  [[nodiscard]] std::string title() const { return variant.empty() ? scene : scene + " " + variant; }
};

/// What a backend runs with when nobody asked for anything: the settings that a cell of the default profile says to be
/// the engine's own, else the most frequent; the most frequent threads among those cells (of all its cells when none
/// has that profile), and the most frequent dt for each scene, which may have one of its own.
struct Baseline {
  Json settings;
  std::map<std::string, std::optional<double>> dt;  ///< by scene
  std::optional<double> threads;
};

/// All rows of a report and the order in which it shows them. Problems point into `rows`, hence no copies.
class OrderedRows {
 public:
  explicit OrderedRows(std::vector<Row> rows);
  OrderedRows(const OrderedRows&) = delete;
  OrderedRows& operator=(const OrderedRows&) = delete;

  std::vector<Row> rows;
  std::vector<std::string> backends;  ///< by name
  std::vector<std::string> groups;    ///< in order of their first scene
  std::vector<Problem> problems;      ///< by scene id, then variant, both in natural order

  /// The cell, one of `rows`, was run as the backend ships: profile, dt, settings and threads are the baseline's.
  [[nodiscard]] bool is_default(const Row& row) const;
  /// What tells the cell from the backend's baseline: "1/240 s, iterations 20"; dt always stands first.
  [[nodiscard]] std::string configuration(const Row& row) const;
  /// Settings of the cell that are not the baseline's.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> changed_settings(const Row& row) const;
  /// The command that runs the cell again.
  [[nodiscard]] std::string command(const Row& row) const;
  /// Commands that run the cells again, those that differ in the backend only in one; the first few, and how many more.
  [[nodiscard]] std::string commands(const std::vector<const Row*>& rows) const;
  /// The cell that stands for the backend on the problem: the default one, of several seeds the one in the middle of
  /// their verdicts; else the first; null when there is none.
  [[nodiscard]] const Row* representative(const Problem& problem, const std::string& backend) const;
  /// Metrics of the problem that are scored somewhere (all with an error when none is), in order of appearance.
  [[nodiscard]] std::vector<std::string> scored_metrics(const Problem& problem) const;

 private:
  [[nodiscard]] std::string command_for(const Row& row, const std::vector<std::string>& backends_of_it) const;

  [[nodiscard]] bool find_default(const Row& row) const;

  std::map<std::string, Baseline> baselines_;
  std::vector<bool> is_default_;  ///< by place in rows: asked for again and again
};

/// A word as a shell takes it, quoted where it must be.
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace plumb::harness
