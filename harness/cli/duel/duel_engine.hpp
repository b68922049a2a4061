// An engine of a duel as somebody types it, and its rows among earlier results.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// "bullet", "bullet:tuned", "impulse:solver=si,substeps=8", "./libplumb-mine.so:matched": a backend, and behind a
/// colon a profile, settings, or both.
struct DuelEngine {
  std::string typed;
  std::string backend;  ///< name or file
  std::string profile = "default";
  std::vector<std::string> settings;  ///< "name=value"

  [[nodiscard]] std::string backend_name() const;  ///< of a file its stem, as rows have it
};

/// Throws UsageError for an empty name, a word that is no profile, and a second profile.
[[nodiscard]] DuelEngine parse_duel_engine(const std::string& typed);

/// What the two are called: backends' names with what was asked of them; where that is the same of two files, as typed.
[[nodiscard]] std::array<std::string, 2> duel_names(const std::array<DuelEngine, 2>& engines);

/// The engine's rows of what was asked for: where neither profile nor settings were, those at its defaults. `where` is
/// for messages. Throws UsageError, with the nearest right word, where there are none.
[[nodiscard]] std::vector<Row> rows_of_engine(const std::vector<Row>& rows, const DuelEngine& engine,
                                              const std::string& where);

/// Those of scenes that are called so: ids, slugs and groups as the rows have them, else what the program knows under
/// the word. Throws UsageError for a word of which there is no row.
[[nodiscard]] std::vector<Row> rows_of_scenes(const std::vector<Row>& rows, const std::vector<std::string>& words,
                                              const std::string& where);

}  // namespace plumb::harness
